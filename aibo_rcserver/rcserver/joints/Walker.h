/// @file Walker.h
/// Moves the legs when the robot walks or takes a posture.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_WALKER_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_WALKER_H

#include "protocol/version2.h"
#include "protocol/walk_requests.h"
#include "rcserver/joints/EndLog.h"
#include "rcserver/joints/MotionPlanner.h"
#include "rcserver/walk/FallWatch.h"
#include "rcserver/walk/Gait.h"
#include "rcserver/walk/Postures.h"
#include "rcserver/walk/WalkedVelocity.h"
#include "robot_model/robot_model.h"

/// Sets the targets of the legs' joints, frame by frame, while the robot walks or takes a posture. It does one of the
/// two at a time; head, tail and mouth are left alone, except that the head is levelled while the robot lies down to
/// rest.
///
/// A walk begins in the stand: from any other posture, the robot first rises, slowly. Its velocity changes by twice the
/// highest one in a second, and it ends in the stand. A walk that is not steered for STEERING_TIMEOUT_MS ends.
///
/// The planner keeps all limits, as for motions and commands. What the feet really do is TakeVelocity().
class Walker {
 public:
  /// Greatest speed of a joint on the way to a posture, in microradian/s: 45 degrees a second. Our choice: half of what
  /// motions take, because the legs bear the robot.
  static const int POSTURE_SPEED = 785398;

  /// Frames without Steer() after which a walk ends.
  static const int STEERING_FRAMES =
      (static_cast<int>(protocol::version2::STEERING_TIMEOUT_MS) - 1) / robot_model::FRAME_MILLISECONDS + 1;

  /// All must outlive this.
  Walker(MotionPlanner& planner, const robot_model::RobotModel& robot, EndLog& ends);

  /// False if the robot's legs are not an ERS-7's. Then nothing else may be called but what asks.
  bool CanWalk() const { return can_walk_; }

  /// The numbers of the gait, with its limits.
  const GaitParameters& Parameters() const { return gait_.Parameters(); }

  /// Why the robot cannot take a posture now, in words that a user can act on; NULL if it can.
  const char* Problem();

  /// The same for a walk. To be called each time that the robot is told to walk: after a walk was refused, or ended by
  /// anything but its client's steering, its client has to let go, that is, to steer with zeros or not at all for
  /// STEERING_TIMEOUT_MS. Otherwise a client that steers again and again would overrule what has ended the walk.
  const char* ProblemOfWalk(bool motors_are_on);

  /// Walks, or goes on walking, with another velocity. All 0 ends the walk, and is ignored without one. Otherwise only
  /// if there is no ProblemOfWalk(); the speed limits of the legs are the robot's own from then on.
  /// @return the velocity that is walked: Gait::Limited()
  protocol::version2::Velocity Steer(const protocol::version2::Velocity& wanted);

  /// Takes a posture. A walk ends in the stand first. Only if there is no Problem().
  void Take(protocol::version2::Posture posture);

  /// Ends what is being done at once: the legs brake, stop and hold. A client that steers has to let go first.
  void Stop(const EndReason& reason);

  /// The same for motors that are being switched off. A robot that has lain down to rest is done with that.
  void MotorsGoOff(const EndReason& reason);

  /// The client is gone. A walk ends in the stand, a posture at once, except that the robot goes on to rest: half
  /// crouched, with its motors on, it would get hot. The next client is told of neither.
  void ClientGone();

  /// True if this is a joint of a leg.
  bool Moves(int joint) const;

  /// True if this joint is one of those that are levelled when the robot lies down to rest.
  bool IsOfHead(int joint) const;

  /// True if this joint is levelled when the robot lies down to rest, as it was told last.
  bool Levels(int joint) const;

  /// Something else decides where this joint is: it is not levelled any more.
  void LeaveAlone(int joint);

  /// True while the robot walks or takes a posture.
  bool IsActive() const { return activity_ != IDLE; }

  /// The same, unless it has only to wait for its motors to go off.
  bool IsMoving() const { return activity_ != IDLE && !is_resting_; }

  /// Sets the targets for the next frame. Call once in each frame, before MotionPlanner::NextFrame().
  void NextFrame();

  /// Looks at how the legs have moved. Call after MotionPlanner::NextFrame().
  void HaveMoved();

  /// What the accelerometer and the paws say: a robot that has fallen or is carried stops.
  /// @param frame OPEN-R frame
  void Measured(FallWatch::Reading reading, unsigned frame);

  /// True if the motors have to go off, which MotorsGoOff() confirms: the robot has lain down to rest; or
  /// GoesSoft().
  bool WantsMotorsOff() const { return has_rested_ || goes_soft_; }

  /// True if the robot has been lying on its side or its back for a second, and its legs were last moved here. They
  /// must not push against whatever is there.
  bool GoesSoft() const { return goes_soft_; }

  /// True once after the legs have gone soft.
  bool TakeSoftened();

  const FallWatch& Fall() const { return fall_watch_; }

  /// How the robot is.
  /// @param positions where its joints are, by the robot's table
  protocol::version2::Posture Now(const int* positions) const;

  /// @name What telemetry says
  /// @{
  protocol::version2::WalkState State() const;
  double Phase() const { return phase_; }

  /// How fast it has walked since the last call: WalkedVelocity::Take().
  protocol::version2::Velocity TakeVelocity() { return walked_.Take(activity_ == WALKING); }
  /// @}

 private:
  enum Activity { IDLE, TAKING_POSTURE, WALKING };

  Walker(const Walker&);
  Walker& operator=(const Walker&);

  bool FindJoints();
  bool IsWalk() const { return IsActive() && is_walk_; }
  int FindSlowJoint() const;
  void FindLegs(robot_model::LegAngles* legs) const;
  void Brake(const EndReason& reason);
  void MustLetGo(const EndReason& reason);
  void Begin(bool is_walk, protocol::version2::Posture posture);
  void TakeNextPosture();
  bool HaveArrived() const;
  void LevelHead(int milliseconds);
  void EndWalkInStand(const EndReason& reason);
  void Walk();
  void ChangeVelocity();
  void SetFeet();
  void StandsAfterWalk();
  void ReplaceNext(const EndReason& reason);
  void Finish(const EndReason& reason);

  MotionPlanner& planner_;
  const robot_model::RobotModel& robot_;
  const Gait gait_;
  const Postures postures_;
  WalkedVelocity walked_;
  FallWatch fall_watch_;
  EndLog& ended_;
  int joints_[robot_model::NUMBER_OF_LEGS][robot_model::JOINTS_OF_A_LEG];  ///< in the robot's table
  bool can_walk_;
  Activity activity_;
  bool has_legs_;    ///< nobody else has moved them since
  bool is_resting_;  ///< lies, and waits until the joints have followed
  bool has_rested_;  ///< they have
  bool goes_soft_;
  bool has_softened_;
  bool is_orphan_;        ///< the client that gave the order has gone
  bool next_is_orphan_;   ///< the same for the posture next_
  unsigned measured_;     ///< frame
  unsigned rests_since_;  ///< frame
  char problem_[EndLog::MAX_TEXT_SIZE];
  bool must_let_go_;                 ///< the client, before it can walk again
  unsigned last_asked_;              ///< frame in which the robot was told to walk
  char why_[EndLog::MAX_TEXT_SIZE];  ///< the client must let go

  /// @name What is being done
  /// @{
  bool is_walk_;
  protocol::version2::Posture posture_;  ///< if it is no walk
  protocol::version2::Posture way_[Postures::MAX_WAY];
  int way_size_;
  int way_begun_;  ///< how many of its postures
  static const int LEVELLED = 3;
  int head_[LEVELLED];     ///< the joints that are levelled
  bool levels_[LEVELLED];  ///< and nothing else has moved them since
  /// @}

  /// @name The walk
  /// @{
  bool ends_;  ///< in the stand, for end_reason_
  EndReason end_reason_;
  bool has_next_;  ///< then posture next_ is taken
  protocol::version2::Posture next_;
  protocol::version2::Velocity wanted_;
  protocol::version2::Velocity velocity_;
  double effort_;
  double phase_;
  int frames_since_steered_;
  /// @}
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_WALKER_H
