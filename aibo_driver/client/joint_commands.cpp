#include "client/joint_commands.h"

#include <algorithm>
#include <cmath>
#include <map>
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

template <typename Joint>
bool names(const std::vector<Joint>& joints, int id) {
  return std::any_of(joints.begin(), joints.end(), [id](const Joint& joint) { return joint.id == id; });
}

bool shareAJoint(const JointCommand& a, const JointCommand& b) {
  return std::any_of(a.targets.begin(), a.targets.end(),
                     [&b](const JointTarget& target) { return names(b.targets, target.id); });
}

/// Removes targets from the commands, and the commands that have none left.
template <typename Condition>
void removeTargets(std::deque<JointCommand>* commands, const Condition& condition) {
  for (JointCommand& command : *commands) {
    command.targets.erase(std::remove_if(command.targets.begin(), command.targets.end(), condition),
                          command.targets.end());
  }
  const auto is_empty = [](const JointCommand& command) { return command.targets.empty(); };
  commands->erase(std::remove_if(commands->begin(), commands->end(), is_empty), commands->end());
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

void JointCommands::add(const JointCommand& command) {
  const auto place = std::find_if(commands_.begin(), commands_.end(),
                                  [&command](const JointCommand& older) { return shareAJoint(older, command); });
  const auto before = place - commands_.begin();  // no older command before this place names any of the joints
  removeTargets(&commands_, [&command](const JointTarget& target) { return names(command.targets, target.id); });
  commands_.insert(commands_.begin() + before, command);
}

void JointCommands::add(const std::vector<JointSpeedLimit>& limits) {
  for (const JointSpeedLimit& limit : limits) {
    const auto older = std::find_if(speed_limits_.begin(), speed_limits_.end(),
                                    [&limit](const JointSpeedLimit& each) { return each.id == limit.id; });
    if (older == speed_limits_.end()) {
      speed_limits_.push_back(limit);
    } else {
      *older = limit;
    }
  }
}

void JointCommands::append(const JointCommands& newer) {
  for (const JointCommand& command : newer.commands_) {
    add(command);
  }
  add(newer.speed_limits_);
}

std::vector<JointSpeedLimit> JointCommands::takeSpeedLimits(std::size_t most) {
  const auto end = speed_limits_.begin() + static_cast<std::ptrdiff_t>(std::min(most, speed_limits_.size()));
  std::vector<JointSpeedLimit> taken(speed_limits_.begin(), end);
  speed_limits_.erase(speed_limits_.begin(), end);
  return taken;
}

JointCommand JointCommands::takeCommand() {
  JointCommand command = std::move(commands_.front());
  commands_.pop_front();
  return command;
}

JointTarget JointCommands::takeTargetAfter(int id) {
  std::map<int, JointTarget> targets;
  for (const JointCommand& command : commands_) {
    for (const JointTarget& target : command.targets) {
      targets[target.id] = target;
    }
  }
  const auto next = targets.upper_bound(id);
  const JointTarget taken = next == targets.end() ? targets.begin()->second : next->second;
  removeTargets(&commands_, [&taken](const JointTarget& target) { return target.id == taken.id; });
  return taken;
}

}  // namespace aibo_driver
