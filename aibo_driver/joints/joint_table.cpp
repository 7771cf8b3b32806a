#include "joints/joint_table.h"

#include <algorithm>

#include "aibo_driver/exceptions.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::joints {
namespace {

double radian(int microradian) {
  return microradian / 1e6;
}

template <typename Predicate>
std::optional<std::size_t> findIndex(const std::vector<JointProperties>& joints, Predicate predicate) {
  const auto found = std::find_if(joints.begin(), joints.end(), predicate);
  if (found == joints.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - joints.begin());
}

}  // namespace

JointTable::JointTable(const std::string& design, double speed_limit) : design_(design) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  if (model == nullptr) {
    throw InvalidArgumentException("There is no table of a robot named '" + design + "'.");
  }
  for (int i = 0; i < model->number_of_joints; ++i) {
    const robot_model::Joint& joint = model->joints[i];
    joints_.push_back({joint.name, joint.identifier, radian(joint.lowest), radian(joint.highest),
                       std::min(speed_limit, radian(joint.highest_speed))});
  }
}

std::vector<JointSpeedLimit> JointTable::speedLimits() const {
  std::vector<JointSpeedLimit> limits;
  for (std::size_t i = 0; i < size(); ++i) {
    limits.push_back({joints_[i].id, speedLimit(i)});
  }
  return limits;
}

std::optional<std::size_t> JointTable::findByName(const std::string& name) const {
  return findIndex(joints_, [&name](const JointProperties& joint) { return joint.name == name; });
}

std::optional<std::size_t> JointTable::findById(int id) const {
  return findIndex(joints_, [id](const JointProperties& joint) { return joint.id == id; });
}

}  // namespace aibo_driver::joints
