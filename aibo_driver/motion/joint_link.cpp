#include "motion/joint_link.h"

#include <utility>

namespace aibo_driver {

JointLink::JointLink(Robot robot) : robot_(std::move(robot)) {}

void JointLink::send(const std::vector<JointOrder>& orders, std::chrono::milliseconds duration) {
  if (orders.empty()) {
    return;
  }
  const std::uint64_t connection = robot_.connections();
  if (connection != speeds_connection_) {
    speeds_.clear();
    speeds_connection_ = connection;
  }
  std::vector<JointSpeedLimit> limits;
  std::vector<JointTarget> targets;
  for (const JointOrder& order : orders) {
    const auto known = speeds_.find(order.id);
    if (known == speeds_.end() || known->second != order.speed) {
      limits.push_back({order.id, order.speed});
    }
    targets.push_back({order.id, order.position});
  }
  if (!limits.empty()) {
    robot_.set_speed_limits(limits);
    for (const JointSpeedLimit& limit : limits) {
      speeds_[limit.id] = limit.speed;
    }
  }
  robot_.command(targets, duration);
}

}  // namespace aibo_driver
