#include "node/joints/joint_commander.h"

#include <std_msgs/Float64.h>

#include <utility>

#include "aibo_client/exceptions.h"
#include "movement/joint_plan.h"
#include "node/bounded_message.h"
#include "node/joints/trajectory_messages.h"
#include "node/orders.h"

namespace aibo_driver::node {

namespace {

// Several programs may each command some of the joints, so messages must not replace each other. A driver that stalled
// reads all waiting messages at once, and each of them has to get its end.
constexpr std::uint32_t kCommandQueueSize = 200;

// The queue is short, but not 1: a newer trajectory replaces another one, unless it moves other joints.
constexpr std::uint32_t kTrajectoryQueueSize = 5;

constexpr std::size_t kMostBytesOfCommand = 256 << 10;   // far more than a command to all joints of a robot
constexpr std::size_t kMostBytesOfTrajectory = 1 << 20;  // all joints, thirty points a second, for a hundred seconds

template <typename Message>
ros::Subscriber subscribeTo(const std::string& topic, std::uint32_t queue_size, ros::NodeHandle* topics,
                            const boost::function<void(const ros::MessageEvent<Message const>&)>& receive) {
  return topics->subscribe<Message>(topic, queue_size, receive, ros::VoidConstPtr(),
                                    ros::TransportHints().tcpNoDelay());
}

}  // namespace

void JointCommander::subscribe(const ros::NodeHandle& handle) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = true;
  constexpr bool kAutostart = false;
  using Seconds = std::chrono::duration<double>;
  collecting_ = topics.createSteadyTimer(
      ros::WallDuration(Seconds(kCollectingTime).count()), [this](const ros::SteadyTimerEvent&) { sendCollected(); },
      kOneShot, kAutostart);
  const auto move_on = [this](const ros::SteadyTimerEvent&) {
    if (!mover_.advance()) {
      timer_.stop();
    }
  };
  timer_ = topics.createSteadyTimer(ros::WallDuration(Seconds(movement::JointPlan::kPeriod).count()), move_on,
                                    !kOneShot, kAutostart);
  using Position = std_msgs::Float64;
  for (const movement::JointProperties& joint : table_.joints()) {
    subscribers_.push_back(
        subscribeTo<Position>(joint.name + "_position_controller/command", 1, &topics,
                              [this, name = joint.name](const ros::MessageEvent<Position const>& event) {
                                receivePosition(name, event.getMessage()->data, orderOf(event));
                              }));
  }
  using Command = BoundedMessage<sensor_msgs::JointState, kMostBytesOfCommand>;
  subscribers_.push_back(subscribeTo<Command>("joint_command", kCommandQueueSize, &topics,
                                              [this](const ros::MessageEvent<Command const>& event) {
                                                receiveBounded(event, movement::Movement::Kind::kCommand);
                                              }));
  using Trajectory = BoundedMessage<trajectory_msgs::JointTrajectory, kMostBytesOfTrajectory>;
  subscribers_.push_back(subscribeTo<Trajectory>("joint_trajectory", kTrajectoryQueueSize, &topics,
                                                 [this](const ros::MessageEvent<Trajectory const>& event) {
                                                   receiveBounded(event, movement::Movement::Kind::kTrajectory);
                                                 }));
}

template <typename Bounded>
void JointCommander::receiveBounded(const ros::MessageEvent<Bounded const>& event, movement::Movement::Kind kind) {
  const std::string refusal = event.getMessage()->refusal();
  if (refusal.empty()) {
    receive(event.getMessage()->message, orderOf(event));
  } else {
    mover_.refuse(orderOf(event), kind, {}, refusal);
  }
}

void JointCommander::receive(const sensor_msgs::JointState& message, const movement::Order& order) {
  sendCollected();  // the collected positions came before this message
  using Kind = movement::Movement::Kind;
  mover_.command(order, message.name, message.position, message.velocity,
                 message.header.frame_id == kLookAt ? Kind::kLookAt : Kind::kCommand);
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
    mover_.refuse(order, movement::Movement::Kind::kTrajectory, message.joint_names, error.what());
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
    collecting_.stop();  // a timer that has run out does not start again unless it was stopped
    collecting_.start();
  }
  collected_.name.push_back(joint);
  collected_.position.push_back(position);
}

void JointCommander::sendCollected() {
  if (!collected_.name.empty()) {
    const sensor_msgs::JointState message = std::exchange(collected_, {});
    mover_.command(collected_order_, message.name, message.position, {});
  }
}

}  // namespace aibo_driver::node
