// Handlers that take time: a busy object gets no other message (Level2 Reference Guide, chapter 1).
#include <ant.h>
#include <gmock/gmock.h>

#include <thread>

#include "simulator/openr_host/objects/filled_on_read.h"
#include "simulator/openr_host/objects/thread_processor_time.h"
#include "test_system.h"

namespace openr_host {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

class HandlerTimeTest : public testing::Test {
 protected:
  void SetUp() override {
    test_.system.modelTime(
        [this](const std::string& object, Entry entry, std::chrono::nanoseconds) {
          return object == "Encoder" && entry == Entry::kNotify ? milliseconds(20) : milliseconds(0);
        },
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
  TestObject& encoder_ = test_.add("Encoder", 112);  // of a lower scheduling class
  TestObject& server_ = test_.add("Server");
  std::chrono::nanoseconds now_{0};
  std::vector<std::chrono::nanoseconds> encoded_;
  std::vector<std::chrono::nanoseconds> received_;
};

TEST_F(HandlerTimeTest, MessagesOfAHandlerLeaveWhenItHasFinished) {
  takeImageAt(milliseconds(8));
  EXPECT_THAT(encoded_, ElementsAre(milliseconds(8)));
  passTo(milliseconds(27));
  EXPECT_THAT(received_, IsEmpty());
  EXPECT_EQ(test_.system.nextFinish(), milliseconds(28));
  passTo(milliseconds(28));
  EXPECT_THAT(received_, ElementsAre(milliseconds(28)));
}

TEST_F(HandlerTimeTest, ABusyObjectHoldsUpNoMessageOfOthers) {
  int answers = 0;
  camera_.on_answer = [&](ANTENVMSG) { ++answers; };
  camera_.on_ready = [this](const OReadyEvent&) {
    antEnvCreateSharedBufferMsg message(1);
    message.Send(antStackRef("IPStack"), camera_.id(), TestObject::kSecond, sizeof(message));
  };
  test_.as(encoder_, [&] { encoder_.observer().AssertReady(camera_.subjectId()); });
  test_.as(camera_, [&] {
    camera_.subject().SetData("image", 5);
    camera_.subject().NotifyObservers();
  });
  test_.run();
  EXPECT_THAT(encoded_, ElementsAre(milliseconds(0)));
  EXPECT_EQ(answers, 1) << "posted before the encoder's work";
}

// What the camera's pixels take, and what the object only waits for, is no work of the object.
TEST_F(HandlerTimeTest, AHandlerIsChargedItsOwnProcessorTime) {
  const auto work = [](milliseconds time) {
    const auto begin = threadProcessorTime();
    while (threadProcessorTime() - begin < time) {
    }
  };
  std::chrono::nanoseconds charged{0};
  test_.system.modelTime(
      [&](const std::string&, Entry, std::chrono::nanoseconds taken) {
        charged += taken;
        return std::chrono::nanoseconds(0);
      },
      [this] { return now_; });
  work(milliseconds(40));  // before the handler
  const char pixels[16] = {};
  FilledOnRead image(pixels, sizeof(pixels));
  encoder_.on_notify = [&](const ONotifyEvent&) {
    for (int i = 0; i < 2; ++i) {
      image.fillBy([&] { work(milliseconds(50)); });
      FilledOnRead::read(pixels);
    }
    std::this_thread::sleep_for(milliseconds(50));
    work(milliseconds(10));
  };
  takeImageAt(milliseconds(8));
  EXPECT_GE(charged, milliseconds(10));
  EXPECT_LT(charged, milliseconds(40));
}

TEST_F(HandlerTimeTest, AnObjectKeepsItsDataUntilItHasFinished) {
  auto* region = new RCRegion(4);
  encoder_.on_notify = [](const ONotifyEvent&) {};  // no message follows
  test_.as(camera_, [&] {
    camera_.subject().SetData(region);
    camera_.subject().NotifyObservers();
  });
  test_.run();
  passTo(milliseconds(19));
  test_.system.handleMessages();
  EXPECT_EQ(region->NumberOfReference(), 2);
  passTo(milliseconds(20));
  test_.system.handleMessages();
  EXPECT_EQ(region->NumberOfReference(), 1);
  region->RemoveReference();
}

// The encoder keeps the processor from objects of lower classes.
TEST(HandlerTime, AnObjectComputesUnlessItsDescriptionSaysThatItWaits) {
  for (const bool waits : {false, true}) {
    TestSystem test;
    std::chrono::nanoseconds now{0};
    test.system.modelTime(
        [](const std::string& object, Entry entry, std::chrono::nanoseconds) {
          return milliseconds(object == "Upper" && entry == Entry::kNotify ? 20 : 0);
        },
        [&] { return now; });
    TestObject& camera = test.add("Camera");
    ObjectDescription description = TestObject::describe("Upper");
    if (waits) {
      description.waits = true;
    }
    auto& upper = static_cast<TestObject&>(test.system.create(description));
    TestObject& lower = test.add("Lower", 112);
    int handled = 0;
    lower.on_notify = [&](const ONotifyEvent&) { ++handled; };
    test.boot({{"Camera", "Upper"}, {"Camera", "Lower"}});
    test.as(upper, [&] { upper.observer().AssertReady(); });
    test.as(lower, [&] { lower.observer().AssertReady(); });
    test.run();
    test.as(camera, [&] {
      camera.subject().SetData("image", 5);
      camera.subject().NotifyObservers();
    });
    test.run();
    EXPECT_EQ(handled, waits ? 1 : 0);
    now = milliseconds(20);
    test.run();
    EXPECT_EQ(handled, 1);
  }
}

TEST_F(HandlerTimeTest, ABusyObjectGetsItsNextMessageAfterwards) {
  takeImageAt(milliseconds(0));
  takeImageAt(milliseconds(8));
  takeImageAt(milliseconds(16));
  EXPECT_THAT(encoded_, ElementsAre(milliseconds(0)));
  passTo(milliseconds(20));
  EXPECT_THAT(encoded_, ElementsAre(milliseconds(0), milliseconds(20))) << "the newest image is kept";
  passTo(milliseconds(40));
  EXPECT_THAT(received_, ElementsAre(milliseconds(20), milliseconds(40)));
  EXPECT_THAT(encoded_, ElementsAre(milliseconds(0), milliseconds(20))) << "one image was kept, not two";
}

TEST_F(HandlerTimeTest, MessagesForABusyObjectKeepTheirOrder) {
  std::vector<OID> senders;
  encoder_.on_notify = [&](const ONotifyEvent& event) { senders.push_back(event.SenderID().oid); };
  takeImageAt(milliseconds(0));
  test_.as(encoder_, [&] { encoder_.observer().AssertReady(camera_.subjectId()); });
  test_.run();
  takeImageAt(milliseconds(8));
  server_.on_notify = [&](const ONotifyEvent&) {
    server_.subject().SetData("settings", 8);
    server_.subject().NotifyObservers();
  };
  test_.as(encoder_, [&] {
    encoder_.subject().SetData("jpeg", 4);
    encoder_.subject().NotifyObservers();
  });
  passTo(milliseconds(16));
  passTo(milliseconds(20));
  passTo(milliseconds(40));
  EXPECT_THAT(senders, ElementsAre(camera_.id(), camera_.id(), server_.id()));
}

}  // namespace
}  // namespace openr_host
