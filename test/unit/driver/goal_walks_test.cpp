// Walks to goals: which goals are refused, and how a walk ends.
#include "node/walk/goal_walks.h"

#include <gmock/gmock.h>
#include <ros/time.h>

#include <cmath>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "support/fake_client.h"

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using ::testing::HasSubstr;

class GoalWalksTest : public ::testing::Test {
 protected:
  GoalWalksTest() {
    ros::Time::setNow(ros::Time(1000));
    client_.present.robot.capabilities = {"I", "S", "E", "O"};
    client_.present.robot.walk_limits = {0.15, 0.1, 0.06, 1.2};
    parameters_.walk.scale = 0.5;
    parameters_.walk.turn_scale = 2;
  }

  ~GoalWalksTest() override { ros::Time::init(); }

  // All poses are relative to this one, except those in the frame of the robot.
  static constexpr walk::PlanePose kOrigin{3, -2, 0.7};

  static geometry_msgs::PoseStamped goalAt(double x, double y = 0, const std::string& frame = "odom") {
    const bool is_of_robot = frame.find("/base") != std::string::npos;
    const walk::PlanePose pose = is_of_robot ? walk::PlanePose{x, y, 0} : walk::inFrameOf(kOrigin, {x, y, 0});
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = frame;
    goal.pose.position.x = pose.x;
    goal.pose.position.y = pose.y;
    goal.pose.orientation.z = std::sin(pose.yaw / 2);
    goal.pose.orientation.w = std::cos(pose.yaw / 2);
    return goal;
  }

  movement::Mover::Answer begin(const geometry_msgs::PoseStamped& goal) {
    const GoalWalks::Begun begun = walks_.begin(goal, {"/user", now_});
    left_ = begun.left;
    return begun.answer;
  }

  std::string refusalOf(const geometry_msgs::PoseStamped& goal) {
    const movement::Mover::Answer walk = begin(goal);
    const movement::EndedMovement* const end = walk.ended();
    EXPECT_EQ(mover_.state().ended.back().reason, end != nullptr ? end->reason : "it is not refused");
    EXPECT_EQ(lastVelocity(), "") << "the robot moves";
    return end != nullptr && end->how == EndedHow::kRefused ? end->reason : "it is not refused";
  }

  std::string lastVelocity() {
    std::string last;
    for (const std::string& told : std::exchange(client_.told, {})) {
      last = told.rfind("steer", 0) == 0 ? told : last;
    }
    return last;
  }

  // The robot walks with the commanded velocity.
  void walkOn(const movement::Mover::Answer& walk, double forward) {
    now_ += GoalWalks::kPeriod;
    here_->x += forward;
    walks_.advance();
    EXPECT_EQ(walk.ended(), nullptr);
    walk_order_ = walk_order_ == 0 ? client_.order() : walk_order_;
    mover_.steered({0.1, 0, 0}, client_.order(), walk_order_);
  }

  std::uint64_t walk_order_ = 0;  // of the velocity that began the walk
  movement::SteadyTime now_ = movement::SteadyTime(std::chrono::seconds(1000));
  const movement::Mover::Clock clock_ = [this] { return now_; };
  std::optional<walk::PlanePose> here_ = walk::PlanePose{1, 0, 0};
  DriverParameters parameters_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  test_support::FakeClient client_;
  movement::Mover mover_{table_, measured_, client_, 0.5, clock_};
  std::shared_ptr<const GoalWalks::Left> left_;  // of the latest walk
  GoalWalks walks_{parameters_, client_, mover_,
                   [this] { return here_ ? std::make_optional(walk::inFrameOf(kOrigin, *here_)) : std::nullopt; },
                   clock_};
};

TEST_F(GoalWalksTest, AGoalThatMakesNoSenseIsRefusedWithTheReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  geometry_msgs::PoseStamped goal = goalAt(2);
  geometry_msgs::Pose& pose = goal.pose;
  for (double* const number : {&pose.position.x, &pose.position.y, &pose.position.z, &pose.orientation.x,
                               &pose.orientation.y, &pose.orientation.z, &pose.orientation.w}) {
    for (const double wrong : {nan, std::numeric_limits<double>::infinity()}) {
      const double before = std::exchange(*number, wrong);
      EXPECT_THAT(refusalOf(goal), HasSubstr("NaN or infinite"));
      *number = before;
    }
  }
  for (const double length : {0, 2}) {
    goal.pose.orientation.w = length;
    EXPECT_THAT(refusalOf(goal), HasSubstr("unit quaternion"));
  }
  EXPECT_THAT(refusalOf(goalAt(2, 0, "map")), HasSubstr("'map'; it must be odom, base_link or base_footprint"));
  EXPECT_THAT(refusalOf(goalAt(2, 0, "")), HasSubstr("it must be odom"));
  EXPECT_THAT(refusalOf(goalAt(2, 0, "\x1b[31mmap")), HasSubstr("it must be odom"));
  EXPECT_THAT(refusalOf(goalAt(21.5)), HasSubstr("20.5 m away, and 20 m are allowed"));
  EXPECT_THAT(refusalOf(goalAt(1e300)), HasSubstr("m are allowed"));
  goal = goalAt(2);
  goal.header.stamp = ros::Time::now() - ros::Duration(0.51);
  EXPECT_THAT(refusalOf(goal), HasSubstr("too old"));
  here_.reset();
  EXPECT_THAT(refusalOf(goalAt(2)), HasSubstr("there is no odometry"));
}

TEST_F(GoalWalksTest, FramesHaveThePrefixAndMayBeginWithASlash) {
  parameters_.frame_prefix = "left";
  EXPECT_THAT(refusalOf(goalAt(2)), HasSubstr("it must be left/odom"));
  EXPECT_EQ(begin(goalAt(2, 0, "left/odom")).ended(), nullptr);
  EXPECT_EQ(begin(goalAt(2, 0, "/left/odom")).ended(), nullptr);
  here_ = walk::PlanePose{1, 3, 1.57079633};
  for (const std::string frame : {"left/base_link", "/left/base_footprint"}) {
    EXPECT_EQ(begin(goalAt(2, 0.5, "left/odom")).ended(), nullptr);
    EXPECT_EQ(begin(goalAt(2, 0.5, frame)).ended(), nullptr);
    ASSERT_EQ(mover_.state().movements.size(), 1U);
    EXPECT_EQ(mover_.state().movements[0].name, "to x 0.16 m, y 2.15 m, yaw 2.27 rad") << "2 m ahead of the robot";
  }
}

TEST_F(GoalWalksTest, AsFarAsIsAllowedItWalks) {
  EXPECT_THAT(refusalOf(goalAt(-19.01)), HasSubstr("20.01 m away"));
  geometry_msgs::PoseStamped farthest = goalAt(21);
  EXPECT_EQ(begin(farthest).ended(), nullptr);
  farthest.header.stamp = ros::Time::now() - ros::Duration(0.49);
  EXPECT_EQ(begin(farthest).ended(), nullptr) << "half a second old";
  farthest.header.stamp = ros::Time::now() + ros::Duration(5);
  EXPECT_EQ(begin(farthest).ended(), nullptr) << "the clock of its sender is ahead";
  farthest.header.stamp = ros::TIME_MAX;
  EXPECT_EQ(begin(farthest).ended(), nullptr);
}

TEST_F(GoalWalksTest, SaysWhatIsLeftOfTheWayAndAtTheEndHowItEnded) {
  here_->yaw = 0.4;
  const movement::Mover::Answer walk = begin(goalAt(4, 4));
  walkOn(walk, 0);
  EXPECT_NEAR(left_->distance, 5, 1e-9);
  EXPECT_NEAR(left_->turn, -0.4, 1e-9);
  lastVelocity();
  mover_.disconnected();
  client_.problem = "there is no robot";
  here_ = walk::PlanePose{4, 0, 1};
  walks_.advance();
  ASSERT_NE(walk.ended(), nullptr);
  EXPECT_EQ(walk.ended()->how, EndedHow::kLost);
  EXPECT_NEAR(left_->distance, 5, 1e-9) << "it is not looked at any more";
  EXPECT_EQ(lastVelocity(), "");
}

TEST_F(GoalWalksTest, TheRobotWalksWithinTheLimitsUntilItIsThere) {
  const movement::Mover::Answer walk = begin(goalAt(2));
  walkOn(walk, 0);
  EXPECT_EQ(lastVelocity(), "steer 0.15 0.00 0.00") << "as fast as the robot can";
  parameters_.walk.speed_limit = 0.05;
  walkOn(walk, 0);
  EXPECT_EQ(lastVelocity(), "steer 0.10 0.00 0.00");
  EXPECT_NEAR(left_->distance, 1, 1e-9);
  walkOn(walk, 0.97);
  EXPECT_EQ(lastVelocity(), "steer 0.06 0.00 0.00");
  walkOn(walk, 0.02);
  EXPECT_EQ(lastVelocity(), "steer 0.00 0.00 0.00");
  walkOn(walk, 0.05);
  EXPECT_EQ(lastVelocity(), "") << "it overshoots while it stops, and does not walk back";
  mover_.ended({aibo_client::EndedKind::kWalk, EndedHow::kDone, "", "", walk_order_});
  walks_.advance();
  ASSERT_NE(walk.ended(), nullptr);
  EXPECT_EQ(walk.ended()->how, EndedHow::kDone);
}

TEST_F(GoalWalksTest, ARobotThatMayNotTurnIsNotAtAGoalForWhichItWouldHaveTo) {
  parameters_.walk.turn_limit = 0;
  const movement::Mover::Answer walk = begin(goalAt(2));
  walkOn(walk, 0.02);
  here_->yaw = 2;
  walks_.advance();
  EXPECT_EQ(lastVelocity(), "steer 0.00 0.00 0.00");
  mover_.ended({aibo_client::EndedKind::kWalk, EndedHow::kDone, "", "", walk_order_});
  walks_.advance();
  ASSERT_NE(walk.ended(), nullptr);
  EXPECT_EQ(walk.ended()->how, EndedHow::kStopped);
  EXPECT_THAT(walk.ended()->reason, HasSubstr("the limit is 0"));
}

TEST_F(GoalWalksTest, ARobotThatComesNoCloserStops) {
  const movement::Mover::Answer walk = begin(goalAt(2));
  for (int i = 0; i < 210; ++i) {
    walkOn(walk, i < 20 ? 0.02 : 0);
  }
  EXPECT_NE(lastVelocity(), "steer 0.00 0.00 0.00") << "its patience begins again with each step";
  for (int i = 0; i < 15; ++i) {
    walkOn(walk, 0);
  }
  EXPECT_EQ(lastVelocity(), "steer 0.00 0.00 0.00");
  mover_.ended({aibo_client::EndedKind::kWalk, EndedHow::kDone, "", "", walk_order_});
  EXPECT_EQ(walk.ended()->how, EndedHow::kStopped);
  EXPECT_THAT(walk.ended()->reason, HasSubstr("no closer to the goal for 20 s"));
}

TEST_F(GoalWalksTest, WithoutOdometryItStops) {
  const movement::Mover::Answer walk = begin(goalAt(2));
  walkOn(walk, 0.02);
  here_.reset();
  now_ += GoalWalks::kPeriod;
  walks_.advance();
  EXPECT_EQ(walk.ended(), nullptr);
  EXPECT_EQ(lastVelocity(), "steer 0.00 0.00 0.00");
  walks_.advance();
  EXPECT_EQ(walk.ended(), nullptr) << "the robot has not stopped yet";
  mover_.ended({aibo_client::EndedKind::kWalk, EndedHow::kDone, "", "", walk_order_});
  EXPECT_THAT(walk.ended()->reason, HasSubstr("has not said where it is"));
}

}  // namespace
}  // namespace aibo_driver::node
