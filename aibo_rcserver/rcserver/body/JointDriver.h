#ifndef AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

#include "rcserver/body/Primitives.h"
#include "rcserver/joints/JointControl.h"

/// Opens the joints in the table of the robot's design, switches their motors, passes their reports to JointControl,
/// and commands the positions that its planner computes.
///
/// Gains go on only after the joints' current positions have been commanded and output, so that no joint moves.
/// EnableJointGain comes before SetJointGain, because OPEN-R ignores a gain that is set earlier (Level2 Reference
/// Guide, pages 70 and 71). A joint that gets no gain is reported as a fault.
class JointDriver : public MotorSwitch {
 public:
  /// Opens the joints. If one does not open, the robot is treated as having no joints, and the console says why.
  explicit JointDriver(const robot_model::RobotModel& robot);
  virtual ~JointDriver() {}

  JointControl& Joints() { return joints_; }

  virtual bool AreOn() const { return state_ != OFF; }
  virtual bool Switch(bool on);

  bool HasCommand() const;

  /// Adds commands to all joints.
  /// @param vector one of the CommandVectors
  void Fill(RCRegion* vector);

  /// Call this after the filled vector has been sent.
  /// @param vectors_ahead number of vectors that were sent earlier and whose output is not complete
  void Sent(int vectors_ahead);

  /// Call this when the output of the oldest sent vector is complete, even if it holds no joints.
  void OutputIsComplete();

  /// Passes the joints' reports to JointControl.
  /// @param[out] frame the last frame in the vector; untouched if no joint reports
  /// @return false if no joint reports
  bool ReadSensors(OSensorFrameVectorData* sensors, longword* frame);

 private:
  enum State {
    OFF,
    GOING_ON,  ///< current positions are being commanded
    ON
  };

  bool OpenPrimitives(const robot_model::RobotModel& robot);
  bool HoldPresentPositions();
  bool SwitchOn();
  void EnableGains();
  bool EnableGain(int joint) const;
  bool Check(OStatus status, int joint, const char* otherwise) const;
  void Report(int joint, JointWatch::Verdict verdict) const;

  Primitives primitives_;
  const robot_model::RobotModel& robot_;
  JointControl joints_;
  State state_;
  int vectors_until_gains_;  ///< in GOING_ON: how many vectors must be output first; 0 if none has been sent
  int commanded_[robot_model::MAX_JOINTS];
  longword now_;  ///< frame of the last report
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_JOINT_DRIVER_H
