/// @file JointDriver.h
/// Between JointControl and the motors of the robot.
#ifndef RCSERVER_BODY_JOINT_DRIVER_H
#define RCSERVER_BODY_JOINT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

#include "rcserver/body/Primitives.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/joints/Motors.h"

/// Opens the joints of the robot by the table of its design, switches their motors, hands on what they report, and
/// commands them where the planner wants them.
///
/// Gains go on only after the joints' present positions have been commanded and played, so that nothing moves.
class JointDriver : public Motors {
 public:
  JointDriver();
  virtual ~JointDriver();

  /// Opens the robot's joints. If one does not open, the robot counts as one without joints, and the log says why.
  /// @param robot must outlive this
  void Open(const robot_model::RobotModel& robot);
  void Close();

  /// Valid between Open() and Close().
  JointControl& Joints() { return *joints_; }

  virtual bool AreOn() const { return state_ != OFF; }
  virtual bool Switch(bool on);

  /// True if there is something to be commanded.
  bool HasCommand() const;

  /// Adds it, for all joints.
  /// @param vector of CommandVectors
  void Fill(RCRegion* vector);

  /// The vector has been sent.
  void Sent();

  /// Takes over what the joints report.
  /// @param[out] frame the last frame in the vector; untouched if it reports nothing
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

  bool OpenPrimitives(const robot_model::RobotModel& robot);
  bool HoldPresentPositions();
  bool SwitchOn();
  void EnableGains();
  bool Check(OStatus status, int joint, const char* otherwise) const;
  void Report(int joint, JointWatch::Verdict verdict) const;

  JointControl* joints_;
  Primitives primitives_;
  State state_;
  int vectors_until_gains_;  ///< that are still to be sent in GOING_ON
  int commanded_[robot_model::MAX_JOINTS];
  longword now_;
};

#endif  // RCSERVER_BODY_JOINT_DRIVER_H
