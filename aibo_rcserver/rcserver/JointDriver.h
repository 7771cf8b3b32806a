/// @file JointDriver.h
/// Between JointControl and the motors of the robot.
#ifndef RCSERVER_JOINT_DRIVER_H
#define RCSERVER_JOINT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/OSubject.h>

#include "rcserver/CommandVectors.h"
#include "rcserver/JointControl.h"
#include "rcserver/Motors.h"

/// Opens the joints of the robot by the table of its design, switches their motors, hands on what they report, and
/// sends them where the planner wants them.
///
/// Gains go on only after the joints' present positions have been commanded and played, so that nothing moves. Commands
/// are sent while there is something to say: at rest none are, and the joints hold the last one. So the first command
/// after a rest is played from the next frame on, not after two vectors that already wait.
class JointDriver : public Motors {
 public:
  JointDriver();
  virtual ~JointDriver();

  /// Opens the robot's joints. If its design has no table or a joint does not open, the robot counts as one without
  /// joints, and the log says why.
  void Open();
  void Close();

  /// Valid between Open() and Close().
  JointControl& Joints() { return *joints_; }

  virtual bool AreOn() const { return state_ != OFF; }
  virtual bool Switch(bool on);

  /// Sends the next command vector if one is due and the robot can take it. To be called when it is ready for one, and
  /// when joints were commanded.
  /// @param effector gate to OVirtualRobotComm.Effector
  void SendCommands(OSubject* effector);

  /// Takes over what the joints report.
  /// @param[out] frame the last frame in the vector
  /// @return false if it reports nothing
  bool ReadSensors(OSensorFrameVectorData* sensors, longword* frame);

 private:
  enum State {
    OFF,
    GOING_ON,  ///< present positions are being commanded
    ON
  };

  JointDriver(const JointDriver&);
  JointDriver& operator=(const JointDriver&);

  const robot_model::RobotModel* OpenPrimitives();
  void ClosePrimitives();
  bool HoldPresentPositions();
  bool SwitchOn();
  void EnableGains();
  bool HasCommand() const;
  void Fill(RCRegion* vector);
  int FindPrimitive(OPrimitiveID primitive) const;
  bool Check(OStatus status, int joint, const char* otherwise) const;
  void Report(int joint, JointWatch::Verdict verdict) const;

  JointControl* joints_;
  OPrimitiveID primitives_[robot_model::MAX_JOINTS];
  int number_of_primitives_;  ///< that are open
  CommandVectors vectors_;
  State state_;
  int vectors_until_gains_;  ///< that are still to be sent in GOING_ON
  int commanded_[robot_model::MAX_JOINTS];
  longword now_;
};

#endif  // RCSERVER_JOINT_DRIVER_H
