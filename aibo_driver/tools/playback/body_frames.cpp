#include "tools/playback/body_frames.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace aibo_driver::tools {

void BodyFrames::receive(const sensor_msgs::JointState& joints) {
  for (std::size_t i = 0; i < std::min(joints.name.size(), joints.position.size()); ++i) {
    joints_[joints.name[i]] = joints.position[i];
  }
}

std::vector<geometry_msgs::TransformStamped> BodyFrames::frames(const ros::Time& stamp) const {
  std::array<walk::LegAngles, walk::kLegs> legs{};
  for (std::size_t leg = 0; leg < walk::kLegs; ++leg) {
    double* const angles[] = {&legs[leg].rotator, &legs[leg].elevator, &legs[leg].knee};
    for (std::size_t joint = 0; joint < std::size(angles); ++joint) {
      const auto measured = joints_.find(node::legJointName(leg, joint));
      if (measured == joints_.end()) {
        return {};
      }
      *angles[joint] = measured->second;
    }
  }
  geometry_msgs::TransformStamped walked = frame("odom", "base_footprint", stamp);
  walked.transform.translation.x = odometry_.position.x;
  walked.transform.translation.y = odometry_.position.y;
  walked.transform.rotation = odometry_.orientation;
  geometry_msgs::TransformStamped body = frame("base_footprint", "base_link", stamp);
  body.transform = pose_.above(legs);
  return {walked, body};
}

geometry_msgs::TransformStamped BodyFrames::frame(const char* parent, const char* child, const ros::Time& stamp) const {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = frame_prefix_ + parent;
  transform.child_frame_id = frame_prefix_ + child;
  return transform;
}

}  // namespace aibo_driver::tools
