#include "node/body/footprint_publisher.h"

#include <tf2_msgs/TFMessage.h>

#include <string>

namespace aibo_driver::node {
namespace {

// robot_state_publisher has the same queue size.
constexpr std::uint32_t kFootprintQueueSize = 100;

}  // namespace

FootprintPublisher::FootprintPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                       const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                                       const movement::MeasuredJoints& measured_joints, RobotStamper& stamper)
    : parameters_(parameters), measured_joints_(measured_joints), stamper_(stamper), accelerometer_(model) {
  for (std::size_t leg = 0; leg < walk::kLegs; ++leg) {
    for (std::size_t joint = 0; joint < leg_joints_[leg].size(); ++joint) {
      leg_joints_[leg][joint] = *joint_table.findByName(legJointName(leg, joint));
    }
  }
  publisher_ = ros::NodeHandle(handle).advertise<tf2_msgs::TFMessage>("/tf", kFootprintQueueSize);
}

void FootprintPublisher::publish(const aibo_client::Telemetry& telemetry) {
  const ros::Time stamp = stamper_.stamp(telemetry);
  updateAcceleration(telemetry, stamp);
  if (publisher_.getNumSubscribers() == 0) {
    return;
  }
  const auto angles = legs();
  if (telemetry.joints.empty() || !angles || !pose_.isKnown()) {
    return;
  }
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parameters_.frame("base_footprint");
  transform.child_frame_id = parameters_.frame("base_link");
  transform.transform = pose_.above(*angles);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  publisher_.publish(message);
}

void FootprintPublisher::updateAcceleration(const aibo_client::Telemetry& telemetry, const ros::Time& stamp) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    pose_ = BodyPose();
  }
  if (const auto reading = accelerometer_.read(telemetry)) {
    pose_.accelerate(reading->linear_acceleration, stamp);
  }
}

std::optional<std::array<walk::LegAngles, walk::kLegs>> FootprintPublisher::legs() const {
  std::array<walk::LegAngles, walk::kLegs> legs;
  for (std::size_t leg = 0; leg < walk::kLegs; ++leg) {
    const auto rotator = measured_joints_.find(leg_joints_[leg][0]);
    const auto elevator = measured_joints_.find(leg_joints_[leg][1]);
    const auto knee = measured_joints_.find(leg_joints_[leg][2]);
    if (!rotator || !elevator || !knee) {
      return std::nullopt;
    }
    legs[leg] = {rotator->position, elevator->position, knee->position};
  }
  return legs;
}

}  // namespace aibo_driver::node
