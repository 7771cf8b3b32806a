#include "ros/joints/joint_commander.h"

#include <std_msgs/Float64.h>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

// Several programs may each command some of the joints.
constexpr std::uint32_t kQueueSize = 10;

}  // namespace

JointCommander::JointCommander(const joints::JointTable& table, const joints::MeasuredJoints& measured,
                               RcServerClient& client, const DriverParameters& parameters)
    : table_(table),
      link_(client, table.design()),
      filter_(table, measured, parameters.approach_speed),
      trajectories_(table, measured, link_, parameters.slow_down) {}

void JointCommander::subscribe(const ros::NodeHandle& handle) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = true;
  constexpr bool kAutostart = false;
  collecting_ = topics.createSteadyTimer(
      ros::WallDuration(std::chrono::duration<double>(kCollectingTime).count()),
      [this](const ros::SteadyTimerEvent&) { send(); }, kOneShot, kAutostart);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  using Position = std_msgs::Float64;
  for (const joints::JointProperties& joint : table_.joints()) {
    const boost::function<void(const Position::ConstPtr&)> receive =
        [this, name = joint.name](const Position::ConstPtr& message) { receivePosition(name, message->data); };
    subscribers_.push_back(topics.subscribe<Position>(joint.name + "_position_controller/command", 1, receive,
                                                      ros::VoidConstPtr(), hints));
  }
  const boost::function<void(const sensor_msgs::JointState::ConstPtr&)> receive =
      [this](const sensor_msgs::JointState::ConstPtr& message) { this->receive(*message); };
  subscribers_.push_back(
      topics.subscribe<sensor_msgs::JointState>("joint_command", kQueueSize, receive, ros::VoidConstPtr(), hints));
  trajectories_.subscribe(handle);
}

void JointCommander::receive(const sensor_msgs::JointState& message) {
  collect(message.name, message.position, message.velocity);
  send();
}

void JointCommander::prepareForMotors() {
  trajectories_.end("the motors are being switched");
  filter_.startApproach();
}

void JointCommander::prepareForMotion() {
  trajectories_.end("play_motion was called");
  link_.limitSpeeds(table_.speedLimits());
}

void JointCommander::receivePosition(const std::string& name, double position) {
  if (waiting_.empty()) {
    collecting_.stop();  // a timer that has run out starts again only after this
    collecting_.start();
  }
  collect({name}, {position}, {});
}

void JointCommander::collect(const std::vector<std::string>& names, const std::vector<double>& positions,
                             const std::vector<double>& velocities) {
  const std::uint64_t present = link_.connection();
  if (connection_ != present) {
    connection_ = present;
    filter_.startApproach();
    waiting_.clear();
  }
  for (const std::string& refusal :
       filter_.filter(names, positions, velocities, std::chrono::steady_clock::now(), &waiting_)) {
    warnings_.warn(refusal);
  }
}

void JointCommander::send() {
  joints::JointOrders orders;
  orders.swap(waiting_);
  if (orders.empty() || connection_ != link_.connection()) {
    return;
  }
  try {
    trajectories_.yieldTo(orders);
    link_.send(orders, std::chrono::milliseconds(0));
  } catch (const StoppedException&) {
    return;  // the driver is ending
  } catch (const Exception& error) {
    filter_.startApproach();
    warnings_.warn(std::string("A joint command was dropped: ") + error.what());
  }
}

}  // namespace aibo_driver::node
