#include "ros/joints/joint_commander.h"

#include <std_msgs/Float64.h>

#include <utility>

#include "aibo_driver/exceptions.h"
#include "movement/joint_plan.h"
#include "ros/joints/trajectory_messages.h"

namespace aibo_driver::node {
namespace {

// Several programs may each command some of the joints.
constexpr std::uint32_t kCommandQueueSize = 10;

// A newer trajectory may replace another one, or move other joints.
constexpr std::uint32_t kTrajectoryQueueSize = 5;

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
    if (!mover_.goOn()) {
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
                                receivePosition(name, event.getMessage()->data, event.getPublisherName());
                              }));
  }
  using sensor_msgs::JointState;
  subscribers_.push_back(subscribeTo<JointState>("joint_command", kCommandQueueSize, &topics,
                                                 [this](const ros::MessageEvent<JointState const>& event) {
                                                   receive(*event.getMessage(), event.getPublisherName());
                                                 }));
  using trajectory_msgs::JointTrajectory;
  subscribers_.push_back(subscribeTo<JointTrajectory>("joint_trajectory", kTrajectoryQueueSize, &topics,
                                                      [this](const ros::MessageEvent<JointTrajectory const>& event) {
                                                        receive(*event.getMessage(), event.getPublisherName());
                                                      }));
}

void JointCommander::receive(const sensor_msgs::JointState& message, const std::string& source) {
  sendCollected();  // they came before
  mover_.command(message.name, message.position, message.velocity, source, mover_.epoch());
}

void JointCommander::receive(const trajectory_msgs::JointTrajectory& message, const std::string& source) {
  try {
    if (message.points.empty()) {
      mover_.hold("a trajectory without points came from " + source);
    } else {
      mover_.start(toRequest(message), waitBeforeStart(message.header.stamp, ros::Time::now()), source);
    }
  } catch (const InvalidArgumentException& error) {
    warnings_.warn(error.what());
  } catch (const StoppedException&) {
    return;  // the driver is ending
  } catch (const Exception& error) {
    warnings_.warn(std::string("Trajectory dropped: ") + error.what());
  }
}

void JointCommander::receivePosition(const std::string& joint, double position, const std::string& source) {
  const std::uint64_t epoch = mover_.epoch();
  if (collected_.name.empty() || epoch != collected_epoch_) {
    collected_ = {};
    collected_epoch_ = epoch;
    collecting_.stop();  // a timer that has run out starts again only after this
    collecting_.start();
  }
  collected_.name.push_back(joint);
  collected_.position.push_back(position);
  collected_source_ = source;
}

void JointCommander::sendCollected() {
  if (!collected_.name.empty()) {
    const sensor_msgs::JointState message = std::exchange(collected_, {});
    mover_.command(message.name, message.position, {}, collected_source_, collected_epoch_);
  }
}

}  // namespace aibo_driver::node
