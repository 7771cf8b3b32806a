/// @file walk_requests.h
/// Version 2's requests about walking and postures, and what telemetry says about a walk. Decoders and encoders follow
/// the rules in version2.h.
#ifndef AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H

#include <stddef.h>

namespace protocol {
namespace version2 {

/// A robot that gets no new `S` for this time stops walking and stands.
const unsigned STEERING_TIMEOUT_MS = 500;

/// Payload of `S` and of its reply: int16 forward, int16 left, int16 turn, uint16 0. All 0: the robot stops walking and
/// stands. The reply has the velocity in force, which is within the robot's limits (WalkLimits).
struct Velocity {
  short forward;  ///< mm/s, negative = backward
  short left;     ///< mm/s, negative = to the right
  short turn;     ///< mrad/s, positive = to the left, that is, counterclockwise seen from above
};

const size_t VELOCITY_SIZE = 8;
size_t encodeVelocity(const Velocity& velocity, unsigned char* out);
const char* decodeVelocity(const unsigned char* payload, size_t size, Velocity* velocity);

/// How fast a robot can walk. None is negative, all are 0 if it cannot walk. The hello has them (hello.h).
struct WalkLimits {
  short forward;  ///< mm/s
  short back;     ///< mm/s
  short left;     ///< mm/s, to either side
  short turn;     ///< mrad/s, in either direction
};

/// Postures: the id of `E`, which has no payload. The empty reply comes when the robot has begun to move; a pushed `i`
/// (ENDED_POSTURE) says when and how it has ended.
enum Posture {
  POSTURE_STAND = 1,
  POSTURE_SIT = 2,
  POSTURE_REST = 3  ///< lies down, then switches the motors off
};

/// True if `id` is a Posture's.
bool isPosture(unsigned char id);

/// "stand", "sit" or "rest": the name in the pushed `i`.
const char* postureName(Posture posture);

/// The name in the pushed `i` of a walk (ENDED_WALK).
const char WALK_NAME[] = "walk";

/// Identifiers in the telemetry's GROUP_WALK. The velocity is that of the feet on the floor as commanded since the
/// telemetry before, on average, after all limits: its sum over time is the way.
enum WalkValue {
  WALK_FORWARD = 1,  ///< micrometre/s
  WALK_LEFT = 2,     ///< micrometre/s
  WALK_TURN = 3,     ///< microradian/s
  WALK_PHASE = 4,    ///< of the step, in millionths: 0..999999
  WALK_STATE = 5     ///< a WalkState; a receiver must accept values that it does not know
};

enum WalkState {
  WALK_STATE_NONE = 0,        ///< does not walk
  WALK_STATE_GETS_READY = 1,  ///< stands up
  WALK_STATE_WALKS = 2
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_WALK_REQUESTS_H
