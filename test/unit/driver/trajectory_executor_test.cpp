#include "ros/joints/trajectory_executor.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "aibo_driver/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::node {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint32_t kHighest = std::numeric_limits<std::uint32_t>::max();

const ros::Time kNow(1800000000, 500000000);

std::string refusalOf(const ros::Time& stamp, const ros::Time& now) {
  try {
    waitBeforeStart(stamp, now);
  } catch (const InvalidArgumentException& error) {
    return error.what();
  }
  return "none";
}

TEST(WaitBeforeStart, IsTheTimeUntilTheStamp) {
  EXPECT_EQ(waitBeforeStart(ros::Time(), kNow), milliseconds(0));
  EXPECT_EQ(waitBeforeStart(kNow - ros::Duration(0.9), kNow), milliseconds(0));
  EXPECT_NEAR(static_cast<double>(waitBeforeStart(kNow + ros::Duration(2.5), kNow).count()), 2.5e9, 1e3);
}

TEST(WaitBeforeStart, IsRefusedForAnOldStamp) {
  EXPECT_THAT(refusalOf(kNow - ros::Duration(1.5), kNow), HasSubstr("1.500000 s ago"));
}

TEST(WaitBeforeStart, IsRefusedForAStampThatCannotBeMeant) {
  EXPECT_THAT(refusalOf(kNow + ros::Duration(4000), kNow), HasSubstr("4000.000000 s ahead"));
  ros::Time garbage;
  garbage.sec = garbage.nsec = kHighest;
  EXPECT_THAT(refusalOf(garbage, kNow), HasSubstr("s ahead"));
  EXPECT_THAT(refusalOf(ros::Time(kHighest, 0), ros::Time(5, 0)), HasSubstr("s ahead")) << "under /use_sim_time";
  EXPECT_THAT(refusalOf(ros::Time(1, 0), ros::Time(kHighest, 0)), HasSubstr("s ago"));
}

class TrajectoryExecutorTest : public ::testing::Test {
 protected:
  TrajectoryExecutorTest() {
    ros::Time::init();
    Telemetry telemetry;
    telemetry.joints = {{kHeadPan, 0.0}};
    measured_.update(telemetry);
  }

  static trajectory_msgs::JointTrajectory trajectory(double position, double seconds) {
    trajectory_msgs::JointTrajectory message;
    message.joint_names = {"head_pan"};
    message.points.resize(1);
    message.points[0].positions = {position};
    message.points[0].time_from_start = ros::Duration(seconds);
    return message;
  }

  static constexpr int kHeadPan = 2;

  test_support::FakeClient client_;
  joints::JointTable table_{"ERS-7", 3.0};
  joints::MeasuredJoints measured_{table_};
  joints::JointLink link_{client_};
  TrajectoryExecutor executor_{table_, measured_, link_, false};
};

TEST_F(TrajectoryExecutorTest, BeginsWithWhereTheJointsShouldBeSoon) {
  executor_.receive(trajectory(1.0, 1.0));
  EXPECT_THAT(client_.told, ElementsAre("V 2:3.00", "J 2:0.10 in 96"));
}

TEST_F(TrajectoryExecutorTest, SendsNothingIfATrajectoryIsRefused) {
  executor_.receive(trajectory(1.0, 0.1));
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(TrajectoryExecutorTest, RefusesATrajectoryForARobotOfAnotherDesignBeforeItBegins) {
  client_.present.robot.design = "ERS-210";
  joints::JointLink link{client_, "ERS-7"};
  TrajectoryExecutor executor(table_, measured_, link, false);
  trajectory_msgs::JointTrajectory later = trajectory(1.0, 1.0);
  later.header.stamp = ros::Time::now() + ros::Duration(60);
  ::testing::internal::CaptureStderr();
  executor.receive(later);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("it is an ERS-210"));
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(TrajectoryExecutorTest, WithoutPointsStopsTheJointsOfTheTrajectory) {
  executor_.receive(trajectory(0.01, 10.0));
  client_.told.clear();
  executor_.receive(trajectory_msgs::JointTrajectory());
  EXPECT_THAT(client_.told, ElementsAre("J 2:0.00 in 0"));
  client_.told.clear();
  executor_.receive(trajectory_msgs::JointTrajectory());
  EXPECT_THAT(client_.told, IsEmpty()) << "nothing moves any more";
}

TEST_F(TrajectoryExecutorTest, GivesWayOnlyToACommandForOneOfItsJoints) {
  executor_.receive(trajectory(0.01, 10.0));
  client_.told.clear();
  executor_.yieldTo({{kHeadPan + 1, {0.0, 1.0}}});
  executor_.receive(trajectory_msgs::JointTrajectory());
  EXPECT_THAT(client_.told, ElementsAre("J 2:0.00 in 0")) << "it went on until now";

  executor_.receive(trajectory(0.01, 10.0));
  client_.told.clear();
  executor_.yieldTo({{kHeadPan, {0.0, 1.0}}});
  executor_.receive(trajectory_msgs::JointTrajectory());
  EXPECT_THAT(client_.told, IsEmpty());
}

}  // namespace
}  // namespace aibo_driver::node
