// How data gets from a subject to its observers (report, section 2.1.1).
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <gmock/gmock.h>

#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;

class ReadyNotifyTest : public testing::Test {
 protected:
  ReadyNotifyTest() {
    record(receiver_, received_);
    record(other_receiver_, other_received_);
  }

  static void record(TestObject& object, std::vector<std::string>& received) {
    object.on_notify = [&received](const ONotifyEvent& event) {
      for (int i = 0; i < event.NumOfData(); ++i) {
        const RCRegion& region = *event.RCData(i);
        received.emplace_back(static_cast<const char*>(event.Data(i)), region.Size());
      }
    };
  }

  void boot() { test_.boot({{"Sender", "Receiver"}, {"Sender", "Other"}}); }

  void assertReady(TestObject& object) {
    test_.as(object, [&] { object.observer().AssertReady(); });
    test_.run();
  }

  void notify(const std::string& text) {
    test_.as(sender_, [&] {
      sender_.subject().SetData(text.data(), text.size());
      sender_.subject().NotifyObservers();
    });
  }

  TestSystem test_;
  TestObject& sender_ = test_.add("Sender");
  TestObject& receiver_ = test_.add("Receiver");
  TestObject& other_receiver_ = test_.add("Other");
  std::vector<std::string> received_;
  std::vector<std::string> other_received_;
};

// Level2 Reference Guide, page 27: "max" is 1 unless set, and then only the last notification is held.
TEST_F(ReadyNotifyTest, OneAssertReadyLetsOneThroughAndTheNewestOtherIsKept) {
  boot();
  assertReady(receiver_);
  notify("first");
  notify("second");
  notify("third");
  test_.run();
  EXPECT_THAT(received_, ElementsAre("first"));
  assertReady(receiver_);
  EXPECT_THAT(received_, ElementsAre("first", "third"));
  test_.as(sender_, [&] { EXPECT_FALSE(sender_.subject().IsReady()); });
}

// Level2 Reference Guide, pages 18 and 22. Data is kept for an observer that has said nothing yet.
TEST_F(ReadyNotifyTest, DataForAnObserverThatWantsNoneIsDeletedIncludingKeptData) {
  boot();
  notify("kept");
  test_.as(receiver_, [&] { receiver_.observer().DeassertReady(); });
  test_.run();
  notify("deleted");
  test_.run();
  test_.as(sender_, [&] { EXPECT_FALSE(sender_.subject().IsReady()); });
  assertReady(other_receiver_);
  EXPECT_THAT(other_received_, ElementsAre("deleted")) << "it was kept for this observer";
  assertReady(receiver_);
  EXPECT_THAT(received_, testing::IsEmpty());
}

TEST_F(ReadyNotifyTest, TheSubjectIsToldWhichObserversAreReadyAndWhichNoLonger) {
  std::vector<std::string> events;
  std::vector<bool> states;
  sender_.on_ready = [&](const OReadyEvent& event) {
    EXPECT_EQ(event.SbjIndex(), TestObject::kEntry);
    EXPECT_NE(event.IsAssert(), event.IsDeassert());
    events.push_back(std::string(event.SenderID() == receiver_.observerId() ? "receiver" : "other") +
                     (event.IsAssert() ? " ready" : " not ready"));
    // The subject's state is already updated when its callback runs.
    states.push_back(sender_.subject().IsReady() != 0);
  };
  boot();
  assertReady(receiver_);
  assertReady(other_receiver_);
  test_.as(receiver_, [&] { receiver_.observer().DeassertReady(); });
  test_.run();
  test_.as(other_receiver_, [&] { other_receiver_.observer().DeassertReady(); });
  test_.run();
  EXPECT_THAT(events, ElementsAre("receiver ready", "other ready", "receiver not ready", "other not ready"));
  EXPECT_THAT(states, ElementsAre(true, true, true, false));
}

}  // namespace
}  // namespace openr_host
