#include "movement/joint_link.h"

#include "aibo_client/exceptions.h"

namespace aibo_driver::movement {

using aibo_client::JointSpeedLimit;

void requireDesign(const aibo_client::RcServerClient& client, const std::string& design) {
  const std::string said = client.status().robot.design;
  if (!design.empty() && !said.empty() && said != design) {
    throw aibo_client::CommandException("the robot says that it is an " + said +
                                        ", but the driver's parameter robot is " + design +
                                        ": start the driver with the right one.");
  }
}

void JointLink::send(const JointOrders& orders, std::chrono::milliseconds duration,
                     const aibo_client::OrderTerms& terms) {
  if (orders.empty()) {
    return;
  }
  std::vector<JointSpeedLimit> limits;
  std::vector<aibo_client::JointTarget> targets;
  for (const auto& [id, order] : orders) {
    limits.push_back({id, order.speed});
    targets.push_back({id, order.position});
  }
  limitSpeeds(limits);
  client_.commandJoints(targets, duration, terms);
}

void JointLink::limitSpeeds(const std::vector<JointSpeedLimit>& limits) {
  requireDesign();
  const std::uint64_t present = connection();
  if (present != speeds_connection_) {
    speeds_.clear();
    speeds_connection_ = present;
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
  client_.setJointSpeedLimits(changes);
  for (const JointSpeedLimit& limit : changes) {
    speeds_[limit.id] = limit.speed;
  }
}

}  // namespace aibo_driver::movement
