#include "node/joints/joint_commander.h"

#include <std_msgs/Float64.h>

#include <cmath>
#include <utility>

#include "aibo_client/exceptions.h"
#include "movement/joint_plan.h"
#include "node/orders.h"

namespace aibo_driver::node {

namespace {

using Kind = movement::Movement::Kind;

// Several programs may each command some of the joints, so messages must not replace each other. A driver that stalled
// reads all waiting messages at once, and each of them has to get its end.
constexpr std::uint32_t kCommandQueueSize = 200;

// The queue is short, but not 1: a newer trajectory replaces another one, unless it moves other joints.
constexpr std::uint32_t kTrajectoryQueueSize = 5;

constexpr std::size_t kMostBytesOfCommand = 256 << 10;   // far more than a command to all joints of a robot
constexpr std::size_t kMostBytesOfTrajectory = 1 << 20;  // all joints, thirty points a second, for a hundred seconds

// How far a stamp may be in the past: a message takes time to arrive, and the clocks of two machines differ a little.
constexpr double kLongestPast = 1.0;  // s

// A stamp that is further ahead comes from another clock, or it is garbage.
constexpr double kLongestWait = 3600.0;  // s

}  // namespace

std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now) {
  if (stamp.isZero()) {
    return std::chrono::nanoseconds(0);
  }
  // Seconds are subtracted, because a difference of two ros::Time more than 68 years apart throws.
  const double wait = stamp.toSec() - now.toSec();
  if (wait < -kLongestPast || wait > kLongestWait) {
    throw aibo_client::InvalidArgumentException(
        "header.stamp, when it should begin, is " + std::to_string(std::abs(wait)) +
        (wait < 0 ? " s ago" : " s ahead") + "; it must be from 1 s ago to an hour ahead, or 0, which means at once.");
  }
  return std::chrono::nanoseconds(std::llround(wait * 1e9));
}

movement::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message) {
  movement::TrajectoryRequest request;
  request.joints = message.joint_names;
  for (const trajectory_msgs::JointTrajectoryPoint& point : message.points) {
    request.points.push_back({point.time_from_start.toSec(), point.positions, point.velocities});
  }
  return request;
}

void JointCommander::subscribe(const ros::NodeHandle& handle) {
  collecting_ = makeOneShotTimer(handle, kCollectingTime, [this] { sendCollected(); });
  timer_ = makeTimer(handle, movement::JointPlan::kPeriod, [this] {
    if (!mover_.advance()) {
      timer_.stop();
    }
  });
  for (const movement::JointProperties& joint : table_.joints()) {
    subscribers_.push_back(
        subscribeToOrders<std_msgs::Float64>(handle, joint.name + "_position_controller/command", 1,
                                             [this, name = joint.name](const auto& message, const auto& order) {
                                               receivePosition(name, message.data, order);
                                             }));
  }
  const auto receive = [this](const auto& message, const auto& order) { this->receive(message, order); };
  const auto refuse = [this](Kind kind) {
    return [this, kind](const auto& order, const std::string& reason) { mover_.refuse(order, kind, {}, reason); };
  };
  subscribers_.push_back(subscribeToOrders<sensor_msgs::JointState, kMostBytesOfCommand>(
      handle, "joint_command", kCommandQueueSize, receive, refuse(Kind::kCommand)));
  subscribers_.push_back(subscribeToOrders<trajectory_msgs::JointTrajectory, kMostBytesOfTrajectory>(
      handle, "joint_trajectory", kTrajectoryQueueSize, receive, refuse(Kind::kTrajectory)));
}

void JointCommander::receive(const sensor_msgs::JointState& message, const movement::Order& order) {
  sendCollected();  // the collected positions came before this message
  command(message, order);
}

void JointCommander::command(const sensor_msgs::JointState& message, const movement::Order& order) {
  const movement::Mover::Answer answer =
      mover_.command(order, message.name, message.position, message.velocity,
                     message.header.frame_id == kLookAt ? Kind::kLookAt : Kind::kCommand);
  if (!answer.remark.empty()) {
    warnings_.warn(answer.remark);
  }
}

void JointCommander::receive(const trajectory_msgs::JointTrajectory& message, const movement::Order& order) {
  sendCollected();
  if (message.points.empty()) {
    try {
      mover_.hold(order, order.source + " sent an empty trajectory");
    } catch (const aibo_client::Exception& error) {
      warnings_.warn(std::string("The joints were not held: ") + error.what());
    }
    return;
  }
  std::chrono::nanoseconds wait{0};
  try {
    wait = waitBeforeStart(message.header.stamp, ros::Time::now());
  } catch (const aibo_client::InvalidArgumentException& error) {
    mover_.refuse(order, Kind::kTrajectory, message.joint_names, error.what());
    return;
  }
  mover_.follow(order, toRequest(message), wait);
}

void JointCommander::receivePosition(const std::string& joint, double position, const movement::Order& order) {
  if (order.source != collected_order_.source) {
    sendCollected();
  }
  if (collected_.name.empty()) {
    collected_order_ = order;
    restart(&collecting_);
  }
  collected_.name.push_back(joint);
  collected_.position.push_back(position);
}

void JointCommander::sendCollected() {
  if (!collected_.name.empty()) {
    command(std::exchange(collected_, {}), collected_order_);
  }
}

}  // namespace aibo_driver::node
