// The gates to the robot's body: commands go in frame by frame, sensor readings come out every four frames.
#include "simulator/openr_host/objects/virtual_robot_comm.h"

#include <OPENR/OPENRAPI.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>
#include <utility>

#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

/// The commands for one joint, frame by frame.
using Motion = std::pair<OPrimitiveID, std::vector<slongword>>;

class VirtualRobotCommTest : public testing::Test {
 protected:
  void SetUp() override {
    mover_.on_ready = [this](const OReadyEvent& event) { readies_ += event.IsAssert() ? 1 : 0; };
    test_.system.initialize();
    test_.system.connect("Mover.Out.Data.S", "OVirtualRobotComm.Effector.OCommandVectorData.O");
    test_.system.connect("Other.Out.Data.S", "OVirtualRobotComm.Effector.OCommandVectorData.O");
    test_.system.connect("OVirtualRobotComm.Sensor.OSensorFrameVectorData.S", "Other.In.Data.O");
    test_.system.connect("OVirtualRobotComm.Sensor.OSensorFrameVectorData.S", "Mover.In.Data.O");
    test_.system.start();
    test_.as(other_, [&] { other_.observer().DeassertReady(); });
    test_.run();
  }

  OCommandVectorData& vectorIn(const RegionReference& region) {
    void* base = region->Base();
    return *static_cast<OCommandVectorData*>(base);
  }

  RegionReference makeVector(const std::vector<Motion>& motions) {
    RegionReference made;
    test_.as(mover_, [&] {
      MemoryRegionID id = 0;
      OCommandVectorData* vector = nullptr;
      ASSERT_EQ(OPENR::NewCommandVectorData(motions.size(), &id, &vector), oSUCCESS);
      auto* region = new RCRegion(id, vector->vectorInfo.offset, vector, vector->vectorInfo.totalSize);
      made = reference(region);
      region->RemoveReference();
    });
    OCommandVectorData& vector = vectorIn(made);
    vector.SetNumData(motions.size());
    for (std::size_t entry = 0; entry < motions.size(); ++entry) {
      const auto& [joint, values] = motions[entry];
      vector.GetInfo(static_cast<int>(entry))->Set(odataJOINT_COMMAND2, joint, values.size());
      for (std::size_t frame = 0; frame < values.size(); ++frame) {
        const OJointCommandValue2 value{values[frame], 0};
        std::memcpy(&vector.GetData(static_cast<int>(entry))->value[frame], &value, sizeof(value));
      }
    }
    return made;
  }

  void send(const std::vector<RegionReference>& regions) { test_.send(mover_, regions); }

  /// Jumps to this frame; the frames in between are missed.
  void jumpTo(longword frame) {
    test_.as(comm_, [&] { comm_.beginFrame(frame); });
    test_.run();
    frame_ = frame;
  }

  void pass(longword frames) {
    for (longword i = 0; i < frames; ++i) {
      jumpTo(frame_ + 1);
    }
  }

  TestSystem test_;
  FakeRobot& robot_ = test_.robot;
  VirtualRobotComm& comm_ =
      static_cast<VirtualRobotComm&>(test_.system.create(VirtualRobotComm::describe(robot_, nullptr)));
  TestObject& mover_ = test_.add("Mover");
  TestObject& other_ = test_.add("Other");
  longword frame_ = 99;  ///< the last frame that has passed
  int readies_ = 0;
};

TEST_F(VirtualRobotCommTest, ACommandVectorIsPlayedInOrderOneValuePerFrame) {
  send({makeVector({{1, {10, 20, 30}}, {2, {-10, -20, -30}}})});
  EXPECT_THAT(robot_.commanded, IsEmpty());
  pass(5);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 10), Pair(2, -10))),
                                            Pair(101, ElementsAre(Pair(1, 20), Pair(2, -20))),
                                            Pair(102, ElementsAre(Pair(1, 30), Pair(2, -30)))));
}

TEST_F(VirtualRobotCommTest, AVectorLastsAsLongAsItsLongestEntryAndShorterOnesThenCommandNothing) {
  const RegionReference vector =
      makeVector({{1, {10}}, {2, std::vector<slongword>(ocommandMAX_FRAMES, 7)}, {3, {1, 2}}});
  send({vector});
  pass(ocommandMAX_FRAMES - 1);
  EXPECT_GT(vector->NumberOfReference(), 1);
  pass(1);
  EXPECT_EQ(vector->NumberOfReference(), 1);
  EXPECT_THAT(robot_.commanded[100], ElementsAre(Pair(1, 10), Pair(2, 7), Pair(3, 1)));
  EXPECT_THAT(robot_.commanded[101], ElementsAre(Pair(2, 7), Pair(3, 2)));
  EXPECT_THAT(robot_.commanded[115], ElementsAre(Pair(2, 7)));
}

// Level2 Reference Guide, page 44: READY follows when the output of a vector is complete. All of Sony's motion samples
// send two vectors in their first notification, and one for each READY.
TEST_F(VirtualRobotCommTest, ReadyFollowsTheOutputOfEachVectorSoThatTwoAtFirstLeaveNoGap) {
  EXPECT_EQ(readies_, 1);
  send({makeVector({{1, {1, 2}}}), makeVector({{1, {3, 4}}})});
  EXPECT_EQ(readies_, 1);
  EXPECT_FALSE(mover_.subject().IsReady());

  pass(1);
  EXPECT_EQ(readies_, 1);
  pass(1);
  EXPECT_EQ(readies_, 2);
  EXPECT_TRUE(mover_.subject().IsReady());
  send({makeVector({{1, {5}}})});
  EXPECT_EQ(readies_, 2);
  pass(2);
  EXPECT_EQ(readies_, 3);
  pass(1);
  EXPECT_EQ(readies_, 4);
  std::vector<slongword> played;
  for (const auto& [frame, commands] : robot_.commanded) {
    EXPECT_EQ(frame, 100 + played.size()) << "a gap";
    played.push_back(commands.at(1));
  }
  EXPECT_THAT(played, ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(VirtualRobotCommTest, OneVectorForEachReadyLeavesAGapWhileTheObjectAnswers) {
  send({makeVector({{1, {1, 2}}})});
  pass(3);
  EXPECT_EQ(readies_, 2);
  send({makeVector({{1, {3}}})});
  pass(1);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 1))), Pair(101, ElementsAre(Pair(1, 2))),
                                            Pair(103, ElementsAre(Pair(1, 3)))));
}

// BlinkingLED7, a sample in the SDK, runs four objects at the same time, each with LEDs or ears of its own.
TEST_F(VirtualRobotCommTest, SeveralObjectsCommandTheirOwnPrimitivesAndEachGetsItsOwnReady) {
  int other_readies = 0;
  other_.on_ready = [&](const OReadyEvent&) { ++other_readies; };
  send({makeVector({{1, {10, 20}}}), makeVector({{1, {30, 40}}})});
  test_.send(other_, {makeVector({{2, {7}}}), makeVector({{2, {8, 9}}})});
  pass(4);
  EXPECT_THAT(
      robot_.commanded,
      ElementsAre(Pair(100, ElementsAre(Pair(1, 10), Pair(2, 7))), Pair(101, ElementsAre(Pair(1, 20), Pair(2, 8))),
                  Pair(102, ElementsAre(Pair(1, 30), Pair(2, 9))), Pair(103, ElementsAre(Pair(1, 40)))));
  EXPECT_EQ(readies_, 3);
  EXPECT_EQ(other_readies, 2);
  EXPECT_THAT(test_.output.str(), IsEmpty());
}

TEST_F(VirtualRobotCommTest, ARegionIsFreeAgainWhenItsReadyComes) {
  const std::vector<RegionReference> vectors = {makeVector({{1, {1, 2}}}), makeVector({{1, {3, 4}}})};
  send(vectors);
  std::vector<int> references_when_ready;
  mover_.on_ready = [&](const OReadyEvent&) { references_when_ready.push_back(vectors[0]->NumberOfReference()); };
  pass(1);
  EXPECT_GT(vectors[0]->NumberOfReference(), 1);
  pass(1);
  EXPECT_THAT(references_when_ready, ElementsAre(1));
  EXPECT_GT(vectors[1]->NumberOfReference(), 1);
  pass(2);
  EXPECT_EQ(vectors[1]->NumberOfReference(), 1);
}

// Level2 Reference Guide, page 48: only numFrames frames are processed.
TEST_F(VirtualRobotCommTest, AnEntryWithoutFramesIsIgnoredWhateverElseIsInIt) {
  const RegionReference vector = makeVector({{1, {10}}, {2, {20}}});
  vectorIn(vector).GetInfo(1)->numFrames = 0;
  vectorIn(vector).GetInfo(1)->primitiveID = 4711;
  send({vector});
  pass(1);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 10)))));
  EXPECT_THAT(test_.output.str(), IsEmpty());
}

// Page 45: "wait" delays the commands by frames of 8 ms.
TEST_F(VirtualRobotCommTest, AVectorIsDelayedByTheFramesInItsHeader) {
  const RegionReference vector = makeVector({{1, {10}}});
  vectorIn(vector).vectorInfo.wait = 2;
  send({vector, vector});
  pass(6);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(102, ElementsAre(Pair(1, 10))), Pair(105, ElementsAre(Pair(1, 10)))));
  EXPECT_EQ(readies_, 3);
}

// Page 50: the period of a value for an LED is in frames of 8 ms.
TEST_F(VirtualRobotCommTest, AValueForAnLedLastsItsPeriod) {
  robot_.led = 5;
  const RegionReference vector = makeVector({{5, {0, 0}}});
  vectorIn(vector).GetInfo(0)->type = odataLED_COMMAND2;
  for (const int frame : {0, 1}) {
    const OLEDCommandValue2 value{frame == 0 ? oledON : oledOFF, 3, 0};
    std::memcpy(&vectorIn(vector).GetData(0)->value[frame], &value, sizeof(value));
  }
  send({vector});
  pass(5);
  EXPECT_EQ(readies_, 1);
  pass(1);
  EXPECT_EQ(readies_, 2);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(5, 1))), Pair(103, ElementsAre(Pair(5, 0)))));
}

TEST_F(VirtualRobotCommTest, WritingToAVectorDuringOutputChangesTheMovement) {
  const RegionReference vector = makeVector({{1, {10, 20, 30}}});
  send({vector});
  pass(1);
  const OJointCommandValue2 value{999, 0};
  std::memcpy(&vectorIn(vector).GetData(0)->value[2], &value, sizeof(value));
  pass(2);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 10))), Pair(101, ElementsAre(Pair(1, 20))),
                                            Pair(102, ElementsAre(Pair(1, 999)))));
}

TEST_F(VirtualRobotCommTest, MalformedVectorsAreRefusedWithAReasonAndTheNextOneIsPlayed) {
  struct Case {
    std::string message;
    std::function<void(OCommandVectorData&)> spoil;
  };
  const std::vector<Case> cases = {
      {"its type is 1025 instead of odataCOMMAND_VECTOR",
       [](OCommandVectorData& vector) { vector.vectorInfo.type = odataSENSOR_FRAME_VECTOR; }},
      {"its numData is 0", [](OCommandVectorData& vector) { vector.SetNumData(0); }},
      {"its numData is 3, its maxNumData only 2", [](OCommandVectorData& vector) { vector.SetNumData(3); }},
      {"no room for numData 1000000",
       [](OCommandVectorData& vector) { vector.vectorInfo.numData = vector.vectorInfo.maxNumData = 1000000; }},
      {"numFrames is 17, the most is 16", [](OCommandVectorData& vector) { vector.GetInfo(1)->numFrames = 17; }},
      {"frameSize is 0 instead of 8", [](OCommandVectorData& vector) { vector.GetInfo(1)->frameSize = 0; }},
      {"dataOffset 0 is outside the data", [](OCommandVectorData& vector) { vector.GetInfo(1)->dataOffset = 0; }},
      {"dataOffset 511 is outside the data",
       [](OCommandVectorData& vector) { vector.GetInfo(1)->dataOffset = vector.vectorInfo.totalSize - 1; }},
      {"dataOffset 392 is outside the data of its region of 512 bytes",  // by one value, if it has 16 frames
       [](OCommandVectorData& vector) {
         vector.GetInfo(1)->numFrames = 16;
         vector.GetInfo(1)->dataOffset += 8;
       }},
      {"dataOffset 4294967295 is outside the data",
       [](OCommandVectorData& vector) { vector.GetInfo(1)->dataOffset = 0xffffffffU; }},
  };
  for (const auto& malformed : cases) {
    const RegionReference vector = makeVector({{1, {10, 20}}, {2, {10, 20}}});
    malformed.spoil(vectorIn(vector));
    send({vector});
    EXPECT_THAT(test_.output.str(), AllOf(HasSubstr("ERROR"), HasSubstr("OVirtualRobotComm"),
                                          HasSubstr("command vector refused: "), HasSubstr(malformed.message)));
    EXPECT_EQ(vector->NumberOfReference(), 1) << malformed.message;
    test_.output.str("");

    pass(1);
    EXPECT_THAT(robot_.commanded, IsEmpty()) << malformed.message;
    send({makeVector({{1, {10}}})});
    pass(1);
    EXPECT_THAT(robot_.commanded, ElementsAre(Pair(frame_, ElementsAre(Pair(1, 10))))) << malformed.message;
    EXPECT_THAT(test_.output.str(), IsEmpty());
    robot_.commanded.clear();
  }
}

// Level2 Reference Guide, page 48: the type belongs to each entry. The player of motions in Sony's sample MoNet sends
// JOINT_COMMAND2 to the ears, too.
TEST_F(VirtualRobotCommTest, AnEntryThatItsPrimitiveDoesNotTakeIsIgnoredAloneAndSaidOnce) {
  const RegionReference vector = makeVector({{1, {10, 20}}, {77, {5}}, {2, {30, 40}}, {77, {6}}});
  vectorIn(vector).GetInfo(2)->type = odataLED_COMMAND2;
  vectorIn(vector).GetInfo(3)->type = odataLED_COMMAND2;
  for (int i = 0; i < 2; ++i) {
    send({vector});
    pass(2);
  }
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 10))), Pair(101, ElementsAre(Pair(1, 20))),
                                            Pair(102, ElementsAre(Pair(1, 10))), Pair(103, ElementsAre(Pair(1, 20)))));
  const std::string text = test_.output.str();
  std::string expected;
  for (const char* ignored :
       {"77 is not open, or takes no commands of type 259", "2 is not open, or takes no commands of type 260",
        "77 is not open, or takes no commands of type 260"}) {
    expected += "WARNING OVirtualRobotComm: commands ignored: primitive " + std::string(ignored) + "\n";
  }
  EXPECT_EQ(text, expected);
  robot_.led = 2;
  robot_.commanded.clear();
  send({vector});
  pass(1);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(104, ElementsAre(Pair(1, 10), Pair(2, ::testing::_)))))
      << "now it takes it";
}

TEST_F(VirtualRobotCommTest, AVectorOfIgnoredEntriesIsFreeInTheNextFrame) {
  const RegionReference vector = makeVector({{77, {10, 20}}});
  send({vector});
  EXPECT_EQ(readies_, 1);
  pass(1);
  EXPECT_EQ(readies_, 2);
  EXPECT_EQ(vector->NumberOfReference(), 1);
}

// Level2 Reference Guide, page 44. Sony's sample SoundPlay sends from DoStart(), and then expects the first READY after
// the output.
TEST(VirtualRobotCommStartTest, TheEffectorIsReadyBeforeDoStart) {
  TestSystem test;
  test.system.create(VirtualRobotComm::describe(test.robot, nullptr));
  TestObject& mover = test.add("Mover");
  bool was_ready = false;
  mover.on_ready = [&](const OReadyEvent& event) { was_ready = event.IsAssert() && !mover.isStarted(); };
  test.system.initialize();
  test.system.connect("Mover.Out.Data.S", "OVirtualRobotComm.Effector.OCommandVectorData.O");
  test.system.start();
  EXPECT_TRUE(was_ready);
  EXPECT_TRUE(mover.isStarted());
  EXPECT_TRUE(mover.subject().IsReady());
}

TEST_F(VirtualRobotCommTest, ARegionTooSmallForAVectorIsRefused) {
  auto* region = new RCRegion(sizeof(ODataVectorInfo) - 1);
  send({reference(region)});
  EXPECT_THAT(test_.output.str(), HasSubstr("its region of 191 bytes has no room for a header"));
  EXPECT_EQ(region->NumberOfReference(), 1);
  region->RemoveReference();
}

TEST_F(VirtualRobotCommTest, AnObjectThatSendsMalformedVectorsForeverIsRefusedOncePerFrame) {
  const RegionReference vector = makeVector({{1, {10}}});
  vectorIn(vector).GetInfo(0)->frameSize = 0;
  int left = 100;  // limit in case of an error
  mover_.on_ready = [&](const OReadyEvent&) {
    if (--left > 0) {
      mover_.subject().SetData(vector.get());
      mover_.subject().NotifyObservers();
    }
  };
  const auto refusals = [&] {
    const std::string text = test_.output.str();
    return std::count(text.begin(), text.end(), '\n');
  };
  send({vector});
  EXPECT_EQ(refusals(), 1);
  pass(4);
  EXPECT_EQ(refusals(), 5);
  int ready = 0;
  mover_.on_ready = [&](const OReadyEvent&) { ++ready; };
  EXPECT_EQ(comm_.nextEvent(), frame_ + 1);
  pass(3);
  EXPECT_EQ(ready, 1) << "once for each vector";
  robot_.commanded.clear();
  send({makeVector({{1, {10}}}), vector, vector, makeVector({{1, {20}}})});
  pass(3);
  EXPECT_EQ(ready, 5);
  EXPECT_EQ(robot_.commanded.size(), 2U) << "those beside it are played";
}

TEST_F(VirtualRobotCommTest, SensorReadingsReachAReadyObserverEveryFourFrames) {
  std::vector<std::vector<slongword>> received;
  mover_.on_notify = [&](const ONotifyEvent& event) {
    auto* data = const_cast<void*>(event.Data(0));
    auto* vector = static_cast<OSensorFrameVectorData*>(data);
    received.emplace_back();
    for (longword i = 0; i < vector->GetInfo(0)->numFrames; ++i) {
      received.back().push_back(vector->GetData(0)->frame[i].value);
    }
    mover_.observer().AssertReady(event.SenderID());
  };
  test_.as(mover_, [&] { mover_.observer().AssertReady(); });
  test_.run();
  pass(9);
  EXPECT_THAT(received, ElementsAre(ElementsAre(100, 101, 102, 103), ElementsAre(104, 105, 106, 107)));
  EXPECT_EQ(robot_.sensors()->NumberOfReference(), 1);
}

TEST_F(VirtualRobotCommTest, SensorsAreNotReadWhileNoObserverWantsThem) {
  test_.as(mover_, [&] { mover_.observer().DeassertReady(); });
  test_.run();
  pass(8);
  EXPECT_THAT(robot_.calls, Not(testing::Contains(HasSubstr("captureSensors"))));
}

// Level2 Reference Guide, pages 18 and 27: the newest data is kept for a busy observer.
TEST_F(VirtualRobotCommTest, ABusyObserverGetsTheNewestReadingWhenItIsReady) {
  std::vector<longword> received;
  mover_.on_notify = [&](const ONotifyEvent& event) {
    auto* data = const_cast<void*>(event.Data(0));
    received.push_back(static_cast<OSensorFrameVectorData*>(data)->GetInfo(0)->frameNumber);
  };
  pass(9);
  test_.as(mover_, [&] { mover_.observer().AssertReady(); });
  test_.run();
  EXPECT_THAT(received, ElementsAre(104));
}

TEST_F(VirtualRobotCommTest, AFramePassesBeforeSensorsAndCameraAreRead) {
  test_.as(mover_, [&] { mover_.observer().AssertReady(); });
  test_.run();
  frame_ = 102;
  pass(1);
  EXPECT_THAT(robot_.calls, ElementsAre("passFrame 103", "captureSensors 103", "cameraImageDue 103"));
}

TEST_F(VirtualRobotCommTest, AfterADelayByTheHostTheMissedFramesArePassedInTurn) {
  test_.as(mover_, [&] { mover_.observer().AssertReady(); });
  test_.run();
  send({makeVector({{1, {1, 2, 3}}}), makeVector({{1, {4, 5, 6}}})});
  pass(1);
  robot_.calls.clear();
  jumpTo(110);
  // The sensors were due in frames 103 and 107; only the newer one is delivered.
  EXPECT_THAT(robot_.calls, ElementsAre("passFrame 101", "passFrame 102", "passFrame 103", "passFrame 104",
                                        "passFrame 105", "passFrame 106", "passFrame 107", "captureSensors 107",
                                        "passFrame 108", "passFrame 109", "passFrame 110", "cameraImageDue 110"));
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 1))), Pair(101, ElementsAre(Pair(1, 2))),
                                            Pair(102, ElementsAre(Pair(1, 3))), Pair(103, ElementsAre(Pair(1, 4))),
                                            Pair(104, ElementsAre(Pair(1, 5))), Pair(105, ElementsAre(Pair(1, 6)))));
  EXPECT_TRUE(mover_.subject().IsReady());
}

TEST_F(VirtualRobotCommTest, TheNextEventIsThatOfTheSensorsOrAnImage) {
  EXPECT_EQ(comm_.nextEvent(), 0u);
  pass(1);  // 100
  EXPECT_EQ(comm_.nextEvent(), 103u);
  robot_.frames_with_image = {102, 104};
  EXPECT_EQ(comm_.nextEvent(), 102u);
  pass(2);
  EXPECT_EQ(comm_.nextEvent(), 103u);
  pass(1);
  EXPECT_EQ(comm_.nextEvent(), 104u);
  pass(1);
  EXPECT_EQ(comm_.nextEvent(), 107u);
}

TEST_F(VirtualRobotCommTest, WhileAnObjectCommandsTheBodyEachFrameIsAnEvent) {
  send({makeVector({{1, {1, 2}}})});
  pass(1);
  EXPECT_EQ(comm_.nextEvent(), 101u);
  pass(1);
  EXPECT_EQ(comm_.nextEvent(), 103u);
}

TEST_F(VirtualRobotCommTest, AfterADelayOfMoreThanASecondTheLastSecondIsPassedWithTheWaitingCommands) {
  test_.as(mover_, [&] { mover_.observer().DeassertReady(); });
  test_.run();
  pass(1);
  send({makeVector({{1, {1, 2}}})});
  robot_.calls.clear();
  jumpTo(1000000);
  ASSERT_EQ(robot_.calls.size(), kMostFramesCaughtUp + 1);
  EXPECT_EQ(robot_.calls.front(), "passFrame " + std::to_string(1000000 - kMostFramesCaughtUp + 1));
  EXPECT_EQ(robot_.calls[kMostFramesCaughtUp - 1], "passFrame 1000000");
  EXPECT_EQ(robot_.commanded.size(), 2U);
}

TEST_F(VirtualRobotCommTest, StoppingDropsWaitingCommands) {
  const RegionReference vector = makeVector({{1, {1, 2}}});
  send({vector});
  test_.as(comm_, [&] { comm_.DoStop(OSystemEvent()); });
  EXPECT_EQ(vector->NumberOfReference(), 1);
}

TEST_F(VirtualRobotCommTest, AfterAnythingElseMovementsAndReadingsAreAsTheFirst) {
  const auto use = [this] {
    pass(4 - frame_ % 4);
    const longword begin = frame_;
    const int readies = readies_;
    robot_.commanded.clear();
    std::ostringstream seen;
    mover_.on_notify = [&](const ONotifyEvent& event) {
      void* base = event.RCData(0)->Base();
      auto& vector = *static_cast<OSensorFrameVectorData*>(base);
      seen << "read " << vector.GetInfo(0)->frameNumber - begin << " "
           << vector.GetData(0)->frame[3].value - static_cast<slongword>(begin) << "\n";
      mover_.observer().AssertReady();
    };
    test_.as(mover_, [&] { mover_.observer().AssertReady(); });
    test_.run();
    RegionReference late = makeVector({{3, {-7}}});
    vectorIn(late).vectorInfo.wait = 2;
    send({makeVector({{1, {10, 20, 30}}, {2, {-1}}}), late});
    test_.send(other_, {makeVector({{4, {5, 6}}})});
    for (int i = 0; i < 10; ++i) {
      pass(1);
      seen << readies_ - readies << " " << comm_.nextEvent() - begin << "\n";
    }
    test_.as(mover_, [&] { mover_.observer().DeassertReady(); });
    test_.run();
    pass(5);
    mover_.on_notify = [](const ONotifyEvent&) {};
    for (const auto& [frame, commands] : robot_.commanded) {
      seen << frame - begin << ": " << testing::PrintToString(commands) << "\n";
    }
    return seen.str();
  };
  const std::string first = use();
  const auto spoiled = [this] {
    RegionReference vector = makeVector({{1, {1, 2, 3}}});
    vectorIn(vector).vectorInfo.type = odataSOUND_VECTOR;
    return vector;
  };
  const std::pair<const char*, std::function<void()>> histories[] = {
      {"a refused vector", [&] { send({spoiled()}); }},
      {"a refused vector between others",
       [&] {
         send({makeVector({{1, {1}}}), spoiled(), makeVector({{1, {2}}})});
       }},
      {"refused vectors of two objects",
       [&] {
         send({spoiled()});
         test_.send(other_, {spoiled()});
       }},
      {"commands that are not taken",
       [&] {
         send({makeVector({{99, {1, 2}}, {1, {4}}})});
       }},
      {"frames that were missed",
       [&] {
         send({makeVector({{1, {1, 2, 3}}})});
         jumpTo(frame_ + 1000);
       }},
      {"a reading that was not fetched", [&] {
         test_.as(mover_, [&] { mover_.observer().AssertReady(); });
         test_.run();
         pass(9);
         test_.as(mover_, [&] { mover_.observer().DeassertReady(); });
         test_.run();
       }}};
  for (const auto& [name, history] : histories) {
    history();
    pass(8);
    EXPECT_EQ(use(), first) << "after " << name;
  }
}

TEST_F(VirtualRobotCommTest, ACommandVectorHasRoomForItsEntriesAndAUniqueId) {
  test_.as(mover_, [&] {
    MemoryRegionID id = 0;
    MemoryRegionID other_id = 0;
    OCommandVectorData* vector = nullptr;
    OCommandVectorData* other = nullptr;
    ASSERT_EQ(OPENR::NewCommandVectorData(3, &id, &vector), oSUCCESS);
    ASSERT_EQ(OPENR::NewCommandVectorData(1, &other_id, &other), oSUCCESS);
    EXPECT_NE(id, 0U);
    EXPECT_NE(id, other_id);
    EXPECT_EQ(vector->vectorInfo.type, odataCOMMAND_VECTOR);
    EXPECT_EQ(vector->vectorInfo.memRegionID, id);
    EXPECT_EQ(vector->vectorInfo.maxNumData, 3U);
    EXPECT_EQ(vector->vectorInfo.numData, 0U);
    const void* begin = vector;
    for (int entry = 0; entry < 3; ++entry) {
      const void* data = vector->GetData(entry);
      const auto offset = static_cast<const byte*>(data) - static_cast<const byte*>(begin);
      EXPECT_EQ(offset, 192 + 3 * 32 + entry * 128);
    }
    EXPECT_EQ(vector->vectorInfo.totalSize, 192U + 3 * (32 + 128));

    EXPECT_EQ(OPENR::DeleteCommandVectorData(id), oSUCCESS);
    EXPECT_EQ(OPENR::DeleteCommandVectorData(id), oFAIL);
    ASSERT_EQ(OPENR::NewCommandVectorData(2, &id, &vector), oSUCCESS);
    EXPECT_NE(id, other_id);
    EXPECT_EQ(OPENR::NewCommandVectorData(0, &id, &vector), oNO_MEMORY);
    EXPECT_EQ(OPENR::NewCommandVectorData(static_cast<size_t>(-1), &id, &vector), oNO_MEMORY);
  });
}

TEST_F(VirtualRobotCommTest, CallsForJointsAndSensorsGoToTheRobot) {
  test_.as(mover_, [&] {
    OJointValue joint{};
    OSensorValue sensor{};
    OPowerStatus power;
    robot_.power_status.remainingCapacity = 87;
    for (const OStatus status : {oSUCCESS, oGAIN_DISABLED, oALERT_JOINT_UNCONTROLLABLE, oINVALID_PRIMITIVE_ID}) {
      robot_.calls.clear();
      robot_.joint_status = status;
      EXPECT_EQ(OPENR::SetJointGain(7, 1, 2, 3, 4, 5, 6), status);
      EXPECT_EQ(OPENR::SetDefaultJointGain(7), status);
      EXPECT_EQ(OPENR::EnableJointGain(oprimitiveID_UNDEF), status);
      EXPECT_EQ(OPENR::DisableJointGain(8), status);
      EXPECT_EQ(OPENR::GetJointValue(9, &joint), status);
      EXPECT_EQ(OPENR::GetSensorValue(10, &sensor), status);
      EXPECT_EQ(OPENR::SetMotorPower(opowerON), status);
      EXPECT_EQ(OPENR::GetPowerStatus(&power), status);
      EXPECT_THAT(robot_.calls, ElementsAre("setJointGain 7 1 2 3 4 5 6", "setDefaultJointGain 7",
                                            "enableJointGain 4294967295", "disableJointGain 8", "getJointValue 9",
                                            "getSensorValue 10", "setMotorPower 1", "getPowerStatus"));
    }
    EXPECT_EQ(joint.value, 1000);
    EXPECT_EQ(sensor.value, 2000);
    EXPECT_EQ(power.remainingCapacity, 87);
  });
}

}  // namespace
}  // namespace openr_host
