/// @file MotorSwitch.h
/// The switch of the motors, as a client's commands see it.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTOR_SWITCH_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTOR_SWITCH_H

/// Switches the motors of all joints at once.
class MotorSwitch {
 public:
  virtual ~MotorSwitch() {}

  /// True from the moment they are switched on, although they pull only a little later.
  virtual bool AreOn() const = 0;

  /// On: the joints hold where they are. Off: they can be moved by hand.
  /// @return false if the robot refuses; they are off then
  virtual bool Switch(bool on) = 0;
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTOR_SWITCH_H
