#include "client/telemetry_intake.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <vector>

#include "client/picture_intake.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int kHeadPan = 2;
constexpr int kKnee = 13;  // left_front_knee
constexpr int kHeadTouch = 5;
constexpr int kPaw = 14;
constexpr int kRangeFar = 54;
constexpr int kAcceleration = 61;
constexpr int kBattery = 66;
constexpr int kTemperature = 67;

// What version 2 can send at most.
constexpr double kLargest = std::numeric_limits<std::int32_t>::max() * 1e-6;

class TelemetryIntakeTest : public ::testing::Test {
 protected:
  /// Telemetry of the present frame.
  void measure(const std::vector<JointReading>& joints, const std::vector<SensorReading>& sensors = {},
               const std::string& design = "ERS-7") {
    Telemetry telemetry;
    telemetry.frame_number = frame_;
    telemetry.arrival = now_;
    telemetry.joints = joints;
    telemetry.sensors = sensors;
    intake_.deliver(telemetry, design);
  }

  /// @param frames of 8 ms
  void pass(unsigned frames) {
    frame_ += frames;
    now_ += frames * milliseconds(8);
  }

  /// Measures one sensor.
  /// @return whether its value was delivered
  bool isDelivered(int id, double value, const std::string& design = "ERS-7") {
    const std::size_t before = delivered_.size();
    measure({}, {{id, value}}, design);
    return delivered_.size() > before;
  }

  /// Measures where one joint is.
  bool isDeliveredAt(int id, double position, const std::string& design) {
    const std::size_t before = delivered_.size();
    measure({{id, position}}, {}, design);
    return delivered_.size() > before;
  }

  std::vector<Telemetry> delivered_;
  std::vector<std::string> log_;
  Notifier notifier_{callbacks()};
  ClientStatistics counters_;
  ConnectionContext context_{"robot:54321", milliseconds(500), notifier_, counters_, 3};
  TelemetryIntake intake_{context_};
  std::uint32_t frame_ = 1000;
  RateLimit::TimePoint now_{std::chrono::hours(1)};

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
  for (const char* design : {"ERS-7", "ERS-210"}) {
    const robot_model::RobotModel& model = *robot_model::findRobotModel(design);
    for (int i = 0; i < model.number_of_joints; ++i) {
      const robot_model::Joint& joint = model.joints[i];
      SCOPED_TRACE(std::string(design) + " " + joint.name);
      EXPECT_TRUE(isDeliveredAt(joint.identifier, 1e-6 * joint.mechanical_lowest - 0.19, design));
      EXPECT_TRUE(isDeliveredAt(joint.identifier, 1e-6 * joint.mechanical_highest + 0.19, design));
      EXPECT_FALSE(isDeliveredAt(joint.identifier, 1e-6 * joint.mechanical_lowest - 0.21, design));
      EXPECT_FALSE(isDeliveredAt(joint.identifier, 1e-6 * joint.mechanical_highest + 0.21, design));
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
  EXPECT_THAT(log_, ElementsAre(HasSubstr("the velocity of the walk forward is 2147; it can be -1 to 1")));
}

TEST_F(TelemetryIntakeTest, ARobotOfUnknownDesignMayBeAnyInTheTables) {
  EXPECT_TRUE(isDeliveredAt(kKnee, 2.6, "")) << "an ERS-210 bends so far";
  EXPECT_FALSE(isDeliveredAt(kKnee, 2.6, "ERS-7"));
  EXPECT_TRUE(isDeliveredAt(51, -1.0, "")) << "an ERS-7 wags its tail so far";
  EXPECT_FALSE(isDeliveredAt(kHeadPan, -2147, ""));
  EXPECT_TRUE(isDeliveredAt(99, 5, "")) << "a joint that is not in the tables";
  EXPECT_FALSE(isDeliveredAt(99, 2147, ""));
  EXPECT_FALSE(isDelivered(kBattery, kLargest, "ERS-9"));
}

TEST_F(TelemetryIntakeTest, AnImpossiblePositionIsDroppedCountedAndLoggedOnce) {
  for (int i = 0; i < 10; ++i) {
    measure({{kHeadPan, 0.5}, {kKnee, kLargest}}, {{kBattery, 0.5}});
    pass(4);
  }
  ASSERT_THAT(delivered_, SizeIs(10));
  for (const Telemetry& telemetry : delivered_) {
    EXPECT_THAT(telemetry.joints, ElementsAre(testing::Field(&JointReading::id, kHeadPan)));
    EXPECT_THAT(telemetry.sensors, SizeIs(1));
    EXPECT_EQ(telemetry.connection_number, 3U);
  }
  EXPECT_EQ(counters_.telemetry, 10U);
  EXPECT_EQ(counters_.impossible_values, 10U);
  EXPECT_THAT(log_, ElementsAre("robot:54321 sent an impossible value, which is dropped: the position of "
                                "left_front_knee is 2147.48; it can be -0.723599 to 2.41657."));
}

TEST_F(TelemetryIntakeTest, TelemetryOfNothingElseIsDroppedAsAWhole) {
  measure({{kKnee, -kLargest}}, {{kBattery, kLargest}});
  EXPECT_THAT(delivered_, SizeIs(0));
  EXPECT_EQ(counters_.telemetry, 0U);
  EXPECT_EQ(counters_.impossible_values, 2U);
  measure({});
  EXPECT_THAT(delivered_, SizeIs(1)) << "telemetry that was empty from the beginning";
}

TEST_F(TelemetryIntakeTest, AJointThatIsThereTwiceCountsOnce) {
  measure({{kKnee, 0.5}, {kKnee, 0.51}});
  ASSERT_THAT(delivered_, SizeIs(1));
  EXPECT_THAT(delivered_[0].joints, SizeIs(1));
  EXPECT_EQ(counters_.impossible_values, 1U);
  EXPECT_THAT(log_, ElementsAre(HasSubstr("left_front_knee appears twice")));
}

TEST_F(TelemetryIntakeTest, AJointItsDutyAndASensorWithItsNumberAreNamedOnceEach) {
  for (int i = 0; i < 2; ++i) {
    measure({{kHeadTouch, kLargest}}, {{kHeadTouch, kLargest}});
    measure({{kHeadTouch, 0, 2.147}});
  }
  EXPECT_THAT(log_, SizeIs(3));
}

TEST_F(TelemetryIntakeTest, AnImpossibleDutyIsDroppedAndItsPositionIsNot) {
  measure({{kKnee, 0.5, 2.147}, {kHeadPan, 0.5, -1.0}});
  ASSERT_THAT(delivered_, SizeIs(1));
  EXPECT_FALSE(delivered_[0].joints.at(0).duty);
  EXPECT_EQ(delivered_[0].joints.at(1).duty, -1.0);
  EXPECT_EQ(counters_.impossible_values, 1U);
  EXPECT_THAT(log_, ElementsAre(HasSubstr("the duty of left_front_knee is 2.147; it can be -1 to 1.")));
}

TEST_F(TelemetryIntakeTest, ReadingsThatASensorCanHaveAreDelivered) {
  EXPECT_TRUE(isDelivered(kBattery, 0));
  EXPECT_TRUE(isDelivered(kBattery, 1));
  EXPECT_TRUE(isDelivered(kTemperature, -5));
  EXPECT_TRUE(isDelivered(kTemperature, 70));
  EXPECT_TRUE(isDelivered(kRangeFar, 0.19)) << "nearer than it can measure: -inf in ROS (REP 117)";
  EXPECT_TRUE(isDelivered(kRangeFar, 1.6)) << "farther: inf";
  EXPECT_TRUE(isDelivered(kAcceleration, 19.6133));
  EXPECT_TRUE(isDelivered(kAcceleration, -25)) << "a shock";
  EXPECT_TRUE(isDelivered(kHeadTouch, 120)) << "about 80 is usual";
  EXPECT_TRUE(isDelivered(kPaw, 0));
  EXPECT_TRUE(isDelivered(kPaw, 1));
  EXPECT_TRUE(isDelivered(200, -kLargest)) << "a sensor that is not in the tables";
  EXPECT_EQ(counters_.impossible_values, 0U);
}

TEST_F(TelemetryIntakeTest, ReadingsThatNoSensorCanHaveAreDroppedAndNamed) {
  EXPECT_FALSE(isDelivered(kBattery, kLargest));
  EXPECT_FALSE(isDelivered(kBattery, -0.01));
  EXPECT_FALSE(isDelivered(kBattery, 1.1));
  EXPECT_FALSE(isDelivered(kTemperature, 300));
  EXPECT_FALSE(isDelivered(kTemperature, -273));
  EXPECT_FALSE(isDelivered(kRangeFar, -0.01));
  EXPECT_FALSE(isDelivered(kRangeFar, 327));
  EXPECT_FALSE(isDelivered(kAcceleration, 2000));
  EXPECT_FALSE(isDelivered(kHeadTouch, kLargest));
  EXPECT_FALSE(isDelivered(kPaw, 2));
  EXPECT_EQ(counters_.impossible_values, 10U);
  EXPECT_THAT(log_, ElementsAre(HasSubstr("battery is 2147.48; it can be 0 to 1.05."),
                                HasSubstr("temperature is 300; it can be -40 to 125."),
                                HasSubstr("range_far is -0.01; it can be 0 to 3."),
                                HasSubstr("acceleration_front_back is 2000; it can be -39.2266 to 39.2266."),
                                HasSubstr("head_touch is 2147.48; it can be 0 to 800."),
                                HasSubstr("paw_left_front is 2; it can be 0 to 1.")));
}

TEST_F(TelemetryIntakeTest, WhatComesTooOftenIsThinnedToTwiceTheRateAskedForAndThatIsSaidOnce) {
  intake_.askedFor(8);
  constexpr int kSeconds = 3;
  for (int i = 0; i < 33000 * kSeconds; ++i) {
    now_ += microseconds(30);
    frame_ += 4;
    measure({{kHeadPan, 0}});
  }
  const double twice = 2 * 15.625 * kSeconds;
  EXPECT_THAT(delivered_, SizeIs(AllOf(testing::Ge(twice), testing::Le(twice + TelemetryIntake::kMostAtOnce + 1))));
  EXPECT_EQ(counters_.telemetry, delivered_.size());
  EXPECT_EQ(counters_.thinned_telemetry, 33000 * kSeconds - delivered_.size());
  EXPECT_THAT(log_, ElementsAre(HasSubstr("more than twice as often as it was asked to")));
}

TEST_F(TelemetryIntakeTest, WhatWasAskedForIsNeverThinned) {
  for (const int period : {1, 4, 40}) {  // a server rounds 1 up to 4
    intake_.askedFor(period);
    for (int i = 0; i < 10000; ++i) {
      pass(period < 4 ? 4 : static_cast<unsigned>(period));
      measure({{kHeadPan, 0}});
    }
  }
  EXPECT_EQ(counters_.thinned_telemetry, 0U);
}

TEST_F(TelemetryIntakeTest, WhatTheRadioHeldUpIsNotThinned) {
  intake_.askedFor(4);
  for (int outage = 0; outage < 20; ++outage) {
    for (int i = 0; i < 64; ++i) {
      now_ += milliseconds(32);
      measure({{kHeadPan, 0}});
      frame_ += 4;
    }
    now_ += 64 * milliseconds(32);
    for (int i = 0; i < 64; ++i) {
      measure({{kHeadPan, 0}});
      frame_ += 4;
    }
  }
  EXPECT_EQ(counters_.thinned_telemetry, 0U);
}

TEST_F(TelemetryIntakeTest, WhatNobodyAskedForEndsAfterWhatMayBeUnderWay) {
  intake_.askedFor(4);
  intake_.askedFor(0);
  for (int i = 0; i < 1000; ++i) {
    pass(4);
    measure({{kHeadPan, 0}});
  }
  EXPECT_THAT(delivered_, SizeIs(TelemetryIntake::kMostAtOnce));
}

TEST_F(TelemetryIntakeTest, AnswersToRequestsForEachValueAreNotThinned) {
  for (int i = 0; i < 1000; ++i) {
    measure({{kHeadPan, 0}});
    frame_ += 4;
  }
  EXPECT_THAT(delivered_, SizeIs(1000));
}

}  // namespace
}  // namespace aibo_client
