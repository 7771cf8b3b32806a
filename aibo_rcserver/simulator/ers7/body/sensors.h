/// @file sensors.h
/// What the simulated robot feels: all its sensors but joints, camera and battery.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSORS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSORS_H

#include <OPENR/ODataFormats.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/joint.h"
#include "simulator/ers7/body/stance.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// Where the body is when its sensors measure.
struct Situation {
  longword frame;  ///< of OPEN-R
  HeadAngles head;
  Stance stance;
};

struct RangeFinder;

/// Sensors are in the order of the robot's table. Values are in the units of robot_model.h.
///
/// - The distance sensors are rays into the scene from where head and body are; the robot's own legs are not in it.
/// What
///   is nearer or farther than their range (Model Information ERS-7) is measured as its end. Near and far measure in
///   turn, each every 48 ms, the chest's every 40 ms (Sony: about 50 and 40 ms); in between they repeat. Errors are up
///   to kDistanceError of the distance, our choice.
/// - Accelerations are gravity's part along the axes forward, right and up: up-down is -9.8 m/s^2 in a robot that
/// stands
///   level, front-back above 0 in one whose nose points down. Movements add nothing. Errors are up to
///   kAccelerationError, our choice.
/// - Touch sensors feel kTouchStrength while they are pressed, which is half of their range, and less than 3 else.
/// - A paw's switch is on while its foot is on the floor (stance.h) or somebody presses it; the other switches while
///   somebody presses them. The WLAN switch is on at first.
class Sensors {
 public:
  static constexpr double kDistanceError = 0.01;
  static constexpr int kAccelerationError = 50000;  ///< micrometre/s^2
  static constexpr int kTouchStrength = 40;

  using Readings = std::array<OSensorValue, Joint::kReadings>;

  /// @param model must outlive the sensors
  /// @param scene is moved on to the time of what is measured; must outlive the sensors
  /// @param seed of the errors. The same seed and situations give the same readings
  Sensors(const robot_model::RobotModel& model, Scene& scene, std::uint64_t seed);

  /// 8 ms pass, at whose end all is measured.
  void passFrame(const Situation& situation);

  /// Somebody presses a switch or touches a touch sensor, or no longer does.
  /// @param name in robot_model.h
  /// @throw std::invalid_argument if there is no such sensor, or it cannot be pressed; the text names those that can
  void press(const std::string& name, bool pressed);

  /// What was measured at the end of each of the last frames, the last one last; 0 before the first.
  const Readings& readings(std::size_t sensor) const { return sensors_[sensor].readings; }

 private:
  struct Sensor {
    const robot_model::Sensor* model;
    std::function<int(const Situation&)> measure;
    bool pressed;
    Readings readings;
  };

  std::function<int(const Situation&)> measurementOf(const robot_model::Sensor& model, std::size_t sensor);
  int distance(std::size_t sensor, const RangeFinder& finder, const Situation& situation);
  int acceleration(const Eigen::Vector3d& axis, const Situation& situation);
  int errorUpTo(int most);

  Scene& scene_;
  std::mt19937_64 random_;
  std::vector<Sensor> sensors_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSORS_H
