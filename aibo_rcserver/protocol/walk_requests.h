/// Version 2's requests to walk and take postures, and the telemetry of a walk.
#ifndef AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// How long a robot walks on without a new `S`. After this time, it stops walking and stands.
const unsigned STEERING_TIMEOUT_MS = 500;

/// Bits of the id of `S`.
enum SteeringOption {
  STEER_GUARDED = 1  ///< the walk slows down and ends before edges and walls, and where the robot cannot see
};

/// A velocity; in a payload: int16 forward and left in mm/s, int16 turn in mrad/s.
struct Velocity {
  double forward;  ///< m/s, negative is backward
  double left;     ///< m/s, negative is to the right
  double turn;     ///< rad/s, positive is to the left (counterclockwise from above)

  bool isZero() const { return forward == 0 && left == 0 && turn == 0; }

  template <typename Fields>
  void visit(Fields& fields) {
    fields.thousandths(forward);
    fields.thousandths(left);
    fields.thousandths(turn);
  }
};

/// Payload of `S`. If the velocity is all 0, the robot stops and stands, however late.
struct SteeringOrder {
  unsigned not_after;  ///< frame (isTooOld())
  Velocity velocity;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(not_after);
    fields.item(velocity);
    fields.zeros(2);
  }
};

/// Payload of the reply to `S`.
struct SteeringReply {
  Velocity velocity;    ///< the velocity in force, within the robot's WalkLimits
  unsigned short walk;  ///< number of the `S` that began the walk; 0 if there is no walk

  template <typename Fields>
  void visit(Fields& fields) {
    fields.item(velocity);
    fields.number(walk);
  }
};

const Request STEER = {REQUEST_STEER, "walk", MOVES_BODY, NULL};

/// The robot's greatest velocities, as in the hello (hello.h). They are not negative, and all 0 if it cannot walk.
struct WalkLimits {
  double forward;  ///< m/s
  double back;     ///< m/s
  double left;     ///< m/s, to either side
  double turn;     ///< rad/s, in either direction
};

/// Payload of `E`, whose id is a Posture. The empty reply comes when the robot begins to move. A pushed `i`
/// (ENDED_POSTURE) says how the posture ended.
struct PostureOrder {
  unsigned not_after;  ///< frame (isTooOld())

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(not_after);
  }
};

const Request TAKE_POSTURE = {REQUEST_POSTURE, "take the posture",
                              STARTS_MOVEMENT | TAKES_OVER_JOINTS | ENDS_WALK | MOVES_BODY, NULL};

/// True if `id` is that of a Posture that `E` can ask for: stand, sit or rest.
inline bool canTake(unsigned char id) {
  return id >= POSTURE_STAND && id <= POSTURE_REST;
}

/// The name in a pushed `i`: "stand", "sit" or "rest".
inline const char* postureName(Posture posture) {
  return posture == POSTURE_STAND ? "stand" : posture == POSTURE_SIT ? "sit" : "rest";
}

/// The name in a pushed `i` (ENDED_WALK).
const char WALK_NAME[] = "walk";

/// Identifiers in GROUP_WALK. The velocities are averages since the previous telemetry, computed from the measured
/// joints and pressed paws. If no foot slips, their integral over time is the distance walked.
enum WalkValue {
  WALK_FORWARD = 1,  ///< micrometre/s
  WALK_LEFT = 2,     ///< micrometre/s
  WALK_TURN = 3,     ///< microradian/s
  WALK_PHASE = 4,    ///< phase of the step, in millionths: 0..999999
  WALK_STATE = 5     ///< a WalkState; a receiver must accept unknown values
};

enum WalkState {
  WALK_STATE_NONE = 0,        ///< the robot does not walk
  WALK_STATE_GETS_READY = 1,  ///< the robot stands up
  WALK_STATE_WALKS = 2
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H
