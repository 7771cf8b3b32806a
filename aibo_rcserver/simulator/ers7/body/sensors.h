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

struct Situation {
  longword frame;
  HeadAngles head;
  Stance stance;
  Eigen::Vector3d acceleration =
      Eigen::Vector3d::Zero();  ///< of the body in the room's coordinates, in m/s^2, without gravity
};

struct RangeFinder;

/// All sensors, in the order of the robot's table, in the units of robot_model.h.
///
/// Distance sensors cast rays into the scene from head and body; the robot's own legs are not in the scene. A distance
/// outside the range (Model Information ERS-7) reads as the end of the range. The near and far sensors measure
/// alternately, each every 48 ms, and the chest sensor every 40 ms (Sony: about 50 and 40 ms). Values repeat in
/// between. Errors are up to kDistanceError of the distance (our choice).
///
/// Acceleration is gravity along the axes forward, right and up: up-down is -9.8 m/s^2 on a level robot, and front-back
/// is positive if the nose points down. An acceleration of the body has the opposite sign: speeding up forward makes
/// front-back negative. Turning and tilting add nothing. Errors are up to kAccelerationError (our choice).
///
/// A touch sensor reads kTouchStrength, half of its range, while it is pressed, and less than 3 otherwise. An ERS-210's
/// force sensors read half of their range while pressed, and otherwise 0; its temperature sensor kRoomTemperature. A
/// paw's switch is on while the foot is on the floor (stance.h) or the switch is pressed. Other switches are on while
/// pressed. The WLAN switch is on at first.
class Sensors {
 public:
  static constexpr double kDistanceError = 0.01;
  static constexpr int kAccelerationError = 50000;  ///< micrometres/s^2
  static constexpr int kTouchStrength = 40;
  static constexpr int kRoomTemperature = 25000000;  ///< millionths of a degree Celsius

  using Readings = std::array<OSensorValue, Joint::kReadings>;

  /// @param model, scene must outlive the sensors
  /// @param seed the seed of the errors; the same seed and situations give the same readings
  Sensors(const robot_model::RobotModel& model, const Scene& scene, std::uint64_t seed);

  /// Call this every 8 ms. All sensors measure at the end of this time.
  void passFrame(const Situation& situation);

  /// @param name the name in robot_model.h
  /// @throw std::invalid_argument there is no such sensor, or it cannot be pressed; the text names the sensors that can
  ///   be pressed
  void press(const std::string& name, bool pressed);

  /// One reading at the end of each of the last frames, in order of time; 0 before the first frame.
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
