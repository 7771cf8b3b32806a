/// @file MotionPlanner.h
/// Plans where every joint goes in the next 8 ms.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLANNER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_MOTION_PLANNER_H

#include "rcserver/joints/JointMotion.h"
#include "robot_model/robot_model.h"

/// Plans the motion of all joints of a robot, frame by frame, so that they follow their commands and hit nothing.
///
/// Positions are in microradian, speeds in microradian/s, accelerations in microradian/s^2. Joints are numbered by
/// their index in the robot's table (robot_model.h), 0 to number_of_joints - 1. The caller looks up the identifiers
/// that clients use, and takes care of gains and motor power.
///
/// In each frame, whatever is commanded:
/// - A joint is within its limits. It does not overshoot its target unless it was too fast to stop there when the
///   target was set.
/// - Its speed and its change of speed are within its limits. A joint that is faster than a new limit brakes.
/// - It moves on a trapezoid (JointMotion.h), meets its target exactly, and takes a new target without a jump.
/// - It does not hit the body: if the table couples two joints, the follower is never below the lower limit that
///   belongs to the leader's position. Targets are adapted to each other when they are set. On the way, each joint in
///   turn checks its next step against all positions that its partner can still reach while it brakes, so the limit
///   would hold even if both started to brake now, whichever stopped first. A joint without room goes as far as it can
///   and waits: the rotator for its elevator to rise, the elevator for its rotator to pass.
///
/// Speeds are rounded down to whole microradians per frame, accelerations to whole microradians per frame squared.
///
/// Not thread-safe.
class MotionPlanner {
 public:
  /// One joint of a command.
  struct JointTarget {
    int joint;     ///< index
    int position;  ///< in: any value; out: the value accepted
  };

  /// All joints stand at 0, or as near to it as they may, with the robot's highest speeds and default accelerations.
  /// @param robot must outlive the planner
  explicit MotionPlanner(const robot_model::RobotModel& robot);

  /// The joint is at this position, at rest, and holds it. Call for every joint before the gains go on. The position
  /// may be outside the joint's limits or where it touches the body, if the robot was bent by hand. The joint then
  /// stays there until it is commanded, and comes back without going deeper.
  /// @param measured is clamped to the mechanical limits
  void SetPosition(int joint, int measured);

  /// Sends a joint to a position as fast as its limits allow. Its follower is moved out of the way if necessary.
  /// @return the position accepted: within the joint's limits, and for a follower not below the lower limit that
  ///   belongs to its leaders' targets
  int SetTarget(int joint, int position);

  /// Sends several joints to their positions. Their order does not matter; of two positions for one joint, the last
  /// counts.
  /// @param[in,out] targets replaced by the positions accepted, see SetTarget()
  /// @param duration in milliseconds. 0 or less: each joint moves as fast as its own limits allow. Otherwise all of
  ///   them, and followers that are moved out of their way, arrive in the same frame: the first one at or after the end
  ///   of the duration in which all can arrive. New limits may make it later. A joint leaves the group if it gets
  ///   another command, or if a coupling holds it back; the latter still tries to arrive in time.
  void SetTargets(JointTarget* targets, int count, int duration);

  /// Lets joints follow targets that move, such as those of a walk: each is at its target at the end of the next frame,
  /// without the lag of a joint that has to be able to stop there. Limits, speed limits and couplings hold; the
  /// acceleration may be FOLLOWING times the default one. A joint that cannot be there goes as near as it can. Call for
  /// each frame; without a call, the joints return to their last targets and stand.
  /// @param[in,out] targets replaced by the positions accepted, see SetTarget()
  void Follow(JointTarget* targets, int count);

  /// How much faster than by default joints that Follow() may change their speed: they reach the highest one in 20 ms.
  /// Walking takes 4.5 times the default at the knees, where a foot lifts off. Our choice.
  static const int FOLLOWING = 5;

  /// Stops a joint within v^2 / (2 a), where a is its acceleration limit, or the default one if the limit is lower: an
  /// order to stop does not wait for a client's gentle limits. A leader whose target needs the joint to be elsewhere is
  /// stopped, too.
  void Hold(int joint);

  /// Stops all joints.
  void HoldAll();

  /// @param limit is clamped to 125..the joint's highest speed (robot_model.h). A joint that is faster brakes; a higher
  ///   limit than before takes effect with the next target.
  /// @return the limit accepted
  int SetSpeedLimit(int joint, int limit);
  int SpeedLimit(int joint) const { return speed_limits_[joint]; }

  /// The limits of all joints, in the order of the robot's table.
  const int* SpeedLimits() const { return speed_limits_; }

  /// @param limit is clamped to 15625..the one that reaches the joint's highest speed within one frame. A higher limit
  ///   than before takes effect at once, a lower one when the joint is slow enough to stop with it within one frame: it
  ///   would pass its target otherwise.
  /// @return the limit accepted
  int SetAccelerationLimit(int joint, int limit);
  int AccelerationLimit(int joint) const { return acceleration_limits_[joint]; }

  /// One frame passes: Position() is where each joint should be at its end.
  void NextFrame();

  int Position(int joint) const { return motions_[joint].Position(); }
  int Target(int joint) const { return motions_[joint].Target(); }

  /// Speed of the last frame, in microradian/s.
  int Speed(int joint) const;

  /// Frames until the joint is at its target, as planned now; 0 if it is there.
  int FramesLeft(int joint) const { return motions_[joint].FramesLeft(); }

 private:
  void FitTargets(JointTarget* targets, int count, int* posture, bool* commanded) const;
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
