#include "movement/trajectory.h"

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"
#include "support/refusal.h"

namespace aibo_driver::movement {
namespace {

constexpr double kSpeedLimit = 3.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class TrajectoryTest : public ::testing::Test {
 protected:
  Trajectory plan(const TrajectoryRequest& request) {
    return Trajectory(request, table_, {{mouth_, -0.5}, {pan_, present_pan_, pan_velocity_}, {neck_, -0.3}});
  }

  std::string refusal(const TrajectoryRequest& request) {
    return test_support::refusalOf<aibo_client::InvalidArgumentException>([&] { plan(request); });
  }

  // For the head's pan as the second joint. The first one has a lower limit, and moves slowly.
  static TrajectoryRequest pan(std::vector<TrajectoryRequest::Point> points) {
    double neck = -0.3;
    for (TrajectoryRequest::Point& point : points) {
      point.positions.insert(point.positions.begin(), neck);
      if (!point.velocities.empty()) {
        point.velocities.insert(point.velocities.begin(), 0);
      }
      neck -= 0.02;
    }
    return {{"neck_tilt", "head_pan"}, points};
  }

  TrajectoryTest() { table_.setSpeedScale(0.5); }

  JointTable table_{"ERS-7", 2 * kSpeedLimit};
  const std::size_t pan_ = *table_.findByName("head_pan");
  const std::size_t neck_ = *table_.findByName("neck_tilt");
  const std::size_t mouth_ = *table_.findByName("mouth");
  double present_pan_ = 0;
  double pan_velocity_ = 0;
};

TEST_F(TrajectoryTest, BeginsWhereTheJointsAreAndGoesStraightFromPointToPoint) {
  present_pan_ = 0.2;
  const Trajectory trajectory = plan({{"mouth", "head_pan"}, {{1, {-0.7, 0.4}, {}}, {3, {-0.7, -0.4}, {}}}});
  EXPECT_DOUBLE_EQ(trajectory.duration(), 3);
  EXPECT_EQ(trajectory.at(0)[0].joint, mouth_);
  EXPECT_EQ(trajectory.at(0)[1].joint, pan_);
  EXPECT_NEAR(trajectory.at(0.5)[0].position, -0.6, 1e-12);
  const std::pair<double, double> pans[] = {{0, 0.2}, {0.5, 0.3}, {1, 0.4}, {2, 0}, {3, -0.4}};
  for (const auto& [time, position] : pans) {
    EXPECT_NEAR(trajectory.at(time)[1].position, position, 1e-12) << time;
  }
}

TEST_F(TrajectoryTest, PassesPointsWithTheVelocitiesGiven) {
  const Trajectory trajectory = plan(pan({{1, {0.5}, {0.8}}, {2, {1.0}, {0}}}));
  const double step = 1e-5;
  EXPECT_NEAR(trajectory.at(1)[1].position, 0.5, 1e-12);
  EXPECT_NEAR((trajectory.at(1 + step)[1].position - trajectory.at(1)[1].position) / step, 0.8, 1e-3);
  EXPECT_NEAR((trajectory.at(1)[1].position - trajectory.at(1 - step)[1].position) / step, 0.8, 1e-3);
  EXPECT_NEAR((trajectory.at(step)[1].position - trajectory.at(0)[1].position) / step, 0.0, 1e-3)
      << "it begins at rest";
  EXPECT_NEAR((trajectory.at(2)[1].position - trajectory.at(2 - step)[1].position) / step, 0.0, 1e-3);
  for (const double time : {0.3, 1.0, 1.6}) {
    EXPECT_NEAR(trajectory.at(time)[1].velocity,
                (trajectory.at(time + step)[1].position - trajectory.at(time)[1].position) / step, 1e-3);
  }
  EXPECT_EQ(plan(pan({{1, {0.5}, {}}})).at(1)[1].velocity, 0) << "it is over";
}

TEST_F(TrajectoryTest, AJointThatMovesGoesOnAndArrivesWithTheAverageVelocityUnlessOneIsGiven) {
  pan_velocity_ = 0.5;
  const Trajectory trajectory = plan(pan({{1, {1}, {}}, {2, {0}, {}}}));
  const double step = 1e-6;
  const std::pair<double, double> rows[] = {{0, 0.5}, {1 - step, 1}, {1 + step, -1}};
  for (const auto& [time, velocity] : rows) {
    EXPECT_NEAR(trajectory.at(time)[1].velocity, velocity, 1e-4) << time;
  }
}

TEST_F(TrajectoryTest, IsRefusedForTheseReasons) {
  const std::pair<TrajectoryRequest, std::string> rows[] = {
      {{{"left_ear"}, {{1, {0}, {}}}}, "no joint 'left_ear'"},
      {{{"head_pan", "head_pan"}, {{1, {0, 0}, {}}}}, "head_pan is named twice"},
      {{{}, {{1, {}, {}}}}, "points without joints"},
      {pan({{1, {}, {}}}), "point 0 has 1 positions for 2 joints"},
      {pan({{1, {0}, {}}, {2, {0}, {0, 0}}}), "point 1 has 3 velocities for 2 joints"},
      {pan({{1, {kNan}, {}}}), "not finite"},
      {pan({{1, {0}, {kNan}}}), "not finite"},
      {pan({{kNan, {0}, {}}}), "not finite"},
      {pan({{1, {0}, {}}, {1, {0.1}, {}}}), "time_from_start of point 1"},
      {pan({{-0.5, {0}, {}}}), "time_from_start of point 0"},
      {{{"tail_pan"}, {{1, {0}, {}}}}, "position of tail_pan has not been measured"},
      {pan({{5, {1.6}, {}}}), "-1.536 to 1.536 rad"},
      {pan({{5, {-1.6}, {}}}), "-1.536 to 1.536 rad"},
      {pan({{5, {1.536}, {}}}), ""},  // 88 degrees; somebody has rounded them
      {pan({{5, {-1.536}, {}}}), ""},
      {pan({{1, {-1.5}, {-1}}, {2, {-1.5}, {1}}}), "at 1.500 s, the velocities carry head_pan"},
      {pan({{1, {1.5}, {1}}, {2, {1.5}, {0}}}), "at 1.333 s, the velocities carry head_pan"},
      {pan({{1, {-1.5}, {0}}, {2, {-1.5}, {1}}}), "at 1.667 s, the velocities carry head_pan"},
      {pan({{1, {0.5}, {1}}, {2, {0.5}, {-1}}}), ""},
      {pan({{0.4, {0.1}, {}}, {0.6, {1}, {}}}),
       "from 0.400 to 0.600 s, head_pan would have to move with 4.500 rad/s; its limit is 3.000 rad/s: give it more "
       "time."},
      {pan({{0.4, {1}, {0}}}), "3.75"},  // the middle of a cubic is its fastest
      {pan({{1.0 / 3, {1}, {}}}), ""},   // exactly the limit
      {pan({{0, {0.09}, {}}, {1, {0}, {}}}), ""},
      {pan({{0, {0.11}, {}}, {1, {0}, {}}}), "at time 0, head_pan"},  // it would jump
  };
  for (const auto& [request, reason] : rows) {
    EXPECT_THAT(refusal(request), testing::HasSubstr(reason));
    EXPECT_EQ(refusal(request).empty(), reason.empty()) << "accepted";
  }
}

TEST_F(TrajectoryTest, LetsAJointThatIsBeyondItsLimitsComeBack) {
  present_pan_ = 1.6;
  EXPECT_NEAR(plan(pan({{1, {0}, {0}}})).at(0)[1].position, 1.6, 1e-12);
}

TEST_F(TrajectoryTest, TakesAFirstPointAtTime0AsThePresentPoseIfItIsNear) {
  present_pan_ = 0.05;
  const Trajectory trajectory = plan(pan({{0, {0}, {}}, {1, {1}, {}}}));
  EXPECT_DOUBLE_EQ(trajectory.at(0)[1].position, 0.05);
  EXPECT_DOUBLE_EQ(trajectory.at(1)[1].position, 1);
  EXPECT_DOUBLE_EQ(plan(pan({{0, {0}, {}}})).duration(), 0);
  EXPECT_DOUBLE_EQ(plan(pan({{0, {0}, {}}})).at(0)[1].position, 0.05) << "it stays where it is";
}

}  // namespace
}  // namespace aibo_driver::movement
