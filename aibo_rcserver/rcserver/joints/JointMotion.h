/// @file JointMotion.h
/// How one joint gets from where it is to its target.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H

/// One joint on its way, frame by frame. Pure logic.
///
/// Everything is in whole numbers: positions in microradian, steps (speeds) in microradian a frame, accelerations in
/// microradian a frame a frame. So the target is met exactly, the limits hold to the last digit, and the robot computes
/// what the tests compute.
///
/// The joint speeds up or brakes at its acceleration limit until it has a cruising speed, keeps that, and brakes at the
/// acceleration limit again: a trapezoid, with the lowest cruising speed that arrives in time. The shape is worked out
/// anew for every frame, from where the joint is and how fast it moves. So whatever happens on the way, a new target,
/// new limits, somebody who holds the joint back, the speed never jumps.
///
/// A step may follow another one if they differ by no more than the acceleration limit; a joint stands if it may be
/// followed by a step of nothing.
class JointMotion {
 public:
  /// Where a joint may still get to if it brakes from now on.
  struct Span {
    int low;
    int high;
  };

  /// Stands at 0, which is its target, with limits of 1.
  JointMotion();

  /// Puts the joint where it was found, at rest. That is its target now.
  void Place(int position);

  /// @param step not below 1. A joint that moves faster brakes at its acceleration limit.
  void LimitStep(int step);

  /// @param acceleration not below 1. A lower limit than the present one is put off until the joint can stop with it
  ///   from one frame to the next: it could not stop where it was going to otherwise.
  void LimitAcceleration(int acceleration);

  /// A new target, to be reached as soon as the limits allow.
  void Aim(int target);

  /// A new target: the place where the joint stops if it brakes from now on.
  void Stop();

  int Position() const { return position_; }
  int Step() const { return step_; }
  int Target() const { return target_; }

  /// Frames until the joint is at its target and stands; more than at first if new limits or somebody who holds it back
  /// make it arrive later. 0: it is there.
  int FramesLeft() const { return frames_left_; }

  /// Makes the joint arrive later. More frames are always possible where fewer are.
  /// @param frames not below FramesLeft()
  void Delay(int frames) { frames_left_ = frames; }

  /// The step of the next frame, if nobody holds the joint back.
  int WantedStep();

  /// The step of the next frame if the joint brakes.
  int BrakingStep() const;

  /// Where the joint can be from now on if it brakes after a next step like this.
  Span SpanAfter(int step) const;

  /// Where the joint can be from now on if it brakes at once.
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
  int BrakingDistance(int step) const;

  int position_;
  int step_;  ///< of the last frame
  int target_;
  int frames_left_;
  int step_limit_;
  int acceleration_;         ///< limit in force
  int wanted_acceleration_;  ///< limit asked for
  double fraction_of_step_;  ///< how much of a step more the joint should have gone by now, 0 to 1
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_MOTION_H
