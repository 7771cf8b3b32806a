#include "ros/joints/joint_commander.h"

#include <std_msgs/Float64.h>

#include <chrono>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

// Several programs may each command some of the joints.
constexpr std::uint32_t kQueueSize = 10;

}  // namespace

JointCommander::JointCommander(const ros::NodeHandle& handle, const joints::JointTable& table,
                               const joints::MeasuredJoints& measured, joints::JointLink& link, double approach_speed,
                               std::function<void(const std::vector<joints::JointOrder>&)> commanded)
    : link_(link), commanded_(std::move(commanded)), filter_(table, measured, approach_speed) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = true;
  constexpr bool kAutostart = false;
  collecting_ = topics.createSteadyTimer(
      ros::WallDuration(std::chrono::duration<double>(kCollectingTime).count()),
      [this](const ros::SteadyTimerEvent&) { send(); }, kOneShot, kAutostart);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  using Position = std_msgs::Float64;
  for (const joints::JointProperties& joint : table.joints()) {
    const boost::function<void(const Position::ConstPtr&)> receive =
        [this, name = joint.name](const Position::ConstPtr& message) { receivePosition(name, message->data); };
    subscribers_.push_back(topics.subscribe<Position>(joint.name + "_position_controller/command", 1, receive,
                                                      ros::VoidConstPtr(), hints));
  }
  const boost::function<void(const sensor_msgs::JointState::ConstPtr&)> receive =
      [this](const sensor_msgs::JointState::ConstPtr& message) { receiveJointState(*message); };
  subscribers_.push_back(
      topics.subscribe<sensor_msgs::JointState>("joint_command", kQueueSize, receive, ros::VoidConstPtr(), hints));
}

void JointCommander::receiveJointState(const sensor_msgs::JointState& message) {
  collect({message.name, message.position, message.velocity});
  send();
}

void JointCommander::receivePosition(const std::string& name, double position) {
  if (waiting_.empty()) {
    collecting_.stop();  // a timer that has run out starts again only after this
    collecting_.start();
  }
  collect({{name}, {position}, {}});
}

void JointCommander::collect(const joints::JointCommand& command) {
  if (connection_ != link_.connection()) {
    connection_ = link_.connection();
    filter_.startApproach();
    waiting_.clear();
  }
  const joints::FilteredCommand filtered = filter_.filter(command, std::chrono::steady_clock::now());
  for (const std::string& refusal : filtered.refusals) {
    warnings_.warn(refusal);
  }
  for (const joints::JointOrder& order : filtered.orders) {
    waiting_[order.id] = order;
  }
}

void JointCommander::send() {
  std::vector<joints::JointOrder> orders;
  if (connection_ == link_.connection()) {
    for (const auto& entry : waiting_) {
      orders.push_back(entry.second);
    }
  }
  waiting_.clear();
  if (orders.empty()) {
    return;
  }
  try {
    commanded_(orders);
    link_.send(orders, std::chrono::milliseconds(0));
  } catch (const StoppedException&) {
    return;  // the driver ends
  } catch (const Exception& error) {
    filter_.startApproach();
    warnings_.warn(std::string("A joint command was dropped: ") + error.what());
  }
}

}  // namespace aibo_driver::node
