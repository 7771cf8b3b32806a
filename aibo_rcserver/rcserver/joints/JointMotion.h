/// @file JointMotion.h
/// How one joint moves to its target.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H

/// Computes the motion of one joint, frame by frame.
///
/// All numbers are integers: positions in microradian, steps (speeds) in microradian per frame, accelerations in
/// microradian per frame squared. So the target is met exactly, the limits hold to the last digit, and the robot
/// computes the same as the tests.
///
/// The joint speeds up or brakes at its acceleration limit until it has a cruising speed, keeps that, and brakes at the
/// acceleration limit again: a trapezoid, with the lowest cruising speed that arrives in time. The shape is computed
/// again in every frame, from the joint's position and speed. So the speed never jumps, even if the target or the
/// limits change on the way, or something holds the joint back.
///
/// Two steps in a row differ by no more than the acceleration limit. A joint stands if its next step may be 0.
class JointMotion {
 public:
  /// The positions a joint passes if it brakes from now on.
  struct Span {
    int low;
    int high;
  };

  /// Stands at 0, which is its target, with limits of 1.
  JointMotion();

  /// Puts the joint at a position, at rest, which becomes its target.
  void Place(int position);

  /// @param step not below 1. A joint that moves faster brakes at its acceleration limit.
  void LimitStep(int step);

  /// @param acceleration not below 1. A lower limit than the present one takes effect when the joint can stop with it
  ///   within one frame; earlier, the joint could no longer stop at its target.
  void LimitAcceleration(int acceleration);

  /// A new target, to be reached as soon as the limits allow.
  void Aim(int target);

  /// A target that moves: the joint is to be there at the end of the next frame, at whatever speed. It goes as near to
  /// it as the limits allow. Call again for each frame; otherwise the joint returns to the last target, and stands.
  /// @param acceleration not below 1; counts instead of the limit if it is higher, until the joint can stop with the
  ///   limit within one frame
  void Follow(int target, int acceleration);

  /// The new target is the position where the joint stops if it brakes from now on.
  /// @param acceleration not below 1; counts as for Follow()
  void Stop(int acceleration);

  int Position() const { return position_; }
  int Step() const { return step_; }
  int Target() const { return target_; }

  /// Frames until the joint stands at its target; 0 if it does already. The number grows if new limits, or something
  /// that holds the joint back, make it arrive later.
  int FramesLeft() const { return frames_left_; }

  /// Makes the joint arrive later, which is always possible.
  /// @param frames not below FramesLeft()
  void Delay(int frames) { frames_left_ = frames; }

  /// The step of the next frame, if nothing holds the joint back.
  int WantedStep();

  /// The step of the next frame if the joint brakes.
  int BrakingStep() const;

  /// The positions the joint passes if it takes this step and then brakes.
  Span SpanAfter(int step) const;

  /// The positions the joint passes if it brakes at once.
  Span BrakingSpan() const;

  /// One frame passes.
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
  int step_;  ///< of the last frame
  int target_;
  int frames_left_;
  int step_limit_;
  int acceleration_;         ///< limit in force
  int wanted_acceleration_;  ///< limit asked for
  bool is_following_;        ///< in the next frame
  double fraction_of_step_;  ///< how far rounding has put the joint behind, in steps, 0..1
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H
