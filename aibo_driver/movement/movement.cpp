#include "movement/movement.h"

#include <algorithm>

namespace aibo_driver::movement {

std::string listOf(const std::vector<std::string>& names, const std::string& separator) {
  constexpr std::size_t kMost = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    list += (i == 0 ? "" : separator) + names[i];
  }
  return names.size() > kMost ? list + " and " + std::to_string(names.size() - kMost) + " more" : list;
}

std::string describe(const Movement& movement) {
  const std::string of_joints = movement.joints.empty() ? "" : " of " + listOf(movement.joints);
  switch (movement.kind) {
    case Movement::Kind::kMotion:
      return "The motion " + movement.name;
    case Movement::Kind::kPosture:
      return "The posture " + movement.name;
    case Movement::Kind::kWalk:
      return "The walk";
    case Movement::Kind::kLookAt:
      return "The look_at";
    case Movement::Kind::kTrajectory:
      return "The trajectory" + of_joints;
    case Movement::Kind::kCommand:
      break;
  }
  return "The command" + of_joints;
}

}  // namespace aibo_driver::movement
