#include "node/walk/odometry_publisher.h"

#include <tf2_msgs/TFMessage.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace aibo_driver::node {
namespace {

constexpr std::uint32_t kOdomQueueSize = 10;
constexpr std::uint32_t kTfQueueSize = 100;  // the same size as in robot_state_publisher

// The standard deviation of a velocity, as a part of that velocity, and its value at rest. Both are our choice, as in
// Odometry.
constexpr double kVelocityError = 0.15;
constexpr double kRestError = 0.001;  // m/s, rad/s

// The variance of height, roll and pitch, which odometry on the floor does not measure. Drivers of other robots use
// this value, too.
constexpr double kUnknownVariance = 1e6;

double varianceOf(double velocity, double other) {
  const double error = kRestError + kVelocityError * (std::abs(velocity) + std::abs(other));
  return error * error;
}

/// The place of an element in a 6 x 6 covariance: x, y, z, roll, pitch, yaw.
constexpr std::size_t at(std::size_t row, std::size_t column) {
  return 6 * row + column;
}

constexpr std::array<std::size_t, 3> kMeasured{0, 1, 5};
constexpr std::array<std::size_t, 3> kNotMeasured{2, 3, 4};

}  // namespace

nav_msgs::Odometry toMessage(const walk::Odometry& odometry, const aibo_client::WalkVelocity& velocity) {
  nav_msgs::Odometry odom;
  odom.pose.pose.position.x = odometry.x();
  odom.pose.pose.position.y = odometry.y();
  odom.pose.pose.orientation.z = std::sin(odometry.yaw() / 2);
  odom.pose.pose.orientation.w = std::cos(odometry.yaw() / 2);
  for (std::size_t row = 0; row < kMeasured.size(); ++row) {
    for (std::size_t column = 0; column < kMeasured.size(); ++column) {
      odom.pose.covariance[at(kMeasured[row], kMeasured[column])] =
          odometry.covariance()(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
  }
  odom.twist.twist.linear.x = velocity.forward;
  odom.twist.twist.linear.y = velocity.left;
  odom.twist.twist.angular.z = velocity.turn;
  odom.twist.covariance[at(0, 0)] = varianceOf(velocity.forward, velocity.left);
  odom.twist.covariance[at(1, 1)] = odom.twist.covariance[at(0, 0)];
  odom.twist.covariance[at(5, 5)] = varianceOf(velocity.turn, velocity.forward);
  for (const std::size_t unknown : kNotMeasured) {
    odom.pose.covariance[at(unknown, unknown)] = kUnknownVariance;
    odom.twist.covariance[at(unknown, unknown)] = kUnknownVariance;
  }
  return odom;
}

OdometryPublisher::OdometryPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                     RobotStamper& stamper)
    : parameters_(parameters), stamper_(stamper), walked_(parameters.walk) {
  ros::NodeHandle topics(handle);
  odom_ = topics.advertise<nav_msgs::Odometry>("odom", kOdomQueueSize);
  tf_ = topics.advertise<tf2_msgs::TFMessage>("/tf", kTfQueueSize);
}

void OdometryPublisher::publish(const aibo_client::Telemetry& telemetry) {
  const bool is_known = walked_.update(telemetry);
  if (is_known) {
    const std::lock_guard<std::mutex> lock(mutex_);
    here_ = {walked_.odometry().x(), walked_.odometry().y(), walked_.odometry().yaw()};
    measured_ = std::chrono::steady_clock::now();
  }
  const bool is_told = is_known && odom_.getNumSubscribers() > 0;
  const bool is_in_tf = parameters_.walk.publish_odom_tf && tf_.getNumSubscribers() > 0;
  if (!is_told && !is_in_tf) {
    return;
  }
  nav_msgs::Odometry odom = toMessage(walked_.odometry(), walked_.velocity());
  odom.header.stamp = stamper_.stamp(telemetry);
  odom.header.frame_id = parameters_.frame("odom");
  odom.child_frame_id = parameters_.frame("base_footprint");
  if (is_told) {
    odom_.publish(odom);
  }
  if (is_in_tf) {
    publishTransform(odom);
  }
}

std::optional<walk::PlanePose> OdometryPublisher::here() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_fresh = measured_ && std::chrono::steady_clock::now() - *measured_ <= kFresh;
  return is_fresh ? std::make_optional(here_) : std::nullopt;
}

void OdometryPublisher::publishTransform(const nav_msgs::Odometry& odom) {
  geometry_msgs::TransformStamped transform;
  transform.header = odom.header;
  transform.child_frame_id = odom.child_frame_id;
  transform.transform.translation.x = odom.pose.pose.position.x;
  transform.transform.translation.y = odom.pose.pose.position.y;
  transform.transform.rotation = odom.pose.pose.orientation;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  tf_.publish(message);
}

}  // namespace aibo_driver::node
