#include "movement/measured_joints.h"

#include <gtest/gtest.h>

namespace aibo_driver::movement {

namespace {

using namespace std::chrono_literals;

constexpr int kHeadPan = 2;

class MeasuredJointsTest : public ::testing::Test {
 protected:
  static aibo_client::Telemetry telemetry(std::optional<std::uint32_t> frame_number, std::chrono::milliseconds arrival,
                                          double position) {
    aibo_client::Telemetry result;
    result.frame_number = frame_number;
    result.arrival = std::chrono::steady_clock::time_point(arrival);
    result.joints = {{99, 0.5}, {1, -0.2, 0.1}, {kHeadPan, position, position / 2}, {4, -0.4, 0.3}};
    return result;
  }

  const JointTable table_{"ERS-7", 100};
  const std::size_t pan_ = *table_.findById(kHeadPan);
  MeasuredJoints measured_{table_};
};

TEST_F(MeasuredJointsTest, HaveTheVelocityBetweenTheLastTwoMeasurements) {
  struct Measurement {
    std::optional<std::uint32_t> frame;
    std::chrono::milliseconds arrival;
    double position;
  };
  const std::tuple<const char*, std::vector<Measurement>, double> rows[] = {
      {"the first one", {{100, 0ms, 0.1}}, 0},
      {"in the robot's time", {{100, 0ms, 0.1}, {104, 500ms, 0.164}}, 2},
      {"frames that wrap around", {{0xFFFFFFFEu, 0ms, 0}, {2, 32ms, 0.032}}, 1},
      {"by arrival without the robot's time", {{std::nullopt, 0ms, 0}, {std::nullopt, 900ms, -0.9}}, -1},
      {"a frame that comes twice", {{100, 0ms, 0}, {104, 32ms, 0.032}, {104, 40ms, 0.032}}, 1},
  };
  for (const auto& [name, measurements, velocity] : rows) {
    measured_.clear();
    EXPECT_FALSE(measured_.find(pan_)) << name;
    for (const Measurement& each : measurements) {
      measured_.update(telemetry(each.frame, each.arrival, each.position));
    }
    const std::optional<MeasuredJoint> pan = measured_.find(pan_);
    ASSERT_TRUE(pan) << name;
    EXPECT_NEAR(pan->velocity, velocity, 1e-9) << name;
    EXPECT_EQ(pan->position, measurements.back().position) << name;
    EXPECT_EQ(pan->duty, pan->position / 2) << name;
    EXPECT_EQ(pan->arrival.time_since_epoch(), measurements.back().arrival) << name;
  }
}

}  // namespace
}  // namespace aibo_driver::movement
