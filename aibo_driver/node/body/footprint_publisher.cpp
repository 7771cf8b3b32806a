#include "node/body/footprint_publisher.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "node/body/stance.h"

namespace aibo_driver::node {
namespace {

// robot_state_publisher has the same queue size.
constexpr std::uint32_t kFootprintQueueSize = 100;

// Smoothing is needed because the accelerometer also measures every step and stop of the robot. The value is our
// choice.
constexpr double kSmoothing = 0.25;  // s

constexpr const char* kLegNames[kLegs] = {"left_front_", "left_hind_", "right_front_", "right_hind_"};

geometry_msgs::Transform toTransform(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation(pose.linear());
  geometry_msgs::Transform transform;
  transform.translation.x = pose.translation().x();
  transform.translation.y = pose.translation().y();
  transform.translation.z = pose.translation().z();
  transform.rotation.x = rotation.x();
  transform.rotation.y = rotation.y();
  transform.rotation.z = rotation.z();
  transform.rotation.w = rotation.w();
  return transform;
}

}  // namespace

FootprintPublisher::FootprintPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                       const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                                       const movement::MeasuredJoints& measured_joints, RobotStamper& stamper)
    : parameters_(parameters),
      measured_joints_(measured_joints),
      stamper_(stamper),
      accelerometer_(sensorOf(model, "acceleration_front_back"), sensorOf(model, "acceleration_right_left"),
                     sensorOf(model, "acceleration_up_down")) {
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    const std::string name = kLegNames[leg];
    leg_joints_[leg] = {*joint_table.findByName(name + "rotator"), *joint_table.findByName(name + "elevator"),
                        *joint_table.findByName(name + "knee")};
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
  if (telemetry.joints.empty() || !angles || !acceleration_) {
    return;
  }
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parameters_.frame("base_footprint");
  transform.child_frame_id = parameters_.frame("base_link");
  const Eigen::Vector3d acceleration(acceleration_->x, acceleration_->y, acceleration_->z);
  transform.transform = toTransform(estimateStance(*angles, acceleration).body);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  publisher_.publish(message);
}

void FootprintPublisher::updateAcceleration(const aibo_client::Telemetry& telemetry, const ros::Time& stamp) {
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    acceleration_.reset();
  }
  const auto reading = accelerometer_.read(telemetry);
  if (!reading) {
    return;
  }
  const auto& now = reading->linear_acceleration;
  if (acceleration_) {
    const double passed = std::max(0.0, (stamp - last_acceleration_).toSec());
    const double share = -std::expm1(-passed / kSmoothing);
    acceleration_->x += share * (now.x - acceleration_->x);
    acceleration_->y += share * (now.y - acceleration_->y);
    acceleration_->z += share * (now.z - acceleration_->z);
  } else {
    acceleration_ = now;
  }
  last_acceleration_ = stamp;
}

std::optional<std::array<LegAngles, kLegs>> FootprintPublisher::legs() const {
  std::array<LegAngles, kLegs> legs;
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
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
