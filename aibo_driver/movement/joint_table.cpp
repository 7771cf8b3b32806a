#include "movement/joint_table.h"

#include <algorithm>

#include "aibo_client/exceptions.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::movement {

using aibo_client::JointSpeedLimit;

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

/// All robots use the same identifiers for the joints of their legs.
bool isJointOfLeg(int id) {
  for (const auto leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                         robot_model::RIGHT_HIND_LEG}) {
    for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
      if (robot_model::legJointIdentifier(leg, number) == id) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

JointTable::JointTable(const std::string& design, double speed_limit, double motion_speed_limit)
    : design_(design), motion_speed_limit_(motion_speed_limit) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  if (model == nullptr) {
    throw aibo_client::InvalidArgumentException("There is no table of a robot named '" + design + "'.");
  }
  for (int i = 0; i < model->number_of_joints; ++i) {
    const robot_model::Joint& joint = model->joints[i];
    joints_.push_back({joint.name, joint.identifier, radian(joint.lowest), radian(joint.highest),
                       std::min(speed_limit, radian(joint.highest_speed)), radian(joint.highest_speed),
                       isJointOfLeg(joint.identifier)});
  }
}

std::vector<JointSpeedLimit> JointTable::motionSpeedLimits() const {
  return collect([](const auto&) { return true; },
                 [this](const JointProperties& joint) {
                   return JointSpeedLimit{joint.id, std::min(motion_speed_limit_, joint.own_speed) * speed_scale_};
                 });
}

std::vector<JointSpeedLimit> JointTable::ownSpeedsOfLegs() const {
  return collect(isOfLeg, [](const JointProperties& joint) { return JointSpeedLimit{joint.id, joint.own_speed}; });
}

std::optional<std::size_t> JointTable::findByName(const std::string& name) const {
  return findIndex(joints_, [&name](const JointProperties& joint) { return joint.name == name; });
}

std::optional<std::size_t> JointTable::findById(int id) const {
  return findIndex(joints_, [id](const JointProperties& joint) { return joint.id == id; });
}

void requireDesign(const aibo_client::RcServerClient& client, const std::string& design) {
  const std::string said = client.robotDesign();
  if (!said.empty() && said != design) {
    throw aibo_client::CommandException("the robot says that it is an " + said +
                                        ", but the driver's parameter robot is " + design +
                                        ": start the driver with the right one.");
  }
}

void sendTargets(aibo_client::RcServerClient& client, const std::string& design, const JointTargets& targets,
                 std::chrono::milliseconds duration, const aibo_client::OrderTerms& terms) {
  if (targets.empty()) {
    return;
  }
  requireDesign(client, design);
  std::vector<aibo_client::JointTarget> list;
  for (const auto& [id, target] : targets) {
    list.push_back(target);
  }
  client.commandJoints(list, duration, terms);
}

}  // namespace aibo_driver::movement
