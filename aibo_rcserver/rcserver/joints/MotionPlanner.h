/// @file MotionPlanner.h
/// Where every joint is to be in the next 8 ms, so that it follows its commands and nothing is hit or torn.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLANNER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLANNER_H

#include "rcserver/joints/JointMotion.h"
#include "robot_model/robot_model.h"

/// Plans the motion of all joints of a robot, frame by frame. Pure logic: no OPEN-R, no clock, no client.
///
/// Positions are in microradian, speeds in microradian/s, accelerations in microradian/s^2. Joints go by their index in
/// the robot's table (robot_model.h), 0 to number_of_joints - 1; looking up what a client calls them is the caller's
/// part, and so are gains and motor power.
///
/// What holds for each joint in each frame, whatever is commanded and whenever:
/// - It is within its limits, and does not overshoot its target unless it was too fast to stop there when the target
///   was set.
/// - Its speed and its change of speed are within its limits. A joint that is faster than a new limit brakes.
/// - It moves on a trapezoid (JointMotion.h), meets its target exactly, and takes a new target without a jump.
/// - The body is not hit: where the table couples two joints, the follower is never below the lower limit that goes
///   with the leader's place. Targets are made to fit together when they are set. On the way, one joint after the other
///   checks its next step against all places that its partner can still get to while it brakes, so that even if both
///   started to brake now, whichever stopped first, the limit would hold. A joint that finds no room goes as near as it
///   may and waits: the rotator for its elevator to rise, the elevator for its rotator to pass.
///
/// Speeds and accelerations are rounded down to whole microradians a frame, and a frame a frame.
///
/// Not thread-safe.
class MotionPlanner {
 public:
  /// Length of a frame: the ERS-7 and the ERS-210 take a joint value every 8 ms (Sony's OPEN-R programmer's guide).
  static const int FRAME_MILLISECONDS = 8;

  /// One joint of a command.
  struct JointTarget {
    int joint;     ///< index
    int position;  ///< any value going in; the one accepted coming out
  };

  /// All joints stand at 0, or as near to it as is allowed, with the robot's highest speeds and default accelerations.
  /// @param robot must outlive the planner
  explicit MotionPlanner(const robot_model::RobotModel& robot);

  /// A joint was found at this position, at rest, and holds it: to be called for every joint before the gains go on.
  /// It may be outside of the joint's limits, or where the body is touched, as when the robot was bent by hand; the
  /// joint stays there until it is commanded, and comes back without passing on deeper.
  /// @param measured held within the mechanical limits
  void SetPosition(int joint, int measured);

  /// Sends a joint to a position as fast as its limits allow.
  /// @return the position accepted: within the joint's limits, and for a follower not below the lower limit that goes
  ///   with its leaders' targets. A follower of this joint is sent out of the way if need be; Target() tells.
  int SetTarget(int joint, int position);

  /// Sends several joints to their positions at once. They are taken together: their order does not matter; of two
  /// positions for one joint, the last counts.
  /// @param[in,out] targets replaced by the positions accepted, see SetTarget()
  /// @param duration in milliseconds. 0 or less: every joint gets there as fast as its own limits allow. Otherwise all
  ///   of them, and followers sent out of their way, arrive in one and the same frame, the first that is not before the
  ///   end of the duration; if that is too soon for one of them, or becomes so by new limits, in the first that is not.
  ///   Two kinds of joints leave the company: one that gets another command in the meantime, and one that a coupling
  ///   holds back, which still tries to arrive in time.
  void SetTargets(JointTarget* targets, int count, int duration);

  /// Stops a joint as fast as its acceleration limit allows, within v^2 / (2 a), and lets it stand there. A leader that
  /// is on its way to where the joint would be in its way is stopped too.
  void Hold(int joint);

  /// Stops all joints.
  void HoldAll();

  /// @param limit taken into 125..the joint's highest speed (robot_model.h). A joint on its way brakes if it is faster;
  ///   a higher limit than before counts from the next target on.
  /// @return the limit accepted
  int SetSpeedLimit(int joint, int limit);
  int SpeedLimit(int joint) const { return speed_limits_[joint]; }

  /// @param limit taken into 15625..what reaches the joint's highest speed within one frame. A higher limit than before
  ///   counts at once; a lower one waits until the joint stands (is slow enough to stop with it from one frame to the
  ///   next), because it would pass its target otherwise.
  /// @return the limit accepted
  int SetAccelerationLimit(int joint, int limit);
  int AccelerationLimit(int joint) const { return acceleration_limits_[joint]; }

  /// One frame passes: Position() is where each joint is to be at its end.
  void NextFrame();

  int Position(int joint) const { return motions_[joint].Position(); }
  int Target(int joint) const { return motions_[joint].Target(); }

  /// Speed of the last frame, in microradian/s.
  int Speed(int joint) const;

  /// Frames until the joint is at its target, as far as is known; 0: it is there.
  int FramesLeft(int joint) const { return motions_[joint].FramesLeft(); }

 private:
  void LeaveCommand(int joint);
  void MakePartnersFit(int joint);
  void ArriveTogether();
  int AllowedStep(int joint, int wanted) const;
  bool IsAllowed(int joint, const JointMotion::Span& next) const;

  const robot_model::RobotModel& robot_;
  JointMotion motions_[robot_model::MAX_JOINTS];
  int speed_limits_[robot_model::MAX_JOINTS];         ///< microradian/s
  int acceleration_limits_[robot_model::MAX_JOINTS];  ///< microradian/s^2
  unsigned commands_[robot_model::MAX_JOINTS];        ///< joints with the same number arrive together
  unsigned last_command_;
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLANNER_H
