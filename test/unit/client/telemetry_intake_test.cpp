#include "client/telemetry_intake.h"

#include <gmock/gmock.h>

#include "client/picture_intake.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr int kHeadPan = 2;
constexpr int kKnee = 13;  // left_front_knee
constexpr int kBattery = 66;

// What version 2 can send at most.
constexpr double kLargest = std::numeric_limits<std::int32_t>::max() * 1e-6;

class TelemetryIntakeTest : public ::testing::Test {
 protected:
  void measure(const std::vector<JointReading>& joints, const std::vector<SensorReading>& sensors = {},
               const std::string& design = "ERS-7") {
    Telemetry telemetry;
    telemetry.arrival = now_;
    telemetry.joints = joints;
    telemetry.sensors = sensors;
    intake_.deliver(telemetry, design);
  }

  std::vector<Telemetry> delivered_;
  std::vector<std::string> log_;
  Notifier notifier_{callbacks()};
  ClientStatistics counters_;
  ConnectionContext context_{"robot:54321", milliseconds(500), notifier_, counters_, 3};
  TelemetryIntake intake_{context_};
  aibo_system::RateLimit::TimePoint now_{std::chrono::hours(1)};

 private:
  Callbacks callbacks() {
    Callbacks callbacks;
    callbacks.on_telemetry = [this](const Telemetry& telemetry) { delivered_.push_back(telemetry); };
    callbacks.log = [this](LogLevel, const std::string& line) { log_.push_back(line); };
    return callbacks;
  }
};

// A real robot goes beyond the limits of commands, up to the mechanical ones, and its potentiometers may be a bit off.
TEST_F(TelemetryIntakeTest, PositionsUpToTheMechanicalLimitsAndABitMoreAreDelivered) {
  const auto is_delivered = [this](int id, double position, const char* design) {
    const std::size_t before = delivered_.size();
    measure({{id, position}}, {}, design);
    return delivered_.size() > before;
  };
  for (const char* design : {"ERS-7", "ERS-210"}) {
    const robot_model::RobotModel& model = *robot_model::findRobotModel(design);
    for (int i = 0; i < model.number_of_joints; ++i) {
      const robot_model::Joint& joint = model.joints[i];
      SCOPED_TRACE(std::string(design) + " " + joint.name);
      EXPECT_TRUE(is_delivered(joint.identifier, 1e-6 * joint.mechanical_lowest - 0.19, design));
      EXPECT_TRUE(is_delivered(joint.identifier, 1e-6 * joint.mechanical_highest + 0.19, design));
      EXPECT_FALSE(is_delivered(joint.identifier, 1e-6 * joint.mechanical_lowest - 0.21, design));
      EXPECT_FALSE(is_delivered(joint.identifier, 1e-6 * joint.mechanical_highest + 0.21, design));
    }
  }
  EXPECT_TRUE(is_delivered(kKnee, 2.6, "")) << "an ERS-210 bends so far";
  EXPECT_FALSE(is_delivered(kKnee, 2.6, "ERS-7"));
}

TEST_F(TelemetryIntakeTest, ReadingsThatNoSensorCanHaveAreDropped) {
  const struct {
    int id;
    std::vector<double> possible;
    std::vector<double> impossible;
  } rows[] = {
      {66, {0, 1}, {-0.01, 1.1, kLargest}},  // battery
      {67, {-5, 70}, {-273, 300}},           // its temperature
      {54, {0, 0.19, 1.6}, {-0.01, 327}},    // range_far; beyond its range, ROS has infinities (REP 117)
      {61, {19.6133, -25}, {2000}},          // acceleration_front_back; the second one is a shock
      {5, {0, 120}, {-1, kLargest}},         // head_touch; about 80 is usual
      {14, {0, 1}, {2}},                     // paw_left_front
      {200, {-kLargest}, {}},                // a sensor that is not in the tables
  };
  std::size_t impossible = 0;
  for (const auto& row : rows) {
    for (const double value : row.possible) {
      delivered_.clear();
      measure({}, {{row.id, value}});
      EXPECT_THAT(delivered_, SizeIs(1)) << row.id << " " << value;
    }
    for (const double value : row.impossible) {
      delivered_.clear();
      measure({}, {{row.id, value}});
      EXPECT_THAT(delivered_, SizeIs(0)) << row.id << " " << value;
      EXPECT_EQ(++impossible, counters_.impossible_values);
    }
  }
}

TEST_F(TelemetryIntakeTest, AWalkThatIsFasterThanLegsMoveIsDropped) {
  Telemetry telemetry;
  telemetry.sensors = {{kBattery, 0.5}};
  telemetry.walk = WalkReading{{0.7, -0.7, 7}, 0.5, WalkState::kWalks};
  intake_.deliver(telemetry, "ERS-7");
  EXPECT_TRUE(delivered_.at(0).walk);
  for (const WalkVelocity& velocity : {WalkVelocity{2147, 0, 0}, {0, -2147, 0}, {0, 0, 2147}}) {
    telemetry.walk->velocity = velocity;
    intake_.deliver(telemetry, "ERS-7");
    EXPECT_FALSE(delivered_.back().walk);
  }
  EXPECT_EQ(counters_.impossible_values, 3);
}

TEST_F(TelemetryIntakeTest, AnImpossiblePositionIsDroppedCountedAndLoggedOnce) {
  for (int i = 0; i < 10; ++i) {
    measure({{kHeadPan, 0.5}, {kKnee, kLargest}}, {{kBattery, 0.5}});
    now_ += milliseconds(32);
  }
  ASSERT_THAT(delivered_, SizeIs(10));
  EXPECT_THAT(delivered_[9].joints, ElementsAre(testing::Field(&JointReading::id, kHeadPan)));
  EXPECT_THAT(delivered_[9].sensors, SizeIs(1));
  EXPECT_EQ(counters_.telemetry, 10U);
  EXPECT_EQ(counters_.impossible_values, 10U);
  EXPECT_THAT(log_, ElementsAre("robot:54321 sent an impossible value, which is dropped: the position of "
                                "left_front_knee is 2147.48; it can be -0.723599 to 2.41657."));
}

TEST_F(TelemetryIntakeTest, OfAJointTwiceAndOfAnImpossibleDutyTheRestIsDelivered) {
  measure({{kKnee, 0.5}, {kKnee, 0.51}});
  EXPECT_THAT(delivered_.at(0).joints, SizeIs(1));
  EXPECT_THAT(log_, ElementsAre(testing::HasSubstr("left_front_knee appears twice")));
  measure({{kKnee, 0.5, 2.147}, {kHeadPan, 0.5, -1.0}});
  EXPECT_FALSE(delivered_.at(1).joints.at(0).duty);
  EXPECT_EQ(delivered_[1].joints.at(1).duty, -1.0);
  EXPECT_EQ(counters_.impossible_values, 2U);
}

TEST_F(TelemetryIntakeTest, WhatComesTooOftenIsThinnedToTwiceTheRateAskedFor) {
  intake_.askedFor(8);
  constexpr std::size_t kMessages = 33000;
  for (std::size_t i = 0; i < kMessages; ++i) {  // in 1 s
    now_ += std::chrono::microseconds(30);
    measure({{kHeadPan, 0}});
  }
  const double twice = 2 * 15.625;
  EXPECT_THAT(delivered_, SizeIs(testing::AllOf(testing::Ge(twice), testing::Le(twice + 160 + 1))));
  EXPECT_EQ(counters_.thinned_telemetry, kMessages - delivered_.size());
  EXPECT_THAT(log_, ElementsAre(testing::HasSubstr("more than twice as often as it was asked to")));
}

TEST_F(TelemetryIntakeTest, WhatWasAskedForIsNeverThinnedAlsoIfTheRadioHeldItUp) {
  for (int i = 0; i < 1000; ++i) {
    measure({{kHeadPan, 0}});  // answers to requests of version 1 for each value
  }
  for (const int period : {1, 4, 40}) {  // a server rounds 1 up to 4
    intake_.askedFor(period);
    const milliseconds interval = std::max(period, 4) * milliseconds(8);
    for (int i = 0; i < 1000; ++i) {
      const int round = i % 320;
      now_ += round < 160 ? interval : round == 160 ? 160 * interval : milliseconds(0);
      measure({{kHeadPan, 0}});
    }
  }
  EXPECT_EQ(counters_.thinned_telemetry, 0U);
}

TEST_F(TelemetryIntakeTest, WhatNobodyAskedForEndsAfterWhatMayBeUnderWay) {
  intake_.askedFor(4);
  intake_.askedFor(0);
  for (int i = 0; i < 1000; ++i) {
    now_ += milliseconds(32);
    measure({{kHeadPan, 0}});
  }
  EXPECT_THAT(delivered_, SizeIs(160));
}

}  // namespace
}  // namespace aibo_client
