// How data gets from a subject to its observers (report, section 2.1.1).
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <gmock/gmock.h>

#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

  void boot() { test_.boot({{"Sender", "Receiver"}, {"Sender", "Other"}, {"Second", "Receiver"}}); }

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
  TestObject& second_sender_ = test_.add("Second");
  std::vector<std::string> received_;
  std::vector<std::string> other_received_;
};

// Level2 Reference Guide, page 18: NotifyObservers() keeps data for an observer that is in neither state.
TEST_F(ReadyNotifyTest, DataForAnObserverThatHasSaidNothingIsKeptUntilItIsReady) {
  boot();
  notify("kept");
  test_.run();
  EXPECT_THAT(received_, IsEmpty());
  assertReady(receiver_);
  EXPECT_THAT(received_, ElementsAre("kept"));
}

// Page 27: "max" is 1 unless set, and then only the last notification is held.
TEST_F(ReadyNotifyTest, OneAssertReadyLetsOneNotificationThroughAndTheNewestOfTheOthersIsKept) {
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

TEST_F(ReadyNotifyTest, OnlyTheObserversThatAreReadyAreNotified) {
  boot();
  assertReady(other_receiver_);
  test_.as(sender_, [&] { EXPECT_TRUE(sender_.subject().IsReady()); });
  notify("for the other");
  test_.run();
  EXPECT_THAT(received_, IsEmpty()) << "it is kept";
  EXPECT_THAT(other_received_, ElementsAre("for the other"));
}

// Level2 Reference Guide, pages 18 and 22.
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
  EXPECT_THAT(received_, IsEmpty());
}

TEST_F(ReadyNotifyTest, DeassertReadyRevokesReadiness) {
  boot();
  assertReady(receiver_);
  assertReady(other_receiver_);
  test_.as(receiver_, [&] { receiver_.observer().DeassertReady(sender_.subjectId()); });
  test_.run();
  notify("data");
  test_.as(second_sender_, [&] {
    second_sender_.subject().SetData("more", 4);
    second_sender_.subject().NotifyObservers();
  });
  test_.run();
  EXPECT_THAT(received_, ElementsAre("more")) << "of the other sender";
  EXPECT_THAT(other_received_, ElementsAre("data"));
}

TEST_F(ReadyNotifyTest, TheSubjectIsToldWhichObserversAreReadyAndWhichNoLonger) {
  std::vector<std::string> events;
  std::vector<bool> states;
  sender_.on_ready = [&](const OReadyEvent& event) {
    EXPECT_EQ(event.SbjIndex(), TestObject::kSecond);
    EXPECT_NE(event.IsAssert(), event.IsDeassert());
    events.push_back(std::string(event.SenderID() == receiver_.observerId() ? "receiver" : "other") +
                     (event.IsAssert() ? " ready" : " not ready"));
    // The subject's state is already updated when it is told.
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

TEST_F(ReadyNotifyTest, AnObserverAnswersTheSubjectThatNotifiedIt) {
  receiver_.on_notify = [&](const ONotifyEvent& event) {
    EXPECT_EQ(event.ObsIndex(), TestObject::kSecond);
    EXPECT_TRUE(event.SenderID() == sender_.subjectId());
    received_.emplace_back("notified");
    receiver_.observer().AssertReady(event.SenderID());
  };
  boot();
  assertReady(receiver_);
  notify("a");
  test_.run();
  notify("b");
  test_.run();
  EXPECT_THAT(received_, ElementsAre("notified", "notified"));
}

TEST_F(ReadyNotifyTest, MessagesAreHandledOneByOneInTheOrderOfSending) {
  std::vector<std::string> order;
  receiver_.on_notify = [&](const ONotifyEvent&) {
    order.emplace_back("receiver begins");
    receiver_.observer().AssertReady();
    order.emplace_back("receiver ends");
  };
  other_receiver_.on_notify = [&](const ONotifyEvent&) { order.emplace_back("other"); };
  sender_.on_ready = [&](const OReadyEvent&) { order.emplace_back("sender"); };
  boot();
  assertReady(receiver_);
  assertReady(other_receiver_);
  order.clear();
  notify("data");
  EXPECT_THAT(order, IsEmpty());
  test_.run();
  EXPECT_THAT(order, ElementsAre("receiver begins", "receiver ends", "other", "sender"));
}

TEST_F(ReadyNotifyTest, DataSetSeveralTimesArrivesInOneNotification) {
  int events = 0;
  boot();
  const auto count = receiver_.on_notify;
  receiver_.on_notify = [&](const ONotifyEvent& event) {
    ++events;
    count(event);
  };
  assertReady(receiver_);
  test_.as(sender_, [&] {
    sender_.subject().SetData("one", 3);
    sender_.subject().SetData("two", 3);
    sender_.subject().NotifyObservers();
  });
  test_.run();
  EXPECT_EQ(events, 1);
  EXPECT_THAT(received_, ElementsAre("one", "two"));
}

// Level2 Reference Guide, page 20. DISABLE_ALL_SUBJECT does this, and ENABLE_ALL_SUBJECT nothing (core_macro.h).
TEST_F(ReadyNotifyTest, ClearBufferDeletesWhatWaits) {
  boot();
  notify("kept");
  test_.as(sender_, [&] {
    sender_.subject().SetData("set", 3);
    EXPECT_EQ(sender_.subject().ClearBuffer(), oSUCCESS);
    sender_.subject().NotifyObservers();
  });
  assertReady(receiver_);
  EXPECT_THAT(received_, IsEmpty());
  notify("next");
  test_.run();
  EXPECT_THAT(received_, ElementsAre("next"));
}

TEST_F(ReadyNotifyTest, ARegionIsFreeWhenEveryObserverIsDoneWithIt) {
  boot();
  assertReady(receiver_);
  test_.as(other_receiver_, [&] { other_receiver_.observer().DeassertReady(); });
  test_.run();
  auto* region = new RCRegion(4);
  RCRegion* kept = nullptr;
  receiver_.on_notify = [&](const ONotifyEvent& event) {
    EXPECT_EQ(event.RCData(0), region);  // not a copy
    kept = event.RCData(0);
    kept->AddReference();
  };
  test_.as(sender_, [&] {
    sender_.subject().SetData(region);
    EXPECT_GT(region->NumberOfReference(), 1);
    sender_.subject().NotifyObservers();
  });
  EXPECT_GT(region->NumberOfReference(), 1);
  test_.run();
  EXPECT_EQ(region->NumberOfReference(), 2);
  kept->RemoveReference();
  EXPECT_EQ(region->NumberOfReference(), 1);
  region->RemoveReference();
}

TEST_F(ReadyNotifyTest, ARegionThatNoObserverWantsIsFreeAtOnce) {
  boot();
  for (TestObject* observer : {&receiver_, &other_receiver_}) {
    test_.as(*observer, [&] { observer->observer().DeassertReady(); });
  }
  test_.run();
  auto* region = new RCRegion(4);
  test_.as(sender_, [&] {
    sender_.subject().SetData(region);
    sender_.subject().NotifyObservers();
  });
  EXPECT_EQ(region->NumberOfReference(), 1);
  region->RemoveReference();
}

TEST_F(ReadyNotifyTest, BothEndsAreToldAboutTheirConnection) {
  std::vector<std::string> events;
  sender_.on_control = [&](const OControlEvent& event) {
    events.emplace_back(event.SenderID() == receiver_.observerId() ? "sender to receiver" : "sender to other");
  };
  receiver_.on_connect = [&](const OConnectEvent& event) {
    events.emplace_back(event.SenderID() == sender_.subjectId() ? "receiver" : "receiver to second");
  };
  boot();
  EXPECT_THAT(events, ElementsAre("sender to receiver", "receiver", "sender to other", "receiver to second"));
}

TEST_F(ReadyNotifyTest, AnObjectThatHasNotRegisteredItsServicesIsNamed) {
  try {
    test_.system.connect("Sender.Out.Data.S", "Receiver.In.Data.O");
    FAIL() << "connected before DoInit";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("Sender"));
    EXPECT_THAT(error.what(), testing::HasSubstr("REGISTER_ALL_ENTRY"));
  }
}

TEST_F(ReadyNotifyTest, CallsForPrimitivesGoToTheRobot) {
  boot();
  test_.as(sender_, [&] {
    OPrimitiveID camera = 0;
    EXPECT_EQ(OPENR::OpenPrimitive("PRM:/nowhere", &camera), oNOT_FOUND);
    EXPECT_EQ(OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1", &camera), oSUCCESS);
    OPrimitiveControl_CameraParam gain(ocamparamGAIN_HIGH);
    EXPECT_EQ(OPENR::ControlPrimitive(camera, oprmreqCAM_SET_GAIN, &gain, sizeof(gain), nullptr, 0), oSUCCESS);
    EXPECT_EQ(OPENR::ControlPrimitive(camera + 1, oprmreqCAM_SET_GAIN, &gain, sizeof(gain), nullptr, 0),
              oINVALID_PRIMITIVE_ID);
    EXPECT_EQ(OPENR::ClosePrimitive(camera), oSUCCESS);
    char design[orobotdesignNAME_MAX + 1];
    EXPECT_EQ(OPENR::GetRobotDesign(design), oSUCCESS);
    EXPECT_STREQ(design, "ERS-7");
  });
}

TEST_F(ReadyNotifyTest, CallsFailOutsideOfAMachine) {
  boot();
  OPrimitiveID id = 0;
  EXPECT_THROW(OPENR::OpenPrimitive("PRM:/r1", &id), std::logic_error);
  EXPECT_THROW(OSubject().NotifyObservers(), std::logic_error) << "it is not registered";
}

}  // namespace
}  // namespace openr_host
