/// @file Body.h
/// The robot's body, as OPEN-R has it.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_BODY_H
#define AIBO_RCSERVER_RCSERVER_BODY_BODY_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include "rcserver/body/CommandVectors.h"
#include "rcserver/body/JointDriver.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/body/PowerOrder.h"
#include "rcserver/body/PowerSupply.h"
#include "rcserver/body/SensorDriver.h"

/// Joints, sensors, LEDs and ears, opened by the table of the robot's design; and the two gates that they share.
///
/// Commands are sent while there is something to say: at rest none are, joints hold and LEDs shine as they were
/// commanded last. So the first command after a rest is output from the next frame on. It takes two vectors at once,
/// and each READY brings one more, so that the next vector always waits when one has been output, and an answer to
/// READY may take as long as a vector lasts (Level2 Reference Guide, page 44; the samples of the SDK do the same).
/// Commands to LEDs and ears go with those to joints, and delay none.
class Body {
 public:
  Body();

  /// Opens all there is. What is missing is left out, and the log says why: a robot whose design has no table has
  /// nothing.
  void Open();
  void Close();

  /// @name What commands work on; valid between Open() and Close()
  /// @{
  const char* Design() const { return design_; }
  JointControl& Joints() { return joint_driver_.Joints(); }
  MotorSwitch& GetMotors() { return joint_driver_; }
  const Sensors& GetSensors() const { return sensor_driver_.GetSensors(); }
  Lights& GetLights() { return light_driver_.GetLights(); }
  PowerOrder& GetPowerOrder() { return power_order_; }
  PowerSupply& GetPowerSupply() { return power_supply_; }
  /// @}

  /// Sends the next command vectors if they are due and the robot can take them. To be called when something was
  /// commanded.
  /// @param effector gate to OVirtualRobotComm.Effector
  void SendCommands(OSubject* effector);

  /// READY has come: goes on sending.
  void EffectorIsReady(OSubject* effector);

  /// Takes over what joints and sensors report.
  /// @param[out] frame the last frame in the vector
  /// @return false if it reports nothing
  bool ReadSensors(OSensorFrameVectorData* sensors, longword* frame);

  /// True if nothing moves, and no command is on its way to the motors.
  bool IsAtRest() { return vectors_on_their_way_ == 0 && !Joints().AreMoving(); }

  /// Motors off at once, whatever they do.
  void CutMotors();

  /// Motors off, then what the order says, unless the power stays on. The order stays until the robot is off. If the
  /// robot refuses, the order is forgotten, and the log says so.
  void CarryOutPowerOrder();

 private:
  bool AddVector(OSubject* effector);

  Body(const Body&);
  Body& operator=(const Body&);

  char design_[orobotdesignNAME_MAX + 1];
  JointDriver joint_driver_;
  LightDriver light_driver_;
  SensorDriver sensor_driver_;
  CommandVectors vectors_;
  int vectors_on_their_way_;  ///< sent, and their output is not complete
  PowerOrder power_order_;
  PowerSupply power_supply_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_BODY_H
