#include "movement/measured_joints.h"

#include <gmock/gmock.h>

#include <thread>

namespace aibo_driver::movement {

using aibo_client::Telemetry;

namespace {

using std::chrono::milliseconds;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kHeadPan = 2;

class MeasuredJointsTest : public ::testing::Test {
 protected:
  static Telemetry telemetry(std::optional<std::uint32_t> frame_number, milliseconds arrival, double position) {
    Telemetry result;
    result.frame_number = frame_number;
    result.arrival = std::chrono::steady_clock::time_point(arrival);
    result.joints = {{1, -0.2, 0.1}, {kHeadPan, position, position / 2}, {4, -0.4, 0.3}};
    return result;
  }

  double velocityOf(const std::vector<MeasuredJoint>& joints) {
    EXPECT_THAT(joints, SizeIs(3));
    const MeasuredJoint pan = joints.at(1);
    EXPECT_EQ(pan.index, pan_);
    EXPECT_EQ(pan.duty, pan.position / 2);
    EXPECT_EQ(measured_.find(pan_)->arrival, pan.arrival);
    EXPECT_EQ(joints[2].velocity, 0);
    return pan.velocity;
  }

  const JointTable table_{"ERS-7", 100};
  const std::size_t pan_ = *table_.findById(kHeadPan);
  MeasuredJoints measured_{table_};
};

TEST_F(MeasuredJointsTest, AreEmptyAtFirstAndAfterClear) {
  EXPECT_FALSE(measured_.find(pan_));
  measured_.update(telemetry(4, milliseconds(32), 0.5));
  ASSERT_TRUE(measured_.find(pan_));
  EXPECT_DOUBLE_EQ(measured_.find(pan_)->position, 0.5);
  measured_.clear();
  EXPECT_FALSE(measured_.find(pan_));
}

TEST_F(MeasuredJointsTest, ComputeVelocityFromTheRobotsTimeWheneverTelemetryArrives) {
  EXPECT_DOUBLE_EQ(velocityOf(measured_.update(telemetry(100, milliseconds(0), 0.1))), 0);
  EXPECT_NEAR(velocityOf(measured_.update(telemetry(104, milliseconds(500), 0.164))), 2.0, 1e-9);
}

TEST_F(MeasuredJointsTest, AcceptFrameNumbersThatWrapAround) {
  measured_.update(telemetry(0xFFFFFFFEu, milliseconds(0), 0.0));
  EXPECT_NEAR(velocityOf(measured_.update(telemetry(2, milliseconds(32), 0.032))), 1.0, 1e-9);
}

TEST_F(MeasuredJointsTest, ComputeVelocityFromArrivalWithoutTheRobotsTime) {
  measured_.update(telemetry(std::nullopt, milliseconds(0), 0.0));
  EXPECT_NEAR(velocityOf(measured_.update(telemetry(std::nullopt, milliseconds(900), -0.9))), -1.0, 1e-9);
}

TEST_F(MeasuredJointsTest, KeepVelocityWhenTheSameFrameComesTwice) {
  measured_.update(telemetry(100, milliseconds(0), 0.0));
  measured_.update(telemetry(104, milliseconds(32), 0.032));
  EXPECT_NEAR(velocityOf(measured_.update(telemetry(104, milliseconds(40), 0.032))), 1.0, 1e-9);
}

// So many readings in one telemetry that the update takes longer than a thread may run without a break.
TEST_F(MeasuredJointsTest, ShowOtherThreadsATelemetryAsAWhole) {
  Telemetry large;
  for (int i = 1; i <= 1000000; ++i) {
    large.joints.push_back({kHeadPan, 0.001 * i});
  }
  const double last = large.joints.back().position;
  measured_.update(telemetry(std::nullopt, milliseconds(0), 0));
  std::thread robot([&] { measured_.update(large); });
  int parts = 0;
  double seen = 0;
  while (seen != last) {
    seen = measured_.find(pan_)->position;
    parts += seen != 0 && seen != last ? 1 : 0;
  }
  robot.join();
  EXPECT_EQ(parts, 0);
}

TEST_F(MeasuredJointsTest, LeaveOutJointsThatAreNotInTheTable) {
  Telemetry strange;
  strange.joints = {{99, 0.5}};
  EXPECT_THAT(measured_.update(strange), IsEmpty());
}

}  // namespace
}  // namespace aibo_driver::movement
