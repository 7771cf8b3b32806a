#include "movement/movement.h"

#include "text/plain_text.h"

namespace aibo_driver::movement {
namespace {

// The longest sentence about a joint that was left out.
constexpr std::size_t kLongest = 200;  // bytes

}  // namespace

std::string describeTooMany(std::size_t names) {
  return names <= kMostNames ? ""
                             : "it names " + std::to_string(names) + ", and at most " + std::to_string(kMostNames) +
                                   " names are allowed";
}

std::string listOf(const std::vector<std::string>& names, const std::string& separator) {
  text::FirstThree first(kLongest);
  for (const std::string& name : names) {
    first.add(name);
  }
  return first.text(separator);
}

std::string describe(const Movement& movement) {
  const std::string of_joints = movement.joints.empty() ? "" : " of " + listOf(movement.joints);
  switch (movement.kind) {
    case Movement::Kind::kMotion:
      return "motion " + movement.name;
    case Movement::Kind::kPosture:
      return "posture " + movement.name;
    case Movement::Kind::kWalk:
      return movement.name.empty() ? "walk" : "walk " + movement.name;
    case Movement::Kind::kLookAt:
      return "look_at" + of_joints;
    case Movement::Kind::kTrajectory:
      return "trajectory" + of_joints;
    case Movement::Kind::kCommand:
      break;
  }
  return "command" + of_joints;
}

}  // namespace aibo_driver::movement
