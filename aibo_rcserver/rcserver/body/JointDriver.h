/// @file JointDriver.h
/// Between JointControl and the motors of the robot.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

#include "rcserver/body/Primitives.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/joints/MotorSwitch.h"

/// Opens the joints of the robot by the table of its design, switches their motors, hands on what they report, and
/// commands them where the planner wants them.
///
/// Gains go on only after the joints' present positions have been commanded and output, so that nothing moves: first
/// EnableJointGain, then SetJointGain, since a gain that is set earlier counts for nothing (Level2 Reference Guide,
/// pages 70 and 71). A joint that gets no gain is a fault of JointControl's.
class JointDriver : public MotorSwitch {
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

  /// The vector that was filled has been sent.
  /// @param vectors_ahead that were sent before it and whose output is not complete
  void Sent(int vectors_ahead);

  /// The output of a vector is complete, the oldest of those that were sent, whether it was filled here or not.
  void OutputIsComplete();

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
  bool EnableGain(int joint) const;
  bool Check(OStatus status, int joint, const char* otherwise) const;
  void Report(int joint, JointWatch::Verdict verdict) const;

  JointControl* joints_;
  Primitives primitives_;
  State state_;
  const robot_model::RobotModel* robot_;
  int vectors_until_gains_;  ///< in GOING_ON: whose output is still to be completed; 0: none has been sent
  int commanded_[robot_model::MAX_JOINTS];
  longword now_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H
