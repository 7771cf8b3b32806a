#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H

#include "rcserver/joints/JointOrders.h"
#include "rcserver/joints/JointPlanner.h"
#include "rcserver/joints/JointWatch.h"
#include "rcserver/joints/MotionPlayer.h"
#include "rcserver/joints/OrderBook.h"
#include "rcserver/walk/Walker.h"
#include "robot_model/robot_model.h"

/// Switches the motors of all joints at once.
class MotorSwitch {
 public:
  virtual ~MotorSwitch() {}

  /// True from the moment at which the motors are switched on, although the gains follow a little later.
  virtual bool AreOn() const = 0;

  /// Switches the motors. When they are on, the joints hold still; when they are off, the joints can be moved by hand.
  /// @return false if the robot refuses; in that case the motors are off
  virtual bool Switch(bool on) = 0;
};

/// Connects clients' commands and motions to the motors. It does not depend on OPEN-R. Joints are numbered by their
/// index in the robot's table (robot_model.h), angles are in microradian, and time is in OPEN-R frames of 8 ms.
class JointControl {
 public:
  explicit JointControl(const robot_model::RobotModel& robot);

  const robot_model::RobotModel& Robot() const { return robot_; }
  int NumberOfJoints() const { return robot_.number_of_joints; }
  const char* Name(int joint) const { return robot_.joints[joint].name; }
  unsigned char Identifier(int joint) const { return robot_.joints[joint].identifier; }

  /// @return the joint with this identifier of docs/protocol.md, or robot_model::NO_JOINT
  int Find(int identifier) const { return findJointByIdentifier(robot_, identifier); }

  JointPlanner& Planner() { return planner_; }
  const JointPlanner& Planner() const { return planner_; }
  OrderBook& Orders() { return orders_; }
  MotionPlayer& Motions() { return motions_; }
  Walker& Walking() { return walker_; }

  // Clients' orders. Those that move or hold a leg make the client let go before the robot walks (OrderBook). `number`
  // is that of the request of version 2, otherwise 0.

  /// Carries out a command with JointPlanner::Go(). Motions, walks and postures that move one of these joints end. A
  /// command with a number is an order, which JointOrders ends.
  /// @param[in,out] targets targets of joints that the robot has; replaced by the positions accepted
  void SetTargets(protocol::version2::JointTargets* targets, unsigned short number = 0);

  /// Carries out an order to hold: the joint brakes within its limits and holds its position. A motion, walk or posture
  /// that moves it ends.
  void Stop(int joint);

  void StopAll();

  /// Carries out an order to walk or to take a posture (Walker). Commands and motions that move the legs end when it
  /// begins.
  protocol::version2::Velocity Steer(const protocol::version2::Velocity& wanted, bool guarded = false,
                                     unsigned short number = 0);
  void Take(protocol::version2::Posture posture, unsigned short number = 0);

  /// Begins to play the file in MotionPlayer::FindRoom(). Commands to its joints end, and so does a walk or a posture
  /// if legs move. The motion is refused if an order has taken one of its joints, or a hold has named one, since
  /// ForgetOrders(). The parameters and the result are those of MotionPlayer::Play().
  const char* Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                   unsigned short number);

  /// Call this when the motors are being switched off. All orders end.
  void MotorsGoOff();

  /// Call this when a motion is requested whose file has yet to be read.
  void ForgetOrders();

  /// Advances by one frame. Afterwards, the planner's positions are those at the frame's end.
  void NextFrame();

  /// True if a joint has not arrived yet, a motion is being played, or the robot walks or takes a posture.
  bool AreMoving() const;

  /// Call this when the joint is at rest and holds this position.
  void Hold(int joint, int position, unsigned frame);

  /// Call this when a joint has reported.
  /// @param driven true if its motor is on. Such a joint is watched: if it does not follow, it holds its current
  ///   position and its motion ends, unless the Walker tries another route
  /// @return the verdict of its JointWatch
  JointWatch::Verdict Measured(int joint, const JointReading& reading, unsigned frame, bool driven);

  /// Call this when the accelerometer and the paws have reported, after the joints' reports. Commands whose joints have
  /// arrived end.
  void Measured(const FallWatch::Reading& reading, unsigned frame);

  /// Records a fault that JointWatch cannot find. TakeFault() returns the fault.
  void Failed(int joint, JointWatch::Verdict fault);

  /// The robot's posture, from the last reported positions.
  protocol::version2::Posture Posture() const { return walker_.Now(positions_); }

  /// The joint's position in its last report.
  int Position(int joint) const { return positions_[joint]; }

  /// The motor's duty in the joint's last report, relative to FULL_DUTY.
  int Duty(int joint) const { return duties_[joint]; }

  /// The fault found since the last call, if any.
  JointWatch::Verdict TakeFault(int joint);

  /// True once after a joint with a fault has begun to follow its commands again.
  bool TakeRecovery(int joint);

  /// Resets everything for the next client: motions end, all joints stop and hold, limits are the robot's own, faults
  /// are forgotten. A robot that walks goes on until it stands, and one that is lying down to rest continues.
  void ClientGone();

 private:
  void EndWhatMoves(int joint, const EndReason& reason);
  void TakeFromWalker(int joint, const EndReason& reason);
  void EndCommandsAndMotions(const EndReason& reason);
  void TakeForClient(int joint, const EndReason& reason);
  void TakeForWalker(int joint);
  void TakeLegs();

  const robot_model::RobotModel& robot_;
  JointPlanner planner_;
  OrderBook orders_;
  JointOrders commands_;
  MotionPlayer motions_;
  Walker walker_;
  int positions_[robot_model::MAX_JOINTS];
  int duties_[robot_model::MAX_JOINTS];
  JointWatch watches_[robot_model::MAX_JOINTS];
  JointWatch::Verdict faults_[robot_model::MAX_JOINTS];
  JointRecovery recoveries_[robot_model::MAX_JOINTS];
  bool has_recovered_[robot_model::MAX_JOINTS];
  bool ordered_[robot_model::MAX_JOINTS];  ///< taken by an order, or named by a hold, since ForgetOrders()
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_CONTROL_H
