#include "ros/joints/joint_commander.h"

#include <gmock/gmock.h>

#include <map>
#include <string>

#include "support/fake_client.h"

namespace aibo_driver::node {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr int kHeadPan = 2;

// The approach speed is 0.5 rad/s, the speed limit 3.0 rad/s.
class JointCommanderTest : public ::testing::Test {
 protected:
  void command(const std::map<std::string, double>& positions) {
    sensor_msgs::JointState message;
    for (const auto& [name, position] : positions) {
      message.name.push_back(name);
      message.position.push_back(position);
    }
    commander_.receive(message);
  }

  // Ends the approach of the head's pan.
  void arriveAt(double position) {
    command({{"head_pan", position}});
    Telemetry telemetry;
    telemetry.joints = {{kHeadPan, position}};
    measured_.update(telemetry);
    command({{"head_pan", position + 0.2}});
    client_.told.clear();
  }

  test_support::FakeClient client_;
  joints::JointTable table_{"ERS-7", 3.0};
  joints::MeasuredJoints measured_{table_};
  JointCommander commander_{table_, measured_, client_, DriverParameters()};
};

TEST_F(JointCommanderTest, SendsAMessageAtOnceAndAsAWhole) {
  command({{"head_pan", 0.5}, {"mouth", -0.5}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "V 4:0.50", "J 2:0.50 4:-0.50 in 0"));
}

TEST_F(JointCommanderTest, MovesAtTheSpeedLimitAfterTheApproach) {
  arriveAt(0.0);
  command({{"head_pan", 1.0}});
  EXPECT_THAT(client_.told, ElementsAre("J 2:1.00 in 0")) << "the speed limit is in force already";
}

TEST_F(JointCommanderTest, SendsNothingIfEverythingIsRefused) {
  command({{"third_eye", 0.5}});
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(JointCommanderTest, DropsWhatCannotBeSentAndThenApproachesAgain) {
  arriveAt(0.0);
  client_.problem = "not connected";
  command({{"head_pan", 1.0}});
  client_.problem.clear();
  EXPECT_THAT(client_.told, IsEmpty());
  command({{"head_pan", 0.5}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:0.50 in 0"));
}

TEST_F(JointCommanderTest, ApproachesAgainOverANewConnection) {
  arriveAt(0.0);
  ++client_.connections;
  command({{"head_pan", 1.0}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:1.00 in 0"));
}

TEST_F(JointCommanderTest, ApproachesAgainAfterTheMotorsWereSwitched) {
  arriveAt(0.0);
  commander_.prepareForMotors();
  command({{"head_pan", 1.0}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:1.00 in 0"));
}

TEST_F(JointCommanderTest, PreparesForAMotionWithTheSpeedLimitsOfAllJoints) {
  command({{"head_pan", 0.5}});
  client_.told.clear();
  commander_.prepareForMotion();
  EXPECT_THAT(client_.told, SizeIs(table_.size()));
  EXPECT_THAT(client_.told, Each(StartsWith("V ")));
  client_.told.clear();
  commander_.prepareForMotion();
  EXPECT_THAT(client_.told, IsEmpty()) << "they are in force already";
}

TEST_F(JointCommanderTest, SendsNothingToARobotOfAnotherDesign) {
  client_.present.robot.design = "ERS-210";
  command({{"head_pan", 0.5}});
  EXPECT_THAT(client_.told, IsEmpty());
}

}  // namespace
}  // namespace aibo_driver::node
