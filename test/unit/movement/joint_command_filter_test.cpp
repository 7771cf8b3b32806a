#include "movement/joint_command_filter.h"

#include <gmock/gmock.h>

#include <cmath>

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kSpeedLimit = 3.0;
constexpr double kApproachSpeed = 0.4;  // not the usual one
constexpr int kHeadPan = 2;
constexpr int kMouth = 4;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The arrays of sensor_msgs/JointState.
struct Command {
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
};

struct Filtered {
  JointTargets targets;
  std::vector<std::string> remarks;
};

class JointCommandFilterTest : public ::testing::Test {
 protected:
  Filtered filter(const Command& command) {
    Filtered result;
    result.remarks = filter_.filter(command.names, command.positions, command.velocities, now_, &result.targets);
    return result;
  }

  // Of a joint that is commanded together with another, which is slower and goes elsewhere.
  aibo_client::JointTarget target(Command command) {
    command.names.insert(command.names.begin(), "neck_tilt");
    command.positions.insert(command.positions.begin(), -0.9);
    if (!command.velocities.empty()) {
      command.velocities.insert(command.velocities.begin(), -0.7);
    }
    const Filtered result = filter(command);
    EXPECT_THAT(result.targets, SizeIs(2));
    EXPECT_LE(result.targets.begin()->second.speed, table_.speedLimit(0));
    return result.targets.empty() ? aibo_client::JointTarget() : result.targets.rbegin()->second;
  }

  // Ends the approach of a joint.
  void arrive(const std::string& joint, double position) {
    filter({{joint}, {position}, {}});
    now_ += seconds(60);
  }

  void measure(double head_pan) {
    aibo_client::Telemetry telemetry;
    telemetry.joints = {{1, -0.4}, {kHeadPan, head_pan}, {kMouth, -0.7}};
    measured_.update(telemetry);
  }

  JointCommandFilterTest() { table_.setSpeedScale(0.5); }

  JointTable table_{"ERS-7", 2 * kSpeedLimit};
  MeasuredJoints measured_{table_};
  JointCommandFilter filter_{table_, measured_, kApproachSpeed};
  JointCommandFilter::SteadyTime now_{seconds(1000)};
};

TEST_F(JointCommandFilterTest, SaysWhichJointCannotGoWhereItIsCommanded) {
  for (const double position : {40.0, -1.54, 1e300}) {
    EXPECT_THAT(filter({{"mouth", "head_pan"}, {-0.5, position}, {}}).remarks,
                testing::ElementsAre(
                    "The position commanded for head_pan is beyond its limits, -1.536 to 1.536 rad: it goes as "
                    "far as it can."))
        << position;
    EXPECT_NEAR(target({{"head_pan"}, {position}, {}}).position, position > 0 ? 1.53589 : -1.53589, 1e-5);
  }
  EXPECT_THAT(filter({{"head_pan"}, {1.536}, {}}).remarks, IsEmpty()) << "88 degrees; somebody has rounded them";
}

TEST_F(JointCommandFilterTest, LeavesOutWhatItCannotDoSaysSoAndCarriesOutTheRest) {
  const struct {
    Command command;
    std::vector<std::string> left_out;
  } rows[] = {
      {{{"mouth"}, {-0.5}, {}}, {}},
      {{{"head_pan", "mouth", "neck_tilt"}, {kNan, -0.5, kInfinity}, {}}, {"head_pan", "neck_tilt"}},
      {{{"head_pan", "mouth"}, {0.5, -0.5}, {kNan, 0}}, {"head_pan"}},
      {{{"left_ear", "mouth", ""}, {0, -0.5, 0}, {}}, {"'left_ear'", "''"}},
  };
  for (const auto& row : rows) {
    const Filtered result = filter(row.command);
    ASSERT_THAT(result.targets, SizeIs(1));
    EXPECT_DOUBLE_EQ(result.targets.at(kMouth).position, -0.5);
    ASSERT_THAT(result.remarks, SizeIs(row.left_out.size()));
    for (std::size_t i = 0; i < row.left_out.size(); ++i) {
      EXPECT_THAT(result.remarks[i], testing::HasSubstr(row.left_out[i]));
    }
  }
}

TEST_F(JointCommandFilterTest, RefusesArraysThatDoNotFitTogether) {
  for (const Command& command :
       {Command{{"head_pan", "mouth"}, {0.5}, {}}, Command{{"head_pan"}, {}, {}}, Command{{"head_pan"}, {0.5, 0.5}, {}},
        Command{{"head_pan"}, {0.5}, {1, 1}}, Command{}}) {
    const Filtered result = filter(command);
    EXPECT_THAT(result.targets, IsEmpty());
    EXPECT_THAT(result.remarks, SizeIs(1));
  }
}

TEST_F(JointCommandFilterTest, TakesTheLastOfTwoPositionsForOneJoint) {
  EXPECT_DOUBLE_EQ(target({{"head_pan", "head_pan"}, {0.5, -0.5}, {}}).position, -0.5);
}

TEST_F(JointCommandFilterTest, LimitsTheSpeedToTheVelocityGiven) {
  arrive("head_pan", 0);
  const std::pair<double, double> rows[] = {
      {1.5, 1.5}, {-1.5, 1.5}, {100, kSpeedLimit}, {0, kSpeedLimit}};  // 0 means that none is given
  for (const auto& [velocity, speed] : rows) {
    EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.5}, {velocity}}).speed, speed);
  }
  EXPECT_GT(target({{"head_pan"}, {0.5}, {1e-12}}).speed, 0);
  const JointTargets two = filter({{"head_pan", "mouth"}, {0.5, -0.5}, {1.5, 0.2}}).targets;
  EXPECT_DOUBLE_EQ(two.at(kHeadPan).speed, 1.5);
  EXPECT_DOUBLE_EQ(two.at(kMouth).speed, 0.2) << "its own";
}

TEST_F(JointCommandFilterTest, ApproachesTheFirstPositionSlowlyEvenIfItIsRepeated) {
  measure(1.0);
  for (int i = 0; i < 25; ++i) {  // for 2.5 s, which the way of 1 rad takes
    EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.0}, {}}).speed, kApproachSpeed) << i;
    now_ += milliseconds(100);
  }
  now_ += seconds(1);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.0}, {}}).speed, kSpeedLimit);
}

TEST_F(JointCommandFilterTest, ApproachesUntilTheJointIsMeasuredNear) {
  measure(1.0);
  target({{"head_pan"}, {0.0}, {}});
  measure(0.11);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {-1.0}, {}}).speed, kApproachSpeed);
  measure(-0.91);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {-1.0}, {}}).speed, kApproachSpeed) << "no jerk at the end";
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {1.0}, {}}).speed, kSpeedLimit);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {-1.0}, {}}).speed, kSpeedLimit) << "the approach does not begin again";
}

TEST_F(JointCommandFilterTest, ApproachesNoLongerThanTheLongestWayTakesIfNothingIsMeasured) {
  for (int i = 0; i < 410; ++i) {  // for 8.2 s; 176 degrees at 0.4 rad/s take 7.7 s
    const double speed = target({{"head_pan"}, {std::sin(M_PI * i / 50)}, {}}).speed;
    EXPECT_TRUE(i > 200 || speed == kApproachSpeed) << i;
    now_ += milliseconds(20);
  }
  now_ += milliseconds(100);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.0}, {}}).speed, kSpeedLimit);
}

TEST_F(JointCommandFilterTest, ApproachesEachJointByItselfAndAgainAfterStartApproach) {
  arrive("head_pan", 0);
  const JointTargets targets = filter({{"head_pan", "mouth"}, {0.5, -0.5}, {}}).targets;
  EXPECT_DOUBLE_EQ(targets.at(kHeadPan).speed, kSpeedLimit);
  EXPECT_DOUBLE_EQ(targets.at(kMouth).speed, kApproachSpeed);
  filter_.startApproach();
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.5}, {}}).speed, kApproachSpeed);
}

TEST_F(JointCommandFilterTest, ApproachesAtTheVelocityGivenIfThatIsLower) {
  measure(1.0);
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.0}, {0.1}}).speed, 0.1);
  now_ += seconds(9);  // of the 10 that it takes
  EXPECT_DOUBLE_EQ(target({{"head_pan"}, {0.0}, {}}).speed, kApproachSpeed);
}

}  // namespace
}  // namespace aibo_driver::movement
