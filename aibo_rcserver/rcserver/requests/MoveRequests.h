#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_MOVE_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_MOVE_REQUESTS_H

#include "protocol/walk_requests.h"
#include "rcserver/requests/Exchange.h"
#include "rcserver/requests/Robot.h"
#include "rcserver/requests/StickRequests.h"

/// Passes orders to joints, legs and motors, and reports how they end. StickRequests plays motions.
class MoveRequests {
 public:
  /// @param stick ends a motion whose file is being read when the robot is told to stop
  MoveRequests(const Robot& robot, StickRequests& stick, Exchange& exchange);

  /// Call this for a new client, to which nothing has been reported.
  void Begin() { told_.posture = NOTHING; }

  void MoveJoints();    ///< `J`
  void LimitSpeeds();   ///< `V`
  void SwitchMotors();  ///< `O`
  void Hold();          ///< `I`
  void Steer();         ///< `S`
  void TakePosture();   ///< `E`

  /// Pushes faults, recoveries, ends of orders and a fall. If the outbox has no room, the rest is pushed the next time.
  void PushReports();

  void PushMotorsAndPosture();

 private:
  enum { NOTHING = 255 };  // no posture has this number

  bool ArePositive(const protocol::version2::SpeedLimits& limits);
  bool HasJoints(const protocol::version2::JointValue* joints, int count);
  bool HasJoint(int identifier);
  void HoldJoints();
  bool MayTake(protocol::version2::Posture posture);
  void PushJointFaults();
  void PushRecoveries();

  const Robot& robot_;
  StickRequests& stick_;
  Exchange& exchange_;
  protocol::version2::MotorsAndPosture told_;  ///< what was pushed last; its posture is NOTHING before
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_MOVE_REQUESTS_H
