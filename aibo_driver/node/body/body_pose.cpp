#include "node/body/body_pose.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::node {
namespace {

constexpr double kSmoothing = 0.25;  // s; the value is our choice

constexpr std::array<const char*, walk::kLegs> kLegNames{"left_front_", "left_hind_", "right_front_", "right_hind_"};
constexpr std::array<const char*, robot_model::JOINTS_OF_A_LEG> kJointNames{"rotator", "elevator", "knee"};

}  // namespace

std::string legJointName(std::size_t leg, std::size_t joint) {
  return std::string(kLegNames.at(leg)) + kJointNames.at(joint);
}

void BodyPose::accelerate(const geometry_msgs::Vector3& acceleration, const ros::Time& stamp) {
  const Eigen::Vector3d now(acceleration.x, acceleration.y, acceleration.z);
  const double passed = std::max(0.0, stamp.toSec() - last_acceleration_.toSec());
  const double share = acceleration_ ? -std::expm1(-passed / kSmoothing) : 1;
  acceleration_ = acceleration_.value_or(now) + share * (now - acceleration_.value_or(now));
  last_acceleration_ = stamp;
}

geometry_msgs::Transform BodyPose::above(const std::array<walk::LegAngles, walk::kLegs>& legs) const {
  const Eigen::Isometry3d pose = walk::estimateStance(legs, acceleration_.value_or(Eigen::Vector3d::UnitZ())).body;
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

}  // namespace aibo_driver::node
