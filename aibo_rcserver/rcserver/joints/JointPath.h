#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PATH_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PATH_H

/// Computes the path of one joint, frame by frame.
///
/// All numbers are integers: positions in microradian, steps (speeds) in microradian per frame, accelerations in
/// microradian per frame squared. So the joint reaches its target exactly, the limits hold exactly, and the robot
/// computes the same values as the tests.
///
/// The speed profile is a trapezoid. The joint accelerates or brakes at its acceleration limit to a cruising speed,
/// keeps that speed, and brakes at the acceleration limit. The cruising speed is the lowest that arrives in time. The
/// profile is computed again in every frame from the joint's position and speed. So the speed never jumps, even if the
/// target or the limits change on the way or a coupling holds the joint back.
///
/// Two consecutive steps differ by no more than the acceleration limit. A joint can stand still if its next step may be
/// 0.
class JointPath {
 public:
  struct Span {
    int low;
    int high;
  };

  /// At first, the joint stands at its target 0, and both limits are 1.
  JointPath();

  /// Puts the joint at rest at a position, which becomes its target.
  void Place(int position);

  /// @param step not below 1. A joint that moves faster brakes at its acceleration limit.
  void LimitStep(int step);

  /// @param acceleration not below 1. A lower limit takes effect only when the joint can stop with it within one frame,
  ///   because earlier the joint could no longer stop at its target.
  void LimitAcceleration(int acceleration);

  /// Sets a new target, to be reached as soon as the limits allow.
  void Aim(int target);

  /// Follows a moving target. At the end of the next frame, the joint is at the target or as near to it as the limits
  /// allow, at any speed. Call this in every frame, or the joint returns to the last target and stops.
  /// @param acceleration not below 1; replaces the limit if it is higher, until the joint can stop with the limit
  ///   within one frame
  void Follow(int target, int acceleration);

  /// Sets the target to the position where the joint stops if it brakes from now on.
  /// @param acceleration not below 1; see Follow()
  void Stop(int acceleration);

  int Position() const { return position_; }
  int Step() const { return step_; }
  int Target() const { return target_; }

  /// Frames until the joint stands at its target, 0 if it already does. The number grows if new limits or a coupling
  /// delay the joint.
  int FramesLeft() const { return frames_left_; }

  /// Makes the joint arrive later, which is always possible.
  /// @param frames not below FramesLeft()
  void Delay(int frames) { frames_left_ = frames; }

  /// The step of the next frame if no coupling holds the joint back.
  int WantedStep();

  /// The step of the next frame if the joint brakes.
  int BrakingStep() const;

  /// The positions that the joint passes if it takes this step and then brakes.
  Span SpanAfter(int step) const;

  /// The positions that the joint passes if it brakes at once.
  Span BrakingSpan() const;

  /// Advances by one frame.
  /// @param step from BrakingStep() to WantedStep()
  void Advance(int step);

 private:
  void Review();
  double DistanceIn(int frames, int cruise) const;
  bool CanArriveIn(int frames) const;
  int FewestFrames() const;
  int CruisingStep() const;
  int StepTowards(int cruise) const;
  int FollowingStep() const;
  int BrakingDistance(int step) const;

  int position_;
  int step_;  ///< the step of the last frame
  int target_;
  int frames_left_;
  int step_limit_;
  int acceleration_;         ///< the limit in force
  int wanted_acceleration_;  ///< the limit asked for
  bool is_following_;        ///< Follow() was called for the next frame
  double fraction_of_step_;  ///< how far the joint lags because of rounding, in steps, 0..1
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_PATH_H
