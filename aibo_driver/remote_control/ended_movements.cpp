#include "remote_control/ended_movements.h"

#include <algorithm>

#include "remote_control/from_ros.h"

namespace aibo_driver::remote_control {
namespace {

QString nameOf(const Movement& movement) {
  switch (movement.kind) {
    case Movement::COMMAND:
      return "joints";
    case Movement::TRAJECTORY:
      return "trajectory";
    case Movement::WALK:
      return "walk";
    case Movement::LOOK_AT:
      return "look there";
    default:
      return fromRos(movement.name);
  }
}

}  // namespace

// The old list has lost some entries at its beginning and got some at its end.
std::vector<EndedMovement> endedBetween(const std::vector<EndedMovement>& before,
                                        const std::vector<EndedMovement>& now) {
  for (auto first = before.begin(); first != before.end(); ++first) {
    const auto kept = before.end() - first;
    if (kept <= static_cast<std::ptrdiff_t>(now.size()) && std::equal(first, before.end(), now.begin())) {
      return {now.begin() + kept, now.end()};
    }
  }
  return now;
}

QString complaintAbout(const EndedMovement& ended) {
  switch (ended.how) {
    case EndedMovement::DONE:
    case EndedMovement::REPLACED:
    case EndedMovement::STOPPED:
      return "";
    default:
      return nameOf(ended.movement) + ": " + fromRos(ended.reason);
  }
}

}  // namespace aibo_driver::remote_control
