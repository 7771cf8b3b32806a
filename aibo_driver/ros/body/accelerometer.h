/// @file accelerometer.h
#ifndef AIBO_DRIVER_ROS_BODY_ACCELEROMETER_H
#define AIBO_DRIVER_ROS_BODY_ACCELEROMETER_H

#include <sensor_msgs/Imu.h>

#include <array>
#include <cstdint>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// Makes messages of what the three accelerometers measured, in the axes of the body (REP 103: x forward, y left, z
/// up).
///
/// Like every accelerometer they measure what holds the robot up, too: at rest, 9.81 upwards (sensor_msgs/Imu). Sony
/// names the axes (a1 front-back, a2 right-left, a3 up-down; Model Information ERS-7) but not the signs. These follow
/// from what Tekkotsu's ERS7Info.h and ERS210Info.h say of real robots: a1 is negative when the robot sits on its butt,
/// a2 when it lies on its left side, a3 when it stands. In the first posture up is where its nose points, in the second
/// its right side, in the third its back: so a1 counts backwards, a2 to the left, a3 downwards. These are right-handed
/// axes, turned by half a turn about y.
class Accelerometer {
 public:
  using Message = sensor_msgs::Imu;

  /// The sensors must outlive the object, as the tables of robot_model do.
  Accelerometer(const robot_model::Sensor& front_back, const robot_model::Sensor& right_left,
                const robot_model::Sensor& up_down)
      : sensors_{&front_back, &right_left, &up_down} {}

  /// @return without a header; nothing until all three axes are known anew, which a version 1 server tells one by one
  std::optional<Message> read(const Telemetry& telemetry);

 private:
  std::array<const robot_model::Sensor*, 3> sensors_;
  std::array<std::optional<double>, 3> values_;
  std::uint64_t connection_ = 0;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_ACCELEROMETER_H
