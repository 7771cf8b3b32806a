#include "joints/joint_command_filter.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::joints {
namespace {

// Of an approach: for the way of the command to the robot, and for speeding up and braking.
constexpr std::chrono::milliseconds kMargin{500};

// A joint as near to its target has followed it, and does not jump to the next one.
constexpr double kNear = 0.1;  // rad

// The robot counts speeds in whole units, and not below a few of them.
constexpr double kLowestSpeed = 0.001;  // rad/s

std::chrono::nanoseconds timeFor(double way, double speed) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(way / speed));
}

std::string describeMismatch(const JointCommand& command) {
  if (command.names.empty()) {
    return "A joint command names no joint.";
  }
  if (command.positions.size() != command.names.size()) {
    return "A joint command must have as many positions as names.";
  }
  if (!command.velocities.empty() && command.velocities.size() != command.names.size()) {
    return "A joint command must have as many velocities as names, or none.";
  }
  return {};
}

}  // namespace

JointCommandFilter::JointCommandFilter(const JointTable& table, const MeasuredJoints& measured, double approach_speed)
    : table_(table), measured_(measured), approach_speed_(approach_speed), approaches_(table.size()) {}

FilteredCommand JointCommandFilter::filter(const JointCommand& command, SteadyTime now) {
  FilteredCommand result;
  const std::string mismatch = describeMismatch(command);
  if (!mismatch.empty()) {
    result.refusals.push_back(mismatch);
    return result;
  }
  for (std::size_t i = 0; i < command.names.size(); ++i) {
    const std::string& name = command.names[i];
    const double velocity = command.velocities.empty() ? 0 : command.velocities[i];
    const std::optional<std::size_t> index = table_.findByName(name);
    if (!index) {
      result.refusals.push_back("The " + table_.design() + " has no joint '" + name + "'.");
    } else if (!std::isfinite(command.positions[i])) {
      result.refusals.push_back("The position commanded for " + name + " is no finite number.");
    } else if (!std::isfinite(velocity)) {
      result.refusals.push_back("The velocity commanded for " + name + " is no finite number.");
    } else {
      const JointOrder order = orderFor(*index, command.positions[i], velocity, now);
      const auto same = std::find_if(result.orders.begin(), result.orders.end(),
                                     [&order](const JointOrder& other) { return other.id == order.id; });
      if (same == result.orders.end()) {
        result.orders.push_back(order);
      } else {
        *same = order;
      }
    }
  }
  return result;
}

void JointCommandFilter::startApproach() {
  approaches_.assign(table_.size(), std::nullopt);
}

JointOrder JointCommandFilter::orderFor(std::size_t index, double position, double velocity, SteadyTime now) {
  const JointProperties& joint = table_[index];
  const double target = std::clamp(position, joint.lowest, joint.highest);
  double speed = table_.speedLimit(index);
  if (velocity != 0) {
    speed = std::clamp(std::abs(velocity), kLowestSpeed, speed);
  }
  const double slow = std::min(speed, approach_speed_);
  return {joint.id, target, approaches(index, target, slow, now) ? slow : speed};
}

bool JointCommandFilter::approaches(std::size_t index, double target, double speed, SteadyTime now) {
  std::optional<Approach>& approach = approaches_[index];
  if (!approach) {
    const double longest_way = table_[index].highest - table_[index].lowest;
    approach = Approach{target, now + timeFor(distance(index, target), speed) + kMargin,
                        now + timeFor(longest_way, speed) + kMargin};
    return true;
  }
  if (now < approach->end && target != approach->target && isNear(index, approach->target)) {
    approach->end = now;
  }
  if (now >= approach->end) {
    return false;
  }
  approach->end = std::min(approach->latest_end, approach->end + timeFor(std::abs(target - approach->target), speed));
  approach->target = target;
  return true;
}

double JointCommandFilter::distance(std::size_t index, double target) const {
  const std::optional<MeasuredJoint> measured = measured_.find(index);
  if (measured) {
    return std::abs(target - measured->position);
  }
  return std::max(target - table_[index].lowest, table_[index].highest - target);
}

bool JointCommandFilter::isNear(std::size_t index, double target) const {
  const std::optional<MeasuredJoint> measured = measured_.find(index);
  return measured && std::abs(target - measured->position) < kNear;
}

}  // namespace aibo_driver::joints
