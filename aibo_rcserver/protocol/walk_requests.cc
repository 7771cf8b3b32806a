#include "protocol/walk_requests.h"

namespace protocol {
namespace version2 {

bool canTake(unsigned char id) {
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
