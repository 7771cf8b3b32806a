#include "node/walk/body_pose_commander.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "aibo_client/exceptions.h"
#include "node/orders.h"

namespace aibo_driver::node {

using aibo_client::InvalidArgumentException;

namespace {

using Kind = movement::Movement::Kind;

// How far the length of an orientation may be from 1, for people who round it by hand. Our choice.
constexpr double kLengthTolerance = 0.1;

constexpr double kSlowest = 0.01;  // rad/s; our choice. A velocity of 0 would not limit the speed

walk::BodyOffset offsetIn(const geometry_msgs::Pose& pose) {
  const Eigen::Quaterniond turn(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (!std::isfinite(pose.position.z) || !turn.coeffs().allFinite()) {
    throw InvalidArgumentException("the pose has a value that is NaN or infinite");
  }
  if (std::abs(turn.norm() - 1) > kLengthTolerance) {
    throw InvalidArgumentException("the orientation of the pose is not a unit quaternion; w: 1.0 is level");
  }
  const Eigen::Matrix3d rotation = turn.normalized().matrix();
  return {pose.position.z, std::atan2(rotation(2, 1), rotation(2, 2)),
          std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0))};
}

bool hasLegs(const movement::Movement& movement) {
  return movement.kind == Kind::kWalk || movement.kind == Kind::kPosture || movement.kind == Kind::kMotion;
}

}  // namespace

void BodyPoseCommander::subscribe(const ros::NodeHandle& handle) {
  constexpr std::uint32_t kNewest = 1;
  subscriber_ = subscribeToOrders<geometry_msgs::Pose>(
      handle, "body_pose", kNewest, [this](const auto& pose, const auto& order) { receive(pose, order); });
}

void BodyPoseCommander::receive(const geometry_msgs::Pose& pose, const movement::Order& order) {
  const std::vector<std::string> joints = table_.namesOf(movement::isOfLeg);  // in the order of robot_model::Leg
  std::vector<double> positions;
  std::string limit;
  try {
    const walk::BodyOffset offset = offsetIn(pose);
    requireStanding();
    const walk::OffsetLegs legs = walk::findLegs(offset, table_);
    for (const walk::LegAngles& angles : legs.angles) {
      positions.insert(positions.end(), {angles.rotator, angles.elevator, angles.knee});
    }
    limit = legs.limit;
  } catch (const InvalidArgumentException& error) {
    mover_.refuse(order, Kind::kCommand, {}, error.what());
    return;
  }
  const movement::Mover::Answer answer = mover_.command(order, joints, positions, speedsTo(joints, positions));
  if (!limit.empty() && answer.ended() == nullptr) {
    warnings_.warn("The body goes only a part of the way to body_pose: " + limit + ".");
  }
}

void BodyPoseCommander::requireStanding() const {
  const movement::Mover::State state = mover_.state();
  const auto user = std::find_if(state.movements.begin(), state.movements.end(), hasLegs);
  if (user != state.movements.end()) {
    throw InvalidArgumentException("body_pose does not interrupt the " + movement::describe(*user));
  }
  if (state.robot.posture != aibo_client::PostureNow::kStanding) {
    throw InvalidArgumentException("body_pose moves only a robot that stands; call stand");
  }
}

// All joints arrive at the same time, so that the feet stay in one plane on the way.
std::vector<double> BodyPoseCommander::speedsTo(const std::vector<std::string>& joints,
                                                const std::vector<double>& positions) const {
  std::vector<double> ways;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto measured = measured_.find(*table_.findByName(joints[i]));
    if (!measured) {
      return std::vector<double>(joints.size(), kSpeed);
    }
    ways.push_back(std::abs(positions[i] - measured->position));
  }
  const double longest = *std::max_element(ways.begin(), ways.end());
  std::vector<double> speeds;
  for (const double way : ways) {
    speeds.push_back(longest > 0 ? std::max(kSpeed * way / longest, kSlowest) : kSlowest);
  }
  return speeds;
}

}  // namespace aibo_driver::node
