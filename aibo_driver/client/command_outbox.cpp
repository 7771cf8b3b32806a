#include "client/command_outbox.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "robot_model/legs.h"

namespace aibo_client {
namespace {

using TimePoint = JointCommands::TimePoint;

bool names(const std::vector<JointTarget>& targets, int id) {
  return std::any_of(targets.begin(), targets.end(), [id](const JointTarget& target) { return target.id == id; });
}

bool shareAJoint(const JointCommand& a, const JointCommand& b) {
  return std::any_of(a.targets.begin(), a.targets.end(),
                     [&b](const JointTarget& target) { return names(b.targets, target.id); });
}

/// Removes targets from a command.
/// @return the command with the targets that were removed; it has no number if the rest of its order goes on
template <typename Condition>
JointCommand takeTargets(JointCommand* command, const Condition& condition) {
  JointCommand taken = {command->duration, {}, command->terms};
  const auto end = std::stable_partition(command->targets.begin(), command->targets.end(),
                                         [&condition](const JointTarget& target) { return !condition(target.id); });
  taken.targets.assign(end, command->targets.end());
  command->targets.erase(end, command->targets.end());
  if (command->has_begun || !command->targets.empty()) {
    taken.terms.number = 0;
  }
  return taken;
}

}  // namespace

bool isOfLeg(int joint) {
  for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
    for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
      if (robot_model::legJointIdentifier(static_cast<robot_model::Leg>(leg), number) == joint) {
        return true;
      }
    }
  }
  return false;
}

std::vector<JointCommand> JointCommands::add(JointCommand command) {
  const auto place = std::find_if(commands_.begin(), commands_.end(),
                                  [&command](const JointCommand& older) { return shareAJoint(older, command); });
  const auto before = place - commands_.begin();  // no older command before this place names any of the joints
  std::vector<JointCommand> replaced = takeJoints([&command](int id) { return names(command.targets, id); });
  commands_.insert(commands_.begin() + before, std::move(command));
  return replaced;
}

std::vector<JointCommand> JointCommands::takeTooOld(TimePoint now) {
  return take([now](const JointCommand& command, int) { return command.terms.not_after < now; });
}

std::vector<JointCommand> JointCommands::takeJoints(const std::function<bool(int id)>& condition) {
  return take([&condition](const JointCommand&, int id) { return condition(id); });
}

template <typename Condition>
std::vector<JointCommand> JointCommands::take(const Condition& condition) {
  std::vector<JointCommand> taken;
  for (JointCommand& command : commands_) {
    JointCommand part = takeTargets(&command, [&](int id) { return condition(command, id); });
    if (!part.targets.empty()) {
      taken.push_back(std::move(part));
    }
  }
  commands_.erase(std::remove_if(commands_.begin(), commands_.end(),
                                 [](const JointCommand& command) { return command.targets.empty(); }),
                  commands_.end());
  return taken;
}

bool JointCommands::has(std::uint64_t order) const {
  return std::any_of(commands_.begin(), commands_.end(),
                     [order](const JointCommand& command) { return command.terms.number == order; });
}

JointCommand JointCommands::takeCommand() {
  JointCommand command = std::move(commands_.front());
  commands_.pop_front();
  return command;
}

JointCommand JointCommands::takeTargetAfter(int id, TimePoint now) {
  std::map<int, JointCommand*> commanded;
  for (JointCommand& command : commands_) {
    for (const JointTarget& target : command.targets) {
      commanded[target.id] = &command;
    }
  }
  const auto next = commanded.upper_bound(id);
  const auto& [joint, command] = next == commanded.end() ? *commanded.begin() : *next;
  command->terms.not_after = now + kLongestOrderWait;
  command->has_begun = true;
  const std::uint64_t order = command->terms.number;
  JointCommand taken = takeJoints([joint = joint](int each) { return each == joint; }).front();
  taken.terms.number = order;
  return taken;
}

void CommandOutbox::command(JointCommand newer) {
  const bool takes_legs = std::any_of(newer.targets.begin(), newer.targets.end(),
                                      [](const JointTarget& target) { return isOfLeg(target.id); });
  if (takes_legs) {
    drop(&steering, RefusalCause::kReplaced, "a command to the legs came before this one was sent");
  }
  std::vector<JointCommand> replaced = joints.add(std::move(newer));
  replaced.erase(std::remove_if(replaced.begin(), replaced.end(),
                                [](const JointCommand& command) { return command.terms.number == 0; }),
                 replaced.end());
  drop(replaced, RefusalCause::kReplaced, "newer commands took all joints of this one before it was sent");
}

void CommandOutbox::steer(const SteeringCommand& newer) {
  const bool is_zero = newer.velocity.isZero();
  if (!is_zero) {
    drop(joints.takeJoints(isOfLeg), RefusalCause::kReplaced, "a walk was commanded before this was sent");
  }
  for (std::optional<SteeringCommand>* const older : {&steering, is_zero ? &let_go : &steering}) {
    if (*older && (*older)->terms.number == 0) {
      older->reset();
    }
    drop(older, RefusalCause::kReplaced, "another velocity came before this one was sent");
  }
  (is_zero ? let_go : steering) = newer;
}

void CommandOutbox::stopJoints(const std::vector<int>& ids, const std::string& reason) {
  const auto is_meant = [&ids](int id) { return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end(); };
  drop(joints.takeJoints(is_meant), RefusalCause::kStopped, reason);
}

void CommandOutbox::stopWalk(bool with_zero, const std::string& reason) {
  drop(&steering, RefusalCause::kStopped, reason);
  if (with_zero) {
    drop(&let_go, RefusalCause::kStopped, reason);
  }
}

void CommandOutbox::dropTooOld(TimePoint now, const std::string& reason) {
  drop(joints.takeTooOld(now), RefusalCause::kTooOld, reason);
  if (steering && steering->terms.not_after < now) {
    drop(&steering, RefusalCause::kTooOld, reason);
  }
}

void CommandOutbox::drop(const std::vector<JointCommand>& commands, RefusalCause cause, const std::string& reason) {
  for (const JointCommand& command : commands) {
    Refusal refusal = {RefusedRequest::kJoints, cause, {}, reason, command.terms.number};
    for (const JointTarget& target : command.targets) {
      refusal.ids.push_back(target.id);
    }
    refuse(refusal);
  }
}

// Losing a velocity of 0 does no harm: a stop or another velocity takes its place. But its order has to end.
void CommandOutbox::drop(std::optional<SteeringCommand>* velocity, RefusalCause cause, const std::string& reason) {
  const std::optional<SteeringCommand> gone = std::exchange(*velocity, std::nullopt);
  if (gone && (!gone->velocity.isZero() || gone->terms.number != 0)) {
    refuse({RefusedRequest::kWalk, cause, {}, reason, gone->terms.number});
  }
}

}  // namespace aibo_client
