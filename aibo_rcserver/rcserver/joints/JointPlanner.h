#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PLANNER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PLANNER_H

#include "rcserver/joints/JointPath.h"
#include "robot_model/robot_model.h"

/// Plans the paths of all joints of a robot, frame by frame, so that they follow their commands without hitting the
/// body.
///
/// Positions are in microradian, speeds in microradian/s, accelerations in microradian/s^2. Joints are numbered by
/// their index in the robot's table (robot_model.h), 0 to number_of_joints - 1. The caller converts clients'
/// identifiers, and controls gains and motor power.
///
/// The following holds in each frame, whatever is commanded:
/// - A joint is within its limits. It overshoots its target only if it was too fast to stop there when the target was
///   set.
/// - Its speed and its change of speed are within its limits. A joint that is faster than a new limit brakes.
/// - Its speed profile is a trapezoid (JointPath.h). It reaches its target exactly, and takes a new target without a
/// jump.
/// - It does not hit the body: if the table couples two joints, the follower is never below the lower limit that
///   belongs to the leader's position. Targets are adapted to each other when they are set. On the way, each joint in
///   turn checks its next step against all positions that its partner can still reach while it brakes. So the limit
///   holds even if both joints brake, whichever stops first. A joint without room goes as far as it can and waits for
///   its partner to move out of the way.
///
/// Speeds are rounded down to whole microradians per frame, accelerations to whole microradians per frame squared.
///
/// The class is not thread-safe.
class JointPlanner {
 public:
  /// At first, all joints stand at 0, or as near to it as their limits allow, with the robot's highest speeds and
  /// default accelerations.
  explicit JointPlanner(const robot_model::RobotModel& robot);

  /// Puts the joint at rest at this position. Call this for every joint before the gains go on. If the joint was moved
  /// by hand, the position may be outside its limits or touch the body. The joint then stays there until it is
  /// commanded, and returns without going farther out.
  /// @param measured the position, which is clamped to the mechanical limits
  void SetPosition(int joint, int measured);

  /// Aims a joint at a position, for the next Go() or Follow(). If a joint is aimed twice, the last position counts.
  /// After Go() or Follow(), Target() is the position accepted: within the joint's limits, and for a follower not below
  /// the lower limit that belongs to its leaders' targets. A follower in the way of its leader is moved, too.
  void Aim(int joint, int position);

  /// Sends the joints that have been aimed to their positions.
  /// @param duration in milliseconds. If it is 0 or less, each joint moves as fast as its own limits allow. Otherwise
  ///   all of them, and followers that are moved out of their way, arrive in the same frame: the first one at or after
  ///   the end of the duration in which all can arrive. New limits may delay them. A joint leaves the group if it gets
  ///   another command or if a coupling holds it back; in the latter case, it still tries to arrive in time.
  void Go(int duration);

  /// Lets the joints that have been aimed follow moving targets, such as those of a walk. Each joint is at its target
  /// at the end of the next frame, or as near to it as it can get. A joint has no lag, because it need not be able to
  /// stop at its target. Position limits, speed limits and couplings hold, but the acceleration may be FOLLOWING times
  /// the default. Call Aim() and Follow() in every frame, or the joints return to their last targets and stop.
  void Follow();

  /// Factor on the default acceleration for joints that Follow() a target: they reach their highest speed in 13 ms.
  /// Walking needs 7.5 times the default at the knees when a foot lifts off. The value is our choice.
  static const int FOLLOWING = 8;

  /// Stops a joint within v^2 / (2 a), where a is its acceleration limit, or the default if the limit is lower, so that
  /// a low limit does not delay a stop. A leader whose target needs the joint to move on is stopped, too.
  void Hold(int joint);

  void HoldAll();

  /// @param limit the limit in microradian/s, clamped to 125..the joint's highest speed (robot_model.h). A joint that
  ///   is faster brakes; a higher limit takes effect with the next target.
  /// @return the limit accepted
  int SetSpeedLimit(int joint, int limit);
  int SpeedLimit(int joint) const { return speed_limits_[joint]; }
  const int* SpeedLimits() const { return speed_limits_; }

  /// @param limit the limit in microradian/s^2, clamped to 15625..the one that reaches the joint's highest speed within
  ///   one frame. A higher limit takes effect at once. A lower limit takes effect when the joint can stop with it
  ///   within one frame, because the joint would otherwise pass its target.
  /// @return the limit accepted
  int SetAccelerationLimit(int joint, int limit);
  int AccelerationLimit(int joint) const { return acceleration_limits_[joint]; }

  /// Advances by one frame. Afterwards, Position() is where each joint should be at the frame's end.
  void NextFrame();

  int Position(int joint) const { return paths_[joint].Position(); }
  int Target(int joint) const { return paths_[joint].Target(); }

  /// Frames until the joint is at its target, as planned now; 0 if it is there.
  int FramesLeft(int joint) const { return paths_[joint].FramesLeft(); }

 private:
  static const unsigned NO_COMMAND = 0;

  void FitAims();
  void LeaveCommand(int joint);
  void MakePartnersFit(int joint);
  void ArriveTogether();
  int AllowedStep(int joint, int wanted) const;
  bool IsAllowed(int joint, const JointPath::Span& next) const;

  const robot_model::RobotModel& robot_;
  JointPath paths_[robot_model::MAX_JOINTS];
  int speed_limits_[robot_model::MAX_JOINTS];         ///< microradian/s
  int acceleration_limits_[robot_model::MAX_JOINTS];  ///< microradian/s^2
  unsigned commands_[robot_model::MAX_JOINTS];  ///< joints with the same number arrive together; NO_COMMAND: alone
  unsigned last_command_;
  bool is_aimed_[robot_model::MAX_JOINTS];  ///< the joint has an aim for the next Go() or Follow()
  int aims_[robot_model::MAX_JOINTS];       ///< valid if is_aimed_
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PLANNER_H
