#include "remote_control/allow.h"

namespace aibo_driver::remote_control {

QString whyNot(Needs needs, const RobotConnection& connection, const RobotCondition& condition) {
  if (!connection.isConnected()) {
    return connection.text;
  }
  if (connection.protocol_version == 1 && needs != Needs::kConnection && needs != Needs::kMotors) {
    return "the robot's RCServer is of version 1, which does not support this";
  }
  if (needs == Needs::kConnection || needs == Needs::kVersion2) {
    return "";
  }
  if (condition.is_stopped) {
    return condition.stopped_by + " has stopped the robot; click Release";
  }
  if (needs == Needs::kNotStopped) {
    return "";
  }
  if (condition.motors == RobotCondition::Motors::kOff) {
    return "the motors are off; click Stand, or Motors on";
  }
  if (needs == Needs::kFeet && condition.posture == RobotCondition::Posture::kFallen) {
    return "the robot has fallen; put it on its feet, and click Stand";
  }
  if (needs == Needs::kFeet && condition.posture == RobotCondition::Posture::kCarried) {
    return "the robot is carried; put it on its feet";
  }
  return "";
}

}  // namespace aibo_driver::remote_control
