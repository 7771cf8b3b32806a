#ifndef AIBO_RCSERVER_RCSERVER_BODY_BODY_H
#define AIBO_RCSERVER_RCSERVER_BODY_BODY_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include "rcserver/body/JointDriver.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/body/Microphone.h"
#include "rcserver/body/Primitives.h"
#include "rcserver/body/SensorDriver.h"
#include "rcserver/body/Speaker.h"
#include "rcserver/camera/CameraControl.h"

/// Opens the joints, sensors, LEDs and ears in the table of the robot's design, and sends commands to them.
///
/// Commands are sent only while something changes. Without commands, joints and LEDs keep the state that was last
/// commanded, and the first new command is output from the next frame on. Commands to LEDs and ears share vectors with
/// those to joints and delay none.
class Body {
 public:
  /// Opens everything. Parts that do not open are left out, and the console says why. A robot whose design has no table
  /// has no parts.
  Body();

  /// Call this in DoInit.
  /// @param effector, speaker gates to OVirtualRobotComm.Effector and OVirtualRobotAudioComm.Speaker
  void Start(OSubject* effector, OSubject* speaker);

  const char* Design() const { return design_; }

  JointControl& Joints() { return joint_driver_.Joints(); }
  MotorSwitch& Motors() { return joint_driver_; }
  const SensorDriver& Sensors() const { return sensor_driver_; }
  LightDriver& Lights() { return light_driver_; }
  CameraControl& Camera() { return camera_; }
  Microphone& Hearing() { return microphone_; }
  Speaker& Voice() { return speaker_; }

  /// Sends the next command vectors if they are due and the robot can take them. Call this after every command.
  void SendCommands();

  /// Call this on READY: it sends the next vectors.
  void EffectorIsReady();

  /// Reads the reports of joints and sensors. A robot that has fallen stops walking, and its motors go off if it stays
  /// down. The motors also go off when the robot has lain down to rest.
  /// @param[out] frame the last frame in the vector
  /// @return false if there is no report in it
  bool ReadSensors(OSensorFrameVectorData* sensors, longword* frame);

  /// Switches the motors off at once, even while the joints move.
  void CutMotors();

  /// Switches the motors off, then shuts the robot down. A button press boots the robot again; with `reboots`, it boots
  /// by itself.
  /// @return false if the robot refuses; the console says so
  bool SwitchOff(bool reboots);

 private:
  const robot_model::RobotModel& FindModel();
  bool SendVector();
  void WatchWalk(longword frame);
  WalkGuard::Reading LookAround();
  double Measured(const char* sensor) const;
  void FlickEars();

  char design_[orobotdesignNAME_MAX + 1];
  CommandVectors vectors_;
  const robot_model::RobotModel& model_;
  JointDriver joint_driver_;
  LightDriver light_driver_;
  SensorDriver sensor_driver_;
  CameraControl camera_;
  Microphone microphone_;
  Speaker speaker_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_BODY_H
