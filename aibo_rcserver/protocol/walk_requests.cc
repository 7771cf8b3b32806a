#include "protocol/walk_requests.h"

#include "protocol/big_endian.h"

namespace protocol {
namespace version2 {

size_t encodeVelocity(const Velocity& velocity, unsigned char* out) {
  encodeBigEndianSigned16(velocity.forward, out);
  encodeBigEndianSigned16(velocity.left, out + 2);
  encodeBigEndianSigned16(velocity.turn, out + 4);
  encodeBigEndian16(0, out + 6);
  return VELOCITY_SIZE;
}

const char* decodeVelocity(const unsigned char* payload, size_t size, Velocity* velocity) {
  if (size != VELOCITY_SIZE) {
    return "the payload does not have the size of a velocity";
  }
  if (decodeBigEndian16(payload + 6) != 0) {
    return "a reserved byte is not 0";
  }
  velocity->forward = decodeBigEndianSigned16(payload);
  velocity->left = decodeBigEndianSigned16(payload + 2);
  velocity->turn = decodeBigEndianSigned16(payload + 4);
  return NULL;
}

bool isPosture(unsigned char id) {
  return id >= POSTURE_STAND && id <= POSTURE_REST;
}

const char* postureName(Posture posture) {
  switch (posture) {
    case POSTURE_STAND:
      return "stand";
    case POSTURE_SIT:
      return "sit";
    default:
      return "rest";
  }
}

}  // namespace version2
}  // namespace protocol
