/// @file urdf_model.h
/// A URDF file and the poses of its links when its joints are moved.
#ifndef TEST_UNIT_URDF_URDF_MODEL_H
#define TEST_UNIT_URDF_URDF_MODEL_H

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <Eigen/Geometry>
#include <map>
#include <string>

/// Positions by joint, in radian. Joints that are not named are at zero.
using Posture = std::map<std::string, double>;

class UrdfModel {
 public:
  /// Throws std::runtime_error if the file is not a URDF.
  explicit UrdfModel(const std::string& file);

  const urdf::ModelInterface& model() const { return *model_; }

  /// Pose of a link in the root link, in metres. Throws std::out_of_range if there is no such link.
  Eigen::Isometry3d linkPose(const std::string& link, const Posture& posture) const;

 private:
  urdf::ModelInterfaceSharedPtr model_;
};

#endif  // TEST_UNIT_URDF_URDF_MODEL_H
