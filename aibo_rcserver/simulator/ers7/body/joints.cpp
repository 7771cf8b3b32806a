#include "simulator/ers7/body/joints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace simulated_ers7 {
namespace {

const std::map<std::string, int> kDegrees = {
    {"neck_tilt", -25},
    {"head_pan", 0},
    {"head_tilt", 10},
    {"mouth", -4},
    {"left_front_rotator", -23},
    {"left_front_elevator", 0},
    {"left_front_knee", 44},
    {"left_hind_rotator", 26},
    {"left_hind_elevator", 0},
    {"left_hind_knee", 57},
    {"right_front_rotator", -23},
    {"right_front_elevator", 0},
    {"right_front_knee", 44},
    {"right_hind_rotator", 26},
    {"right_hind_elevator", 0},
    {"right_hind_knee", 57},
    {"tail_pan", 0},
    {"tail_tilt", 30},
};

}  // namespace

int restingPosition(const std::string& joint) {
  return static_cast<int>(std::lround(kDegrees.at(joint) * std::acos(-1.0) / 180 * 1e6));
}

HeadAngles restingHead() {
  HeadAngles angles;
  angles.neck_tilt = restingPosition("neck_tilt") / 1e6;
  angles.head_pan = restingPosition("head_pan") / 1e6;
  angles.head_tilt = restingPosition("head_tilt") / 1e6;
  return angles;
}

Joints::Joints(const robot_model::RobotModel& model, std::uint64_t seed) : model_(model), random_(seed) {
  for (int i = 0; i < model_.number_of_joints; ++i) {
    const robot_model::Joint& joint = model_.joints[i];
    const int position = kDegrees.count(joint.name) != 0 ? restingPosition(joint.name) : 0;
    joints_.emplace_back(joint, std::clamp(position, joint.lowest, joint.highest));
  }
}

const Joint& Joints::named(const std::string& name) const {
  const int index = robot_model::findJointByName(model_, name.c_str());
  if (index == robot_model::NO_JOINT) {
    throw std::invalid_argument("the " + std::string(model_.design) + " has no joint \"" + name + "\"");
  }
  return joints_[static_cast<std::size_t>(index)];
}

Joint& Joints::named(const std::string& name) {
  return const_cast<Joint&>(std::as_const(*this).named(name));
}

void Joints::setPower(bool on) {
  for (Joint& joint : joints_) {
    joint.setPower(on);
  }
}

void Joints::passFrame() {
  // std::uniform_int_distribution is not used, because its numbers differ between libraries.
  constexpr std::uint64_t kErrors = 2 * Joint::kEncoderStep + 1;
  for (Joint& joint : joints_) {
    joint.passFrame(static_cast<int>(random_() % kErrors) - Joint::kEncoderStep);
  }
}

HeadAngles Joints::head() const {
  HeadAngles angles = restingHead();
  if (robot_model::findJointByName(model_, "neck_tilt") != robot_model::NO_JOINT) {
    angles.neck_tilt = named("neck_tilt").position() / 1e6;
  }
  angles.head_pan = named("head_pan").position() / 1e6;
  angles.head_tilt = named("head_tilt").position() / 1e6;
  return angles;
}

std::array<LegAngles, kLegs> Joints::legs() const {
  // In the tables, a leg's three joints are neighbours.
  constexpr std::size_t kFirstJoints[kLegs] = {4, 7, 10, 13};
  std::array<LegAngles, kLegs> legs;
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    const std::size_t first = kFirstJoints[leg];
    legs[leg].rotator = joints_[first].position() / 1e6;
    legs[leg].elevator = joints_[first + 1].position() / 1e6;
    legs[leg].knee = joints_[first + 2].position() / 1e6;
  }
  return legs;
}

}  // namespace simulated_ers7
