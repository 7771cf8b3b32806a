// Handlers that take time: a busy object gets no other message (Level2 Reference Guide, chapter 1).
#include <gmock/gmock.h>

#include "test_system.h"

namespace openr_host {
namespace {

using std::chrono::milliseconds;

class HandlerTimeTest : public testing::Test {
 protected:
  void SetUp() override {
    test_.system.modelTime([](const std::string& object) { return milliseconds(object == "Encoder" ? 20 : 0); },
                           [this] { return now_; });
    test_.boot({{"Camera", "Encoder"}, {"Encoder", "Server"}, {"Server", "Encoder"}});
    encoder_.on_notify = [this](const ONotifyEvent&) {
      encoded_.push_back(now_);
      encoder_.subject().SetData("jpeg", 4);
      encoder_.subject().NotifyObservers();
      encoder_.observer().AssertReady();
    };
    server_.on_notify = [this](const ONotifyEvent&) {
      received_.push_back(now_);
      server_.observer().AssertReady();
    };
    test_.as(encoder_, [&] { encoder_.observer().AssertReady(); });
    test_.as(server_, [&] { server_.observer().AssertReady(); });
    test_.run();
  }

  void takeImageAt(milliseconds now) {
    passTo(now);
    test_.as(camera_, [&] {
      camera_.subject().SetData("image", 5);
      camera_.subject().NotifyObservers();
    });
    test_.run();
  }

  void passTo(milliseconds now) {
    now_ = now;
    test_.run();
  }

  TestSystem test_;
  TestObject& camera_ = test_.add("Camera");
  TestObject& encoder_ = test_.add("Encoder");
  TestObject& server_ = test_.add("Server");
  std::chrono::nanoseconds now_{0};
  std::vector<std::chrono::nanoseconds> encoded_;
  std::vector<std::chrono::nanoseconds> received_;
};

TEST_F(HandlerTimeTest, ABusyObjectGetsItsNextMessageAfterwards) {
  takeImageAt(milliseconds(0));
  takeImageAt(milliseconds(8));
  takeImageAt(milliseconds(16));
  EXPECT_THAT(encoded_, testing::ElementsAre(milliseconds(0)));
  passTo(milliseconds(20));
  EXPECT_THAT(encoded_, testing::ElementsAre(milliseconds(0), milliseconds(20))) << "the newest image is kept";
  passTo(milliseconds(40));
  EXPECT_THAT(received_, testing::ElementsAre(milliseconds(20), milliseconds(40)));
  EXPECT_THAT(encoded_, testing::ElementsAre(milliseconds(0), milliseconds(20))) << "one image was kept, not two";
}

}  // namespace
}  // namespace openr_host
