// The topic body_pose: how fast it moves the joints, and when it is refused.
#include "node/walk/body_pose_commander.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "support/fake_client.h"
#include "unit/driver/log_listener.h"

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using aibo_client::MotorState;
using aibo_client::PostureNow;
using testing::IsEmpty;

// A robot that stands.
class BodyPoseCommanderTest : public ::testing::Test {
 protected:
  BodyPoseCommanderTest() {
    client_.present.robot.capabilities = {"I", "S", "E"};
    mover_.connected();
    become(PostureNow::kStanding);
  }

  void become(PostureNow posture) { mover_.robotChanged({MotorState::kOn, posture}); }

  static geometry_msgs::Pose poseAt(double z, double pitch = 0) {
    geometry_msgs::Pose pose;
    pose.position.z = z;
    pose.orientation.y = std::sin(pitch / 2);
    pose.orientation.w = std::cos(pitch / 2);
    return pose;
  }

  // The positions of the joints, by their identifiers.
  std::map<int, double> positionsAt(double height, double pitch, double roll = 0) const {
    std::map<int, double> positions;
    const walk::OffsetLegs legs = walk::findLegs({height, roll, pitch}, table_);
    for (std::size_t i = 0; i < walk::kLegs; ++i) {
      const auto id = [i](int joint) { return robot_model::legJointIdentifier(static_cast<walk::Leg>(i), joint); };
      positions[id(0)] = legs.angles[i].rotator;
      positions[id(1)] = legs.angles[i].elevator;
      positions[id(2)] = legs.angles[i].knee;
    }
    return positions;
  }

  static movement::Order order() { return {"/user", std::chrono::steady_clock::now()}; }

  // Why this pose is refused; empty if it is sent.
  std::string refusalOf(const geometry_msgs::Pose& pose) {
    client_.told.clear();
    commander_.receive(pose, order());
    return client_.told.empty() ? mover_.state().ended.back().reason : "";
  }

  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  movement::Mover mover_{table_, measured_, client_, movement::kNoSpeedLimit};
  BodyPoseCommander commander_{table_, measured_, mover_};
};

TEST_F(BodyPoseCommanderTest, AllJointsArriveAtTheSameTimeAndTheFastestMovesAt45DegreesPerSecond) {
  const std::map<int, double> before = positionsAt(0, 0);
  aibo_client::Telemetry telemetry;
  for (const auto& [id, position] : before) {
    telemetry.joints.push_back({id, position});
  }
  measured_.update(telemetry);
  ASSERT_EQ(refusalOf(poseAt(0.01, -0.1)), "");
  double fastest = 0;
  std::vector<double> times;
  for (const auto& [id, position] : positionsAt(0.01, -0.1)) {
    const double speed = client_.speed_limits.at({client_.connections, id});
    times.push_back(std::abs(position - before.at(id)) / speed);
    fastest = std::max(fastest, speed);
  }
  EXPECT_THAT(times, testing::Each(testing::DoubleNear(times[0], 0.001)));
  EXPECT_NEAR(fastest, 0.785, 1e-9);
}

// A turn to the left, then nose down, then the right side down: yaw 1, pitch 0.06, roll 0.05.
TEST_F(BodyPoseCommanderTest, IsTheHeightRollAndPitchOfThePose) {
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.06, Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX());
  geometry_msgs::Pose pose = poseAt(0.005);
  pose.position.x = 2;
  pose.position.y = -3;
  pose.orientation.w = turn.w();
  pose.orientation.x = turn.x();
  pose.orientation.y = turn.y();
  pose.orientation.z = turn.z();
  const std::vector<std::string>& log = test_support::listenToLog();
  ASSERT_EQ(refusalOf(pose), "");
  std::string expected = "J";
  for (const auto& [id, position] : positionsAt(0.005, 0.06, 0.05)) {
    char text[32];
    std::snprintf(text, sizeof text, " %d:%.2f", id, position);
    expected += text;
  }
  EXPECT_EQ(client_.told.back(), expected + " in 0");
  EXPECT_THAT(log, IsEmpty()) << "it is possible";
  ASSERT_EQ(mover_.state().movements.size(), 1U);
  EXPECT_EQ(mover_.state().movements[0].kind, movement::Movement::Kind::kCommand);
}

TEST_F(BodyPoseCommanderTest, BeyondWhatIsPossibleAWarningNamesTheLimit) {
  const std::vector<std::string>& log = test_support::listenToLog();
  ASSERT_EQ(refusalOf(poseAt(1)), "");
  EXPECT_THAT(log, testing::ElementsAre(testing::HasSubstr("the legs are too short")));
}

TEST_F(BodyPoseCommanderTest, RefusesWhatIsNoPose) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const char* const not_finite = "the pose has a value that is NaN or infinite";
  EXPECT_EQ(refusalOf(poseAt(kNan)), not_finite);
  EXPECT_EQ(refusalOf(poseAt(kInfinity)), not_finite);
  EXPECT_EQ(refusalOf(poseAt(0, kNan)), not_finite);
  EXPECT_EQ(refusalOf(geometry_msgs::Pose()), "the orientation of the pose is not a unit quaternion; w: 1.0 is level");
}

TEST_F(BodyPoseCommanderTest, MovesOnlyARobotThatSaysThatItStands) {
  for (const PostureNow posture : {PostureNow::kUnknown, PostureNow::kSitting, PostureNow::kLying, PostureNow::kWalking,
                                   PostureNow::kFallen, PostureNow::kCarried}) {
    become(posture);
    EXPECT_EQ(refusalOf(poseAt(0)), "body_pose moves only a robot that stands; call stand")
        << static_cast<int>(posture);
  }
  become(PostureNow::kStanding);
  EXPECT_EQ(refusalOf(poseAt(0)), "");
  mover_.disconnected();
  EXPECT_NE(refusalOf(poseAt(0)), "") << "nobody knows how it stands";
}

TEST_F(BodyPoseCommanderTest, DoesNotInterruptWhatMovesTheRobot) {
  mover_.takePosture(order(), aibo_client::Posture::kSit);
  EXPECT_EQ(refusalOf(poseAt(0)), "body_pose does not interrupt the posture sit");
  mover_.ended({aibo_client::EndedKind::kPosture, EndedHow::kDone, "", "", client_.order()});
  mover_.play(order(), "nod", 1);
  EXPECT_EQ(refusalOf(poseAt(0)), "body_pose does not interrupt the motion nod");
  mover_.ended({aibo_client::EndedKind::kMotion, EndedHow::kDone, "", "", client_.order()});
  mover_.steer(order(), {0.1, 0, 0});
  EXPECT_EQ(refusalOf(poseAt(0)), "body_pose does not interrupt the walk");
}

TEST_F(BodyPoseCommanderTest, IsEndedByAStopUntilRelease) {
  ASSERT_EQ(refusalOf(poseAt(0.01)), "");
  mover_.stop({"/panel", std::chrono::steady_clock::now()});
  EXPECT_EQ(client_.told.back(), "hold");
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  EXPECT_EQ(refusalOf(poseAt(0.02)), "stopped by /panel; call release");
  mover_.release(order());
  EXPECT_EQ(refusalOf(poseAt(0.02)), "");
}

}  // namespace
}  // namespace aibo_driver::node
