// The gates to the robot's body: commands go in frame by frame, sensor readings come out every four frames.
#include "simulator/openr_host/objects/virtual_robot_comm.h"

#include <OPENR/OPENRAPI.h>
#include <gmock/gmock.h>

#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// The commands for one joint, frame by frame.
using Motion = std::pair<OPrimitiveID, std::vector<slongword>>;

class VirtualRobotCommTest : public GateTest<VirtualRobotComm> {
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
      made = regionOf(id, vector);
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

  FakeRobot& robot_ = test_.robot;
  TestObject& mover_ = test_.add("Mover");
  TestObject& other_ = test_.add("Other");
  int readies_ = 0;
};

TEST_F(VirtualRobotCommTest, AVectorIsPlayedOneValueAFrameToItsLongestEntrysEnd) {
  send({makeVector({{1, {10}}, {2, {7, 8, 9}}})});
  pass(5);
  EXPECT_THAT(robot_.commanded, ElementsAre(Pair(100, ElementsAre(Pair(1, 10), Pair(2, 7))),
                                            Pair(101, ElementsAre(Pair(2, 8))), Pair(102, ElementsAre(Pair(2, 9)))));
}

// Level2 Reference Guide, page 44: READY follows when the output of a vector is complete. All of Sony's motion samples
// send two vectors in their first notification, and one for each READY.
TEST_F(VirtualRobotCommTest, ReadyFollowsTheOutputOfEachVectorSoThatTwoAtFirstLeaveNoGap) {
  EXPECT_EQ(readies_, 1);
  send({makeVector({{1, {1, 2}}}), makeVector({{1, {3, 4}}})});
  pass(1);
  EXPECT_EQ(readies_, 1);
  EXPECT_FALSE(mover_.subject().IsReady());
  pass(1);
  EXPECT_EQ(readies_, 2);
  EXPECT_TRUE(mover_.subject().IsReady());
  send({makeVector({{1, {5}}})});
  pass(2);
  EXPECT_EQ(readies_, 3);
  pass(1);
  std::vector<slongword> played;
  for (const auto& [frame, commands] : robot_.commanded) {
    EXPECT_EQ(frame, 100 + played.size()) << "a gap";
    played.push_back(commands.at(1));
  }
  EXPECT_THAT(played, ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(VirtualRobotCommTest, MalformedVectorsAreRefusedWithAReasonAndTheNextOneIsPlayed) {
  const std::pair<std::string, std::function<void(OCommandVectorData&)>> rows[] = {
      {"its type is 1025 instead of odataCOMMAND_VECTOR",
       [](auto& vector) { vector.vectorInfo.type = odataSENSOR_FRAME_VECTOR; }},
      {"its numData is 0", [](auto& vector) { vector.SetNumData(0); }},
      {"no room for numData 1000000",
       [](auto& vector) { vector.vectorInfo.numData = vector.vectorInfo.maxNumData = 1000000; }},
      {"numFrames is 17, the most is 16", [](auto& vector) { vector.GetInfo(1)->numFrames = 17; }},
      {"frameSize is 0 instead of 8", [](auto& vector) { vector.GetInfo(1)->frameSize = 0; }},
      // By one value, if it has two frames.
      {"dataOffset 504 is outside the data of its region of 512 bytes",
       [](auto& vector) { vector.GetInfo(1)->dataOffset = vector.vectorInfo.totalSize - 8; }},
      {"dataOffset 4294967295 is outside the data", [](auto& vector) { vector.GetInfo(1)->dataOffset = 0xffffffffU; }},
  };
  for (const auto& [message, spoil] : rows) {
    const RegionReference vector = makeVector({{1, {10, 20}}, {2, {10, 20}}});
    spoil(vectorIn(vector));
    test_.output.str("");
    robot_.commanded.clear();
    send({vector, makeVector({{1, {10}}})});
    EXPECT_THAT(test_.output.str(), AllOf(HasSubstr("ERROR"), HasSubstr("OVirtualRobotComm"),
                                          HasSubstr("command vector refused: "), HasSubstr(message)));
    EXPECT_EQ(vector->NumberOfReference(), 1) << message;
    pass(2);
    EXPECT_THAT(robot_.commanded, ElementsAre(Pair(testing::_, ElementsAre(Pair(1, 10))))) << message;
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
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
  EXPECT_THAT(text, HasSubstr("commands ignored: primitive 77 is not open, or takes no commands of type 259\n"));
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

}  // namespace
}  // namespace openr_host
