#include "movement/joint_command_filter.h"

#include <algorithm>
#include <cmath>

#include "text/sentence.h"

namespace aibo_driver::movement {
namespace {

// The time of an approach is longer by this, because the command has to reach the robot and the joint speeds up and
// brakes.
constexpr std::chrono::milliseconds kMargin{500};

// A joint that is this near to its target has followed it, and will not jump to its next target.
constexpr double kNear = 0.1;  // rad

// How far a position may exceed a limit: programs round a limit of 88 degrees to 1.536.
constexpr double kRounding = 0.001;  // rad

// The lowest speed that a command can have, because the protocol sends speeds as small whole numbers.
constexpr double kLowestSpeed = 0.001;  // rad/s

std::chrono::nanoseconds timeFor(double way, double speed) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(way / speed));
}

std::string describeMismatch(std::size_t names, std::size_t positions, std::size_t velocities) {
  if (names == 0) {
    return "A joint command names no joint.";
  }
  if (positions != names) {
    return "A joint command must have as many positions as names.";
  }
  if (velocities != 0 && velocities != names) {
    return "A joint command must have as many velocities as names, or none.";
  }
  return {};
}

}  // namespace

JointCommandFilter::JointCommandFilter(const JointTable& table, const MeasuredJoints& measured, double approach_speed)
    : table_(table), measured_(measured), approach_speed_(approach_speed), approaches_(table.size()) {}

std::vector<std::string> JointCommandFilter::filter(const std::vector<std::string>& names,
                                                    const std::vector<double>& positions,
                                                    const std::vector<double>& velocities, SteadyTime now,
                                                    JointTargets* targets) {
  const std::string mismatch = describeMismatch(names.size(), positions.size(), velocities.size());
  if (!mismatch.empty()) {
    return {mismatch};
  }
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double velocity = velocities.empty() ? 0 : velocities[i];
    const std::optional<std::size_t> index = table_.findByName(names[i]);
    if (!index) {
      remarks.push_back("The " + table_.design() + " has no joint '" + names[i] + "'.");
    } else if (!std::isfinite(positions[i])) {
      remarks.push_back("The position commanded for " + names[i] + " is not a finite number.");
    } else if (!std::isfinite(velocity)) {
      remarks.push_back("The velocity commanded for " + names[i] + " is not a finite number.");
    } else {
      const JointProperties& joint = table_[*index];
      (*targets)[joint.id] = targetFor(*index, positions[i], velocity, now);
      if (positions[i] < joint.lowest - kRounding || positions[i] > joint.highest + kRounding) {
        remarks.push_back("The position commanded for " + names[i] + " is beyond its limits, " +
                          text::decimal(joint.lowest, 3) + " to " + text::decimal(joint.highest, 3) +
                          " rad: it goes as far as it can.");
      }
    }
  }
  return remarks;
}

void JointCommandFilter::startApproach() {
  approaches_.assign(table_.size(), std::nullopt);
}

void JointCommandFilter::interruptApproach(SteadyTime now) {
  for (std::size_t i = 0; i < approaches_.size(); ++i) {
    if (approaches_[i] && now < approaches_[i]->end && !isNear(i, approaches_[i]->target)) {
      approaches_[i].reset();
    }
  }
}

aibo_client::JointTarget JointCommandFilter::targetFor(std::size_t index, double position, double velocity,
                                                       SteadyTime now) {
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

}  // namespace aibo_driver::movement
