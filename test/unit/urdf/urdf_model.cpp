#include "urdf_model.h"

#include <urdf_parser/urdf_parser.h>

#include <stdexcept>

namespace {

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  const urdf::Rotation& rotation = pose.rotation;
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(rotation.w, rotation.x, rotation.y, rotation.z);
}

Eigen::AngleAxisd turn(const urdf::Joint& joint, const Posture& posture) {
  const auto position = posture.find(joint.name);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  return Eigen::AngleAxisd(position == posture.end() ? 0 : position->second, axis.normalized());
}

}  // namespace

UrdfModel::UrdfModel(const std::string& file) : model_(urdf::parseURDFFile(file)) {
  if (!model_) {
    throw std::runtime_error(file + " is not a URDF");
  }
}

Eigen::Isometry3d UrdfModel::linkPose(const std::string& link, const Posture& posture) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (urdf::JointConstSharedPtr joint = model_->links_.at(link)->parent_joint; joint;
       joint = model_->links_.at(joint->parent_link_name)->parent_joint) {
    if (joint->type == urdf::Joint::REVOLUTE) {
      pose = turn(*joint, posture) * pose;
    }
    pose = toIsometry(joint->parent_to_joint_origin_transform) * pose;
  }
  return pose;
}
