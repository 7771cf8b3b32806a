/// @file JointControl.h
/// The robot's joints: where they are to be, where they are, and what is wrong with them.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H

#include "rcserver/joints/MotionPlanner.h"
#include "rcserver/joints/MotionPlayer.h"
#include "robot_model/robot_model.h"

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

/// What a joint reports, 4 frames apart.
struct JointReading {
  int position;   ///< measured, in microradian
  int reference;  ///< where it was told to be then, in microradian
  int duty;       ///< of its motor: -512..512 is from full power backward to full power forward
};

/// Watches one joint. Pure logic.
///
/// A joint that is off its reference by more than TOLERANCE and has not moved by MOVEMENT for PATIENCE does not follow.
/// With its motor at HIGH_DUTY or more, something holds it: it is jammed. With less, the robot does not even try. All
/// four numbers are our choice: large enough for a joint that lags behind in a fast motion or hangs under its load, and
/// small enough to spare a motor that pushes in vain.
class JointWatch {
 public:
  enum Verdict {
    FOLLOWS,
    JAMMED,
    UNCONTROLLABLE,
    LIMP  ///< its motor got no gain; Look() never says so
  };

  static const int TOLERANCE = 174533;  ///< microradian: 10 degrees
  static const int MOVEMENT = 17453;    ///< microradian: 1 degree
  static const unsigned PATIENCE = 63;  ///< frames of 8 ms: half a second
  static const int HIGH_DUTY = 256;     ///< of 512

  JointWatch() : position_(0), since_(0) {}

  /// Starts over: the joint is here, and nothing is known of what was before.
  void Reset(int position, unsigned frame);

  /// To be called for each reading.
  /// @param frame of the reading, in frames of 8 ms
  /// @return FOLLOWS, or what is wrong, which then is said again after another PATIENCE only
  Verdict Look(const JointReading& reading, unsigned frame);

 private:
  int position_;    ///< where the joint moved or was where it was to be for the last time
  unsigned since_;  ///< frame of that
};

/// What commands work on and what the motors are driven from. Pure logic. Joints go by their index in the robot's table
/// (robot_model.h), angles are in microradian, time is in OPEN-R frames of 8 ms.
class JointControl {
 public:
  /// @param robot must outlive this
  explicit JointControl(const robot_model::RobotModel& robot);

  const robot_model::RobotModel& Robot() const { return robot_; }
  int NumberOfJoints() const { return robot_.number_of_joints; }
  const char* Name(int joint) const { return robot_.joints[joint].name; }
  unsigned char Identifier(int joint) const { return robot_.joints[joint].identifier; }

  /// @return the joint with this identifier of docs/protocol.md, or robot_model::NO_JOINT
  int Find(int identifier) const { return findJointByIdentifier(robot_, identifier); }

  MotionPlanner& Planner() { return planner_; }
  const MotionPlanner& Planner() const { return planner_; }
  MotionPlayer& Motions() { return motions_; }

  /// A client's command: as MotionPlanner::SetTargets(), and motions that move one of these joints are over.
  void SetTargets(MotionPlanner::JointTarget* targets, int count, int duration);

  /// @name Joints that clients have commanded since ForgetCommands(). A motion whose file was being read meanwhile must
  /// not move them. One element a joint
  /// @{
  void ForgetCommands();
  const bool* CommandedSince() const { return commanded_; }
  /// @}

  /// One frame passes for motions and planner.
  void NextFrame();

  /// True if there is a joint that has not arrived, or a motion that goes on.
  bool AreMoving() const;

  /// The joint was found at this place and is to hold it.
  void Hold(int joint, int position, unsigned frame);

  /// A joint has reported.
  /// @param driven its motor pulls: it is watched. One that does not follow is held where it is; its motion ends
  /// @return what the watch says
  JointWatch::Verdict Measured(int joint, const JointReading& reading, unsigned frame, bool driven);

  /// Records a fault of a joint that the watch does not find itself. TakeFault() returns it.
  void Failed(int joint, JointWatch::Verdict fault) { faults_[joint] = fault; }

  /// Where the joint was when it last reported.
  int Position(int joint) const { return positions_[joint]; }

  /// What was found to be wrong with a joint since this was asked last.
  JointWatch::Verdict TakeFault(int joint);

  /// Forgets what the client has left behind: motions are over, all joints stop and hold, limits are the robot's own,
  /// faults are no longer worth telling.
  void ClientGone();

 private:
  const robot_model::RobotModel& robot_;
  MotionPlanner planner_;
  MotionPlayer motions_;
  int positions_[robot_model::MAX_JOINTS];
  JointWatch watches_[robot_model::MAX_JOINTS];
  JointWatch::Verdict faults_[robot_model::MAX_JOINTS];
  bool commanded_[robot_model::MAX_JOINTS];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H
