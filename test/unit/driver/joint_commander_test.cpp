#include "node/joints/joint_commander.h"

#include <gmock/gmock.h>

#include "support/fake_client.h"
#include "unit/driver/log_listener.h"

namespace aibo_driver::node {
namespace {

using ::testing::ElementsAre;

// The approach speed is 0.5 rad/s, the speed limit 3.0 rad/s.
class JointCommanderTest : public ::testing::Test {
 protected:
  void command(const std::map<std::string, double>& positions) {
    sensor_msgs::JointState message;
    for (const auto& [name, position] : positions) {
      message.name.push_back(name);
      message.position.push_back(position);
    }
    commander_.receive(message, order());
  }

  static movement::Order order() { return {"/user", std::chrono::steady_clock::now()}; }

  JointCommanderTest() {
    ros::Time::init();
    table_.setSpeedScale(0.5);
    mover_.connected();
  }

  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 6.0};
  movement::MeasuredJoints measured_{table_};
  movement::Mover mover_{table_, measured_, client_, 0.5};
  JointCommander commander_{table_, mover_};
};

TEST_F(JointCommanderTest, SendsAMessageAtOnceAndAsAWhole) {
  command({{"head_pan", 0.5}, {"mouth", -0.5}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "V 4:0.50", "J 2:0.50 4:-0.50 in 0"));
}

TEST_F(JointCommanderTest, WarnsOfJointsThatAreLeftOutOrClamped) {
  const std::vector<std::string>& log = test_support::listenToLog();
  command({{"head_pan", 9}, {"wing", 0}});
  EXPECT_THAT(log, ElementsAre(testing::AllOf(testing::HasSubstr("head_pan"), testing::HasSubstr("'wing'"))));
}

TEST_F(JointCommanderTest, CollectsPositionsFor4Milliseconds) {
  EXPECT_EQ(JointCommander::kCollectingTime, std::chrono::milliseconds(4));
}

TEST_F(JointCommanderTest, ATrajectoryWithoutPointsHoldsEverything) {
  command({{"head_pan", 0.5}});
  client_.told.clear();
  commander_.receive(trajectory_msgs::JointTrajectory(), order());
  EXPECT_THAT(client_.told, ElementsAre("hold"));
  ASSERT_EQ(mover_.state().ended.size(), 1u);
  EXPECT_EQ(mover_.state().ended[0].reason, "/user sent an empty trajectory");
}

TEST_F(JointCommanderTest, ATrajectoryOfAnotherTimeIsRefused) {
  trajectory_msgs::JointTrajectory message;
  message.header.stamp = ros::Time::now() - ros::Duration(10);
  message.joint_names = {"head_pan"};
  message.points.resize(1);
  commander_.receive(message, order());
  ASSERT_EQ(mover_.state().ended.size(), 1u);
  EXPECT_EQ(mover_.state().ended[0].how, aibo_client::EndedHow::kRefused);
  EXPECT_THAT(mover_.state().ended[0].reason, testing::HasSubstr("header.stamp"));
  EXPECT_EQ(mover_.state().ended[0].movement.kind, movement::Movement::Kind::kTrajectory);
  EXPECT_THAT(mover_.state().ended[0].movement.joints, ElementsAre("head_pan"));
}

TEST_F(JointCommanderTest, APositionThatCameBeforeAMessageIsSentBeforeIt) {
  commander_.receivePosition("head_pan", 0.5, order());
  command({{"head_pan", 1.0}});
  EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:0.50 in 0", "J 2:1.00 in 0"));
}

TEST_F(JointCommanderTest, PositionsOfTwoNodesAreTwoMovements) {
  const auto receive = [this](const std::string& joint, const std::string& source) {
    commander_.receivePosition(joint, 0.0, {source, std::chrono::steady_clock::now()});
  };
  receive("head_pan", "/anna");
  receive("head_tilt", "/anna");
  receive("mouth", "/bert");
  command({{"neck_tilt", 0.0}});
  ASSERT_EQ(mover_.state().movements.size(), 3u);
  EXPECT_EQ(mover_.state().movements[0].source, "/anna");
  EXPECT_THAT(mover_.state().movements[0].joints, ElementsAre("head_pan", "head_tilt"));
  EXPECT_EQ(mover_.state().movements[1].source, "/bert");
  EXPECT_THAT(mover_.state().movements[1].joints, ElementsAre("mouth"));
}

TEST_F(JointCommanderTest, KnowsACommandOfLookAt) {
  sensor_msgs::JointState message;
  message.header.frame_id = JointCommander::kLookAt;
  message.name = {"head_pan"};
  message.position = {0.5};
  commander_.receive(message, order());
  EXPECT_EQ(mover_.state().movements.at(0).kind, movement::Movement::Kind::kLookAt);
}

}  // namespace
}  // namespace aibo_driver::node
