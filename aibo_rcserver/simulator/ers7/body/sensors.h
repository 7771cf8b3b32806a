/// @file sensors.h
/// All sensors of the simulated robot except joints, camera and battery.
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

/// Time and position of the body during a measurement.
struct Situation {
  longword frame;  ///< of OPEN-R
  HeadAngles head;
  Stance stance;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< of the body in the room, without gravity, in m/s^2
};

struct RangeFinder;

/// Sensors are in the order of the robot's table. Values are in the units of robot_model.h.
///
/// The distance sensors cast rays into the scene from head and body; the robot's own legs are not in it. Distances
/// outside a sensor's range (Model Information ERS-7) are reported as the end of the range. Near and far measure in
/// turn, each every 48 ms, the chest every 40 ms (Sony: about 50 and 40 ms); in between they repeat their values.
/// Errors are up to kDistanceError of the distance, which is our choice.
///
/// Accelerations are the components of gravity along the axes forward, right and up: up-down is -9.8 m/s^2 if the robot
/// is level, front-back is positive if the nose points down. A robot that speeds up feels that as the opposite: forward
/// makes front-back negative. Turning and tilting add nothing. Errors are up to kAccelerationError, which is our
/// choice.
///
/// Touch sensors report kTouchStrength, half of their range, while they are pressed, and otherwise less than 3. A paw's
/// switch is on while its foot is on the floor (stance.h) or it is pressed, other switches while they are pressed. The
/// WLAN switch is on at first.
class Sensors {
 public:
  static constexpr double kDistanceError = 0.01;
  static constexpr int kAccelerationError = 50000;  ///< micrometre/s^2
  static constexpr int kTouchStrength = 40;

  using Readings = std::array<OSensorValue, Joint::kReadings>;

  /// @param model must outlive the sensors
  /// @param scene what there is to measure; must outlive the sensors
  /// @param seed of the errors. The same seed and situations give the same readings
  Sensors(const robot_model::RobotModel& model, const Scene& scene, std::uint64_t seed);

  /// 8 ms pass; everything is measured at the end.
  void passFrame(const Situation& situation);

  /// Presses or releases a switch or a touch sensor.
  /// @param name as in robot_model.h
  /// @throw std::invalid_argument if there is no such sensor, or it cannot be pressed; the text names those that can
  void press(const std::string& name, bool pressed);

  /// The readings at the end of each of the last frames, the latest one last; 0 before the first.
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
  int acceleration(std::size_t sensor, const Eigen::Vector3d& axis, const Situation& situation);
  int errorUpTo(int most);

  const Scene& scene_;
  std::mt19937_64 random_;
  std::vector<Sensor> sensors_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_SENSORS_H
