/// @file sensor_messages.h
/// ROS messages made from telemetry. The messages have no header yet. A source has kRemembers if its next message
/// depends on earlier telemetry. Such a source has to read all telemetry, even if nobody listens.
#ifndef AIBO_DRIVER_NODE_BODY_SENSOR_MESSAGES_H
#define AIBO_DRIVER_NODE_BODY_SENSOR_MESSAGES_H

#include <aibo_driver/Touch.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "aibo_client/telemetry.h"
#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

using aibo_client::Telemetry;

/// @param name the name of a sensor that every robot has
const robot_model::Sensor& sensorOf(const robot_model::RobotModel& model, const char* name);

/// @return what a sensor measured; empty if this telemetry does not contain it
std::optional<double> readingOf(const robot_model::Sensor& sensor, const Telemetry& telemetry);

/// The position and velocity of each joint, and how hard its motor works: `effort` is the duty, -1..1, not a torque.
/// `effort` is empty if the robot does not report it.
class JointStates {
 public:
  using Message = sensor_msgs::JointState;
  static constexpr bool kRemembers = false;

  /// @param table, measured must outlive the object
  JointStates(const movement::JointTable& table, const movement::MeasuredJoints& measured)
      : table_(table), measured_(measured) {}

  /// @param telemetry the telemetry with which the measured joints have been updated
  /// @return empty if the telemetry contains no joint
  std::optional<Message> read(const Telemetry& telemetry) const;

 private:
  const movement::JointTable& table_;
  const movement::MeasuredJoints& measured_;
};

/// The message of an infrared range finder. The range is -inf if something is too near to be measured, and inf if
/// nothing is near enough (REP 117).
class RangeFinder {
 public:
  using Message = sensor_msgs::Range;
  static constexpr bool kRemembers = false;

  /// The field of view is for rviz and for costmaps. The beam is narrow, but no source says how narrow. We chose 2
  /// degrees.
  static constexpr float kFieldOfView = 0.035F;  // rad

  /// @param sensor must outlive the object; the tables of robot_model do
  explicit RangeFinder(const robot_model::Sensor& sensor) : sensor_(sensor) {}

  /// @return empty if the telemetry does not contain this sensor
  std::optional<Message> read(const Telemetry& telemetry) const;

 private:
  const robot_model::Sensor& sensor_;
};

/// The message of the three accelerometers, in the axes of the body (REP 103: x forward, y left, z up).
///
/// Sony names the axes (a1 front-back, a2 right-left, a3 up-down; Model Information ERS-7) but not their signs. These
/// follow from Tekkotsu's ERS7Info.h and ERS210Info.h: a1 is negative when the robot sits, a2 when it lies on its left
/// side, a3 when it stands. So a1 counts backwards, a2 to the left and a3 downwards.
class Accelerometer {
 public:
  using Message = sensor_msgs::Imu;
  static constexpr bool kRemembers = true;

  /// @param model must outlive the object
  explicit Accelerometer(const robot_model::RobotModel& model)
      : sensors_{&sensorOf(model, "acceleration_front_back"), &sensorOf(model, "acceleration_right_left"),
                 &sensorOf(model, "acceleration_up_down")} {}

  /// @return empty until there is a new value of each axis; a version 1 server sends the axes one by one
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  std::array<const robot_model::Sensor*, 3> sensors_;
  std::array<std::optional<double>, 3> values_;
  std::uint64_t connection_ = 0;
};

/// The message of the switches and touch sensors.
class TouchSensors {
 public:
  using Message = Touch;
  static constexpr bool kRemembers = true;

  /// @param model must outlive the object
  explicit TouchSensors(const robot_model::RobotModel& model);

  /// @return empty if the telemetry contains none of these sensors. A sensor that is not in the telemetry keeps its
  ///   last value of this connection.
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  /// A sensor of this robot, and its fields in the message.
  struct Part {
    const robot_model::Sensor* sensor;
    std::uint8_t Touch::*touched;
    float Touch::*strength;  ///< null for a switch
  };

  std::vector<Part> parts_;
  Message message_;
  std::uint64_t connection_ = 0;
};

/// The message about the battery. A value that the robot does not measure is NaN or unknown.
class Battery {
 public:
  using Message = sensor_msgs::BatteryState;
  static constexpr bool kRemembers = true;

  /// A charge lasts for more than an hour, so one message per period is enough.
  static constexpr std::chrono::seconds kPeriod{1};

  /// The sensors must outlive the object; the tables of robot_model do.
  Battery(const robot_model::Sensor& charge, const robot_model::Sensor& temperature)
      : charge_sensor_(charge), temperature_sensor_(temperature) {}

  /// @return empty if the telemetry does not contain the charge, or if the last message is younger than kPeriod. The
  ///   temperature is the last one of this connection, because a version 1 server sends the two one by one.
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  static constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();

  const robot_model::Sensor& charge_sensor_;
  const robot_model::Sensor& temperature_sensor_;
  float temperature_ = kNotMeasured;  ///< degrees Celsius
  std::uint64_t connection_ = 0;
  std::optional<std::chrono::steady_clock::time_point> last_;  ///< when the telemetry of the last message arrived
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_SENSOR_MESSAGES_H
