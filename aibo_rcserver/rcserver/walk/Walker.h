#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALKER_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALKER_H

#include "protocol/version2.h"
#include "protocol/walk_requests.h"
#include "rcserver/joints/JointPlanner.h"
#include "rcserver/joints/OrderBook.h"
#include "rcserver/walk/FallWatch.h"
#include "rcserver/walk/Gait.h"
#include "rcserver/walk/HeadLevel.h"
#include "rcserver/walk/LegJoints.h"
#include "rcserver/walk/Postures.h"
#include "rcserver/walk/WalkGuard.h"
#include "rcserver/walk/WalkPace.h"
#include "rcserver/walk/WalkedVelocity.h"
#include "robot_model/robot_model.h"

/// Sets the targets of the legs' joints, frame by frame, while the robot walks or takes a posture. It does one of the
/// two at a time. It does not move head, tail and mouth, except that it levels the head while the robot lies down to
/// rest or gets up.
///
/// When a walk begins and when it ends, the robot stands. From any other posture, it first rises slowly. A walk that is
/// not steered for STEERING_TIMEOUT_MS ends.
///
/// A robot that lies on a side or its back can only stand up: it rolls onto its belly first. If a joint cannot follow
/// on the route to a posture, the joint yields, and the robot tries another route.
///
/// The planner enforces all limits, as for motions and commands.
class Walker {
 public:
  /// Highest speed of a joint on the route to a posture, in microradian/s: 45 degrees per second. We chose half of the
  /// speed of motions, because the legs carry the robot.
  static const int POSTURE_SPEED = 785398;

  /// The highest speed while the legs do not carry the robot: 90 degrees per second. While the robot gets up from a
  /// side or its back, it moves twice as fast, so that it is up within 10 s, but does not push harder. Our choice.
  static const int UNLOADED_SPEED = 2 * POSTURE_SPEED;

  /// How often a robot tries to get up, or to get around a joint that does not follow. Our choice.
  static const int ATTEMPTS = 6;

  /// Frames without Steer() after which a walk ends.
  static const int STEERING_FRAMES =
      (static_cast<int>(protocol::version2::STEERING_TIMEOUT_MS) - 1) / robot_model::FRAME_MILLISECONDS + 1;

  Walker(JointPlanner& planner, const robot_model::RobotModel& robot, OrderBook& orders);

  /// False if the robot's legs are not an ERS-7's. In that case, only functions that read the state may be called.
  bool CanWalk() const { return legs_.AreThere(); }

  const GaitParameters& Parameters() const { return gait_.Parameters(); }

  /// An error text that tells the user why the robot cannot take this posture now; NULL if it can.
  const char* Problem(protocol::version2::Posture posture);

  /// Does the same for a walk. Call this each time that the robot is told to walk: if there is a problem, the client
  /// has to let go first (OrderBook).
  /// @param guarded the velocity if WalkGuard may object to it, or NULL
  const char* ProblemOfWalk(bool motors_are_on, const protocol::version2::Velocity* guarded = NULL);

  /// Starts a walk, or changes its velocity. A zero velocity lets go: it ends the walk, and is ignored without a walk.
  /// Any other velocity is allowed only if there is no ProblemOfWalk(), and resets the speed limits of the legs to the
  /// robot's own. It begins an order, unless a walk goes on that is not ending. The legs
  /// of a walk that is ending walk on without a stop.
  /// @param guarded true if the walk slows down and ends where WalkGuard objects
  /// @param number of the request of version 2, otherwise 0
  /// @return the velocity after Gait::Limited()
  protocol::version2::Velocity Steer(const protocol::version2::Velocity& wanted, bool guarded = false,
                                     unsigned short number = 0);

  /// True if Steer() would begin an order.
  bool BeginsOrder(const protocol::version2::Velocity& wanted) const {
    return !wanted.isZero() && (!IsWalk() || walk_.ends);
  }

  /// The number of the request that began the walk; 0 without a walk, or if the walk ends for a posture.
  unsigned short WalkNumber() const { return IsWalk() && !HasNext() ? orders_.Number(order_) : 0; }

  /// Takes a posture. The order to walk ends at once, but the robot first walks until it stands. Call it only if
  /// Problem() returns NULL for this posture.
  /// @param number of the request of version 2, otherwise 0
  void Take(protocol::version2::Posture posture, unsigned short number = 0);

  /// Ends the walk or posture at once: the legs brake, stop and hold.
  void Stop(const EndReason& reason);

  /// Does the same when the motors are being switched off. A robot that has lain down to rest has then finished.
  void MotorsGoOff(const EndReason& reason);

  /// Call this when the client is gone. A walk goes on until the robot stands, and a posture ends at once. Lying down
  /// to rest continues, because a robot that stays half crouched with its motors on gets hot.
  void ClientGone();

  bool Moves(int joint) const { return legs_.Has(joint); }

  /// True if the head has to be levelled for a posture, because the robot lies down to rest or gets up.
  bool NeedsLevelHead(protocol::version2::Posture posture) const;

  /// True if this joint is one of those of the head that are levelled.
  bool IsOfHead(int joint) const { return head_.Has(joint); }

  /// True if this joint is levelled in the posture that the robot was told to take last.
  bool Levels(int joint) const { return head_.Levels(joint); }

  /// Call this when the joint gets another command. It is not levelled any more.
  void LeaveAlone(int joint) { head_.LeaveAlone(joint); }

  /// True while the robot walks or takes a posture.
  bool IsActive() const { return activity_ != IDLE; }

  /// The same as IsActive(), but false while the robot only waits for its motors to go off.
  bool IsMoving() const { return activity_ == TAKING_POSTURE || activity_ == WALKING; }

  /// Call this when a joint does not follow its commands.
  /// @return true if the joint may yield, because the robot now tries another route to its posture
  bool TriesAnotherRoute(int joint);

  /// Sets the targets for the next frame. Call this once in each frame, before JointPlanner::NextFrame().
  void NextFrame();

  /// Call this for each report of the sensors. A robot that has fallen or is carried stops.
  /// @param reading the reading of the accelerometer and the paws
  /// @param positions the joints' positions by the robot's table
  /// @param frame OPEN-R frame
  void Measured(const FallWatch::Reading& reading, const int* positions, unsigned frame);

  /// Checks the distance sensors and the paws. A guarded walk ends where it must not go on. Call this after Measured().
  void HaveLooked(const WalkGuard::Reading& reading);

  /// True if the motors must go off because the robot has lain down to rest or GoesSoft(). MotorsGoOff() confirms.
  bool WantsMotorsOff() const { return activity_ == HAS_RESTED || goes_soft_; }

  /// True if the robot has been lying on its side or its back for a second, does not get up, and this class moved the
  /// legs last. The legs must not push against obstacles.
  bool GoesSoft() const { return goes_soft_; }

  /// True once after the motors have been switched off because of a fall.
  bool TakeSoftened();

  const FallWatch& Fall() const { return fall_watch_; }

  /// The robot's current posture.
  /// @param positions the joints' positions by the robot's table
  protocol::version2::Posture Now(const int* positions) const;

  // The state for telemetry.
  protocol::version2::WalkState State() const;
  double Phase() const { return activity_ == WALKING ? pace_.Phase() : 0; }

  /// The average velocity since the last call (WalkedVelocity::Take()).
  protocol::version2::Velocity TakeVelocity() { return walked_.Take(activity_ == WALKING); }

 private:
  enum Activity {
    IDLE,
    TAKING_POSTURE,  ///< or getting ready to walk
    WALKING,
    RESTING,    ///< the robot has lain down to rest, and waits until the joints have followed
    HAS_RESTED  ///< the joints have followed
  };

  /// The route to a posture or, if the robot rolls, onto the belly.
  struct Route {
    Postures::Stage stages[Postures::MAX_ROUTE];
    int size;
    int begun;             ///< number of stages that have begun
    bool gets_up;          ///< the robot gets up from a side or its back
    bool rolls;            ///< the route ends on the belly
    int attempts;          ///< number of routes that have begun
    bool plans_again;      ///< a joint did not follow
    int frames_to_settle;  ///< until the robot lies still at the route's end
  };

  /// The walk that goes on, or the last one.
  struct Steering {
    bool is_guarded;
    bool ends;  ///< the walk ends when the robot stands, for end_reason
    EndReason end_reason;
    protocol::version2::Posture next;  ///< the posture that follows the walk, and is the order; POSTURE_UNKNOWN if none
    protocol::version2::Velocity wanted;
    int frames_since_steered;
  };

  bool HasFallen() const { return FallWatch::IsFallen(fall_watch_.Now()) && FallWatch::IsFallen(fall_watch_.Last()); }
  bool IsWalk() const { return IsActive() && posture_ == protocol::version2::POSTURE_WALK; }
  bool HasNext() const { return walk_.next != protocol::version2::POSTURE_UNKNOWN; }
  void Brake(const EndReason& reason);
  void ReplaceOrder(const EndReason& reason, unsigned char what, unsigned short number, const char* name);
  void Begin(protocol::version2::Posture posture);
  void PlanRoute(bool lies_down);
  void BeginNextStage();
  void FinishRoute();
  int SpeedIn(Postures::Stage stage) const;
  bool HaveArrived();
  void EndWalkInStand(const EndReason& reason);
  void Walk();
  void Finish(const EndReason& reason);

  JointPlanner& planner_;
  const robot_model::RobotModel& robot_;
  const Gait gait_;
  const Postures postures_;
  WalkedVelocity walked_;
  WalkPace pace_;
  WalkGuard guard_;
  FallWatch fall_watch_;
  OrderBook& orders_;
  const LegJoints legs_;
  HeadLevel head_;
  Activity activity_;
  bool has_legs_;  ///< nothing else has moved the legs since
  bool goes_soft_;
  bool has_softened_;
  unsigned before_rest_;  ///< frame of the last measurement before the robot had lain down to rest
  char problem_[OrderBook::MAX_TEXT_SIZE];
  int order_;  ///< NO_ORDER if nothing is done, or if the client has gone before its posture could begin
  protocol::version2::Posture posture_;  ///< POSTURE_WALK if the robot walks, or gets ready to
  Route route_;
  Steering walk_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALKER_H
