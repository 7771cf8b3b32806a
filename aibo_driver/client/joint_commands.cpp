#include "client/joint_commands.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "client/client_options.h"
#include "protocol/version2.h"

namespace aibo_driver {
namespace {

constexpr double kFullTurn = 2 * 3.14159265358979323846;  // rad
constexpr double kGreatestSpeed = 100;                    // rad/s

/// Removes the joints of `newer` from `joints`.
template <typename Joint>
void removeJointsOf(const std::vector<Joint>& newer, std::vector<Joint>* joints) {
  const auto is_newer = [&newer](const Joint& joint) {
    return std::any_of(newer.begin(), newer.end(), [&joint](const Joint& other) { return other.id == joint.id; });
  };
  joints->erase(std::remove_if(joints->begin(), joints->end(), is_newer), joints->end());
}

/// Takes at most so many from the front of `joints`.
template <typename Joint>
std::vector<Joint> takeFront(std::size_t most, std::vector<Joint>* joints) {
  const auto end = joints->begin() + static_cast<std::ptrdiff_t>(std::min(most, joints->size()));
  std::vector<Joint> taken(joints->begin(), end);
  joints->erase(joints->begin(), end);
  return taken;
}

template <typename Joint>
void checkIds(const std::vector<Joint>& joints) {
  checkRange("the number of joints", static_cast<long long>(joints.size()), 1, protocol::version2::MAX_JOINTS);
  std::set<int> ids;
  for (const Joint& joint : joints) {
    checkRange("a joint's id", joint.id, 1, 255);
    if (!ids.insert(joint.id).second) {
      throw InvalidArgumentException("joint " + std::to_string(joint.id) + " is named twice");
    }
  }
}

void require(bool good, int id, const std::string& problem) {
  if (!good) {
    throw InvalidArgumentException("joint " + std::to_string(id) + ": " + problem);
  }
}

}  // namespace

void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration) {
  checkIds(targets);
  checkRange("duration", duration.count(), 0, 65535, " ms");
  for (const JointTarget& target : targets) {
    require(std::abs(target.position) <= kFullTurn, target.id,
            "its position is " + std::to_string(target.position) + " rad, but has to be -2 pi..2 pi");
  }
}

void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  checkIds(limits);
  for (const JointSpeedLimit& limit : limits) {
    require(limit.speed > 0 && limit.speed <= kGreatestSpeed, limit.id,
            "its speed limit is " + std::to_string(limit.speed) + " rad/s, but has to be above 0 and at most 100");
  }
}

void JointCommands::add(JointCommand command) {
  for (JointCommand& older : commands_) {
    removeJointsOf(command.targets, &older.targets);
  }
  commands_.push_back(std::move(command));
  const auto is_empty = [](const JointCommand& each) { return each.targets.empty(); };
  commands_.erase(std::remove_if(commands_.begin(), commands_.end(), is_empty), commands_.end());
}

void JointCommands::add(const std::vector<JointSpeedLimit>& limits) {
  removeJointsOf(limits, &speed_limits_);
  speed_limits_.insert(speed_limits_.end(), limits.begin(), limits.end());
}

void JointCommands::append(const JointCommands& newer) {
  for (const JointCommand& command : newer.commands_) {
    add(command);
  }
  add(newer.speed_limits_);
}

std::vector<JointSpeedLimit> JointCommands::takeSpeedLimits(std::size_t most) {
  return takeFront(most, &speed_limits_);
}

JointCommand JointCommands::takeTargets(std::size_t most) {
  JointCommand taken = {commands_.front().duration, takeFront(most, &commands_.front().targets)};
  if (commands_.front().targets.empty()) {
    commands_.pop_front();
  }
  return taken;
}

}  // namespace aibo_driver
