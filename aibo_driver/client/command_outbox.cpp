#include "client/command_outbox.h"

#include <algorithm>
#include <map>
#include <utility>

namespace aibo_driver {
namespace {

bool names(const std::vector<JointTarget>& targets, int id) {
  return std::any_of(targets.begin(), targets.end(), [id](const JointTarget& target) { return target.id == id; });
}

bool shareAJoint(const JointCommand& a, const JointCommand& b) {
  return std::any_of(a.targets.begin(), a.targets.end(),
                     [&b](const JointTarget& target) { return names(b.targets, target.id); });
}

/// @return false if there was nothing to remove
template <typename Condition>
bool removeCommands(std::deque<JointCommand>* commands, const Condition& condition) {
  const auto end = std::remove_if(commands->begin(), commands->end(), condition);
  const bool found = end != commands->end();
  commands->erase(end, commands->end());
  return found;
}

/// Removes targets from the commands, and the commands that have none left.
template <typename Condition>
void removeTargets(std::deque<JointCommand>* commands, const Condition& condition) {
  for (JointCommand& command : *commands) {
    command.targets.erase(std::remove_if(command.targets.begin(), command.targets.end(), condition),
                          command.targets.end());
  }
  const auto is_empty = [](const JointCommand& command) { return command.targets.empty(); };
  removeCommands(commands, is_empty);
}

}  // namespace

void JointCommands::add(JointCommand command) {
  const auto place = std::find_if(commands_.begin(), commands_.end(),
                                  [&command](const JointCommand& older) { return shareAJoint(older, command); });
  const auto before = place - commands_.begin();  // no older command before this place names any of the joints
  removeTargets(&commands_, [&command](const JointTarget& target) { return names(command.targets, target.id); });
  commands_.insert(commands_.begin() + before, std::move(command));
}

void JointCommands::append(JointCommands newer, TimePoint now) {
  for (JointCommand& command : newer.commands_) {
    command.since = now;
    add(std::move(command));
  }
}

bool JointCommands::dropOlderThan(TimePoint time) {
  return removeCommands(&commands_, [time](const JointCommand& command) { return command.since < time; });
}

void JointCommands::drop(const std::vector<int>& ids) {
  removeTargets(&commands_, [&ids](const JointTarget& target) {
    return ids.empty() || std::find(ids.begin(), ids.end(), target.id) != ids.end();
  });
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

void CommandOutbox::append(CommandOutbox newer, JointCommands::TimePoint now) {
  speed_limits.add(newer.speed_limits.items());
  joints.append(std::move(newer.joints), now);
  if (newer.steering) {
    steering = SteeringCommand{newer.steering->velocity, now};
  }
  leds.add(newer.leds.items());
  ears.add(newer.ears.items());
}

}  // namespace aibo_driver
