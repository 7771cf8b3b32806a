#include "joints/joint_link.h"

#include <utility>

namespace aibo_driver::joints {

JointLink::JointLink(Robot robot) : robot_(std::move(robot)) {}

void JointLink::send(const std::vector<JointOrder>& orders, std::chrono::milliseconds duration) {
  if (orders.empty()) {
    return;
  }
  std::vector<JointSpeedLimit> limits;
  std::vector<JointTarget> targets;
  for (const JointOrder& order : orders) {
    limits.push_back({order.id, order.speed});
    targets.push_back({order.id, order.position});
  }
  limitSpeeds(limits);
  robot_.command(targets, duration);
}

void JointLink::limitSpeeds(const std::vector<JointSpeedLimit>& limits) {
  const std::uint64_t connection = robot_.connections();
  if (connection != speeds_connection_) {
    speeds_.clear();
    speeds_connection_ = connection;
  }
  std::vector<JointSpeedLimit> changes;
  for (const JointSpeedLimit& limit : limits) {
    const auto known = speeds_.find(limit.id);
    if (known == speeds_.end() || known->second != limit.speed) {
      changes.push_back(limit);
    }
  }
  if (changes.empty()) {
    return;
  }
  robot_.set_speed_limits(changes);
  for (const JointSpeedLimit& limit : changes) {
    speeds_[limit.id] = limit.speed;
  }
}

}  // namespace aibo_driver::joints
