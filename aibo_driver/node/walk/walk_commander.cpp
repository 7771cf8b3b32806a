#include "node/walk/walk_commander.h"

#include <chrono>
#include <cmath>

#include "node/orders.h"
#include "text/sentence.h"

namespace aibo_driver::node {
namespace {

using Twist = geometry_msgs::Twist;
using Seconds = std::chrono::duration<double>;

bool isFinite(const geometry_msgs::Vector3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

}  // namespace

void WalkCommander::subscribe(const ros::NodeHandle& handle) {
  timer_ = makeOneShotTimer(handle, settings_.timeout, [this] { runOut(); });
  constexpr std::uint32_t kNewest = 1;
  subscriber_ = subscribeToOrders<Twist>(handle, "cmd_vel", kNewest,
                                         [this](const auto& message, const auto& order) { receive(message, order); });
}

void WalkCommander::receive(const Twist& message, const movement::Order& order) {
  if (!isFinite(message.linear) || !isFinite(message.angular)) {
    mover_.refuse(order, movement::Movement::Kind::kWalk, {},
                  "it has a value that is NaN or infinite. Without a good message the robot stops.");
    return;
  }
  const aibo_client::WalkVelocity wanted{message.linear.x, message.linear.y, message.angular.z};
  mover_.steer(order, walk::velocityToSend(wanted, settings_, client_.status().robot.walk_limits));
  if (wanted.isZero()) {
    timer_.stop();
  } else {
    restart(&timer_);
  }
}

void WalkCommander::runOut() {
  mover_.stopWalking("no cmd_vel came for " + text::decimal(Seconds(settings_.timeout).count(), 1) + " s");
}

}  // namespace aibo_driver::node
