// Distances, accelerations and other values, depending on the position of the body.
#include "simulator/ers7/body/sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {
namespace {

class SensorsTest : public testing::Test {
 protected:
  SensorsTest() {
    situation_.head = restingHead();
    situation_.stance.body = Eigen::Isometry3d(Eigen::Translation3d(0, 0, kStandingHeight));
  }

  static const robot_model::RobotModel& model() { return *robot_model::findRobotModel("ERS-7"); }

  int value(const char* name) const {
    return sensors_.readings(static_cast<std::size_t>(robot_model::findSensorByName(model(), name))).back().value;
  }

  void passFrames(int count = 1) {
    for (int i = 0; i < count; ++i) {
      sensors_.passFrame(situation_);
      ++situation_.frame;
    }
  }

  /// Turns the whole robot by an angle about one of its axes.
  void turn(double angle, const Eigen::Vector3d& axis) {
    situation_.stance.body = Eigen::Translation3d(0, 0, kStandingHeight) * Eigen::AngleAxisd(angle, axis);
  }

  Scene scene_;
  Sensors sensors_{model(), scene_, 1};
  Situation situation_ = {};
};

TEST_F(SensorsTest, TheChestMeasuresTheFloorInFrontOfIt) {
  passFrames();
  // By hand: the sensor is 143 - 3.4 mm over the floor and looks down by 30 degrees.
  EXPECT_NEAR(value("range_chest"), 1e6 * (kStandingHeight - 0.003384) / std::sin(std::acos(-1.0) / 6), 3000);
}

TEST_F(SensorsTest, NearAndFarMeasureTheBallWhereTheHeadLooks) {
  // From 0.25 m behind the ball and 25 mm to its left, looking level: the sensors are at the height of its centre.
  const HeadAngles level = {};
  situation_.head = level;
  const Eigen::Vector3d nose = headInBody(level) * Eigen::Vector3d(0.0769, 0, -0.0146);
  situation_.frame = 750;  // after six seconds the ball is on the axis
  situation_.stance.body =
      Eigen::Isometry3d(Eigen::Translation3d(kBallX - 0.25 - nose.x(), 0.025, kBallRadius - nose.z()));
  passFrames(7);
  const auto distance = [](double aside) {
    return 1e6 * (0.25 - std::sqrt(kBallRadius * kBallRadius - aside * aside));
  };
  EXPECT_NEAR(value("range_near"), distance(0.025 + 0.0028), 2200);
  EXPECT_NEAR(value("range_far"), distance(0.025 - 0.0080), 2200);
}

TEST_F(SensorsTest, DistancesOutOfRangeAreReportedAsTheEndOfTheRange) {
  situation_.head.neck_tilt = 0;
  situation_.head.head_tilt = 0.5;  // the ceiling
  for (int measurement = 0; measurement < 10; ++measurement) {
    passFrames(7);
    EXPECT_EQ(value("range_near"), 500000) << "no error is added at the end of the range";
    EXPECT_EQ(value("range_far"), 1500000);
  }
  situation_.stance.body = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.02));  // the chest on the floor
  passFrames(5);
  EXPECT_EQ(value("range_chest"), 100000);
}

TEST_F(SensorsTest, EachDistanceSensorHasItsPeriodAndNearAndFarMeasureInTurn) {
  // Every measurement has a different error, so each one shows.
  const auto framesOfChange = [this](const char* name, int frames) {
    std::set<longword> changes;
    for (int i = 0; i < frames; ++i) {
      const int last = value(name);
      passFrames();
      if (value(name) != last) {
        changes.insert(situation_.frame - 1);
      }
    }
    return changes;
  };
  situation_.head.head_tilt = -0.3;  // the floor, within the range of both
  passFrames();
  EXPECT_GT(value("range_far"), 100000) << "the first report has a distance, although its turn comes later";
  passFrames(11);
  EXPECT_EQ(framesOfChange("range_near", 12), (std::set<longword>{12, 18}));
  EXPECT_EQ(framesOfChange("range_far", 12), (std::set<longword>{27, 33}));
  EXPECT_EQ(framesOfChange("range_chest", 10), (std::set<longword>{40, 45}));
}

TEST_F(SensorsTest, AccelerationIsGravityAlongTheBodysAxes) {
  const auto expect = [this](double forward, double right, double up) {
    passFrames();
    EXPECT_NEAR(value("acceleration_front_back"), forward * 1e6, Sensors::kAccelerationError);
    EXPECT_NEAR(value("acceleration_right_left"), right * 1e6, Sensors::kAccelerationError);
    EXPECT_NEAR(value("acceleration_up_down"), up * 1e6, Sensors::kAccelerationError);
  };
  expect(0, 0, -9.80665);
  const double angle = std::acos(-1.0) / 6;
  turn(angle, Eigen::Vector3d::UnitY());  // the nose down by 30 degrees
  expect(9.80665 / 2, 0, -9.80665 * std::cos(angle));
  turn(angle, Eigen::Vector3d::UnitX());  // on the right side by 30 degrees
  expect(0, 9.80665 / 2, -9.80665 * std::cos(angle));
}

TEST_F(SensorsTest, ARobotThatSpeedsUpFeelsItBesideGravityUpToTheEndOfTheRange) {
  turn(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ());  // it faces along y
  situation_.acceleration = Eigen::Vector3d(0, 2, 0.5);
  passFrames();
  EXPECT_NEAR(value("acceleration_front_back"), -2e6, Sensors::kAccelerationError);
  EXPECT_NEAR(value("acceleration_right_left"), 0, Sensors::kAccelerationError);
  EXPECT_NEAR(value("acceleration_up_down"), -10.30665e6, Sensors::kAccelerationError);
  situation_.acceleration = Eigen::Vector3d(0, 0, 30);
  passFrames();
  EXPECT_EQ(value("acceleration_up_down"), -19613300);
}

}  // namespace
}  // namespace simulated_ers7
