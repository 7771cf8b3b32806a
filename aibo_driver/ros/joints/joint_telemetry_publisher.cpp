#include "ros/joints/joint_telemetry_publisher.h"

#include <sensor_msgs/JointState.h>

#include <cstdint>
#include <utility>

namespace aibo_driver::node {
namespace {

// Of each subscriber. At 31 messages a second one that cannot keep up is at most 160 ms behind.
constexpr std::uint32_t kQueueSize = 5;

}  // namespace

JointTelemetryPublisher::JointTelemetryPublisher(const ros::NodeHandle& handle, const joints::JointTable& table,
                                                 joints::MeasuredJoints& measured, TelemetryStamper stamp_of)
    : table_(table),
      measured_(measured),
      stamp_of_(std::move(stamp_of)),
      publisher_(ros::NodeHandle(handle).advertise<sensor_msgs::JointState>("joint_states", kQueueSize)) {}

void JointTelemetryPublisher::publish(const Telemetry& telemetry) {
  const auto message = boost::make_shared<sensor_msgs::JointState>();
  for (const joints::MeasuredJoint& joint : measured_.update(telemetry)) {
    message->name.push_back(table_[joint.index].name);
    message->position.push_back(joint.position);
    message->velocity.push_back(joint.velocity);
  }
  if (message->name.empty()) {
    return;
  }
  message->header.stamp = stamp_of_(telemetry);
  publisher_.publish(sensor_msgs::JointStateConstPtr(message));
}

}  // namespace aibo_driver::node
