#include "walk/body_offset.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aibo_driver::walk {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

// The posture stand, from GaitParameters::in_place in aibo_rcserver/rcserver/walk/Gait.cc. A test compares them.
constexpr double kHeight = 0.1171;      // m, of the shoulders above the floor
constexpr double kNoseDown = -0.0197;   // rad
constexpr double kFrontAhead = 0.0210;  // m, of the foot, from the shoulder; likewise below
constexpr double kHindAhead = 0.0033;
constexpr double kFrontOutward = 0.0208;
constexpr double kHindOutward = 0.0245;

// How much higher one foot may be than another, seen from the body. Up to 30 mm the robot says that it stands
// (STAND_SLANT in rcserver/walk/Postures.cc). The rest is for joints that yield under the weight.
constexpr double kSlant = 0.025;  // m

constexpr double kRounding = 1e-6;  // m

constexpr int kHalvings = 20;  // to a millionth of the offset

// The centre of a foot on the floor below a body that stands.
Vector3d footOnFloor(Leg leg) {
  const robot_model::Point shoulder = robot_model::findShoulder(leg);
  const double outward = robot_model::isFront(leg) ? kFrontOutward : kHindOutward;
  return {shoulder.x + (robot_model::isFront(leg) ? kFrontAhead : kHindAhead),
          shoulder.y + (robot_model::isLeft(leg) ? outward : -outward), robot_model::FOOT_RADIUS};
}

std::string limitOf(const movement::JointProperties& joint, double angle) {
  return angle < joint.lowest || angle > joint.highest ? joint.name + " is at its limit" : "";
}

OffsetLegs legsAt(const BodyOffset& offset, const movement::JointTable& table) {
  const Isometry3d floor_in_body =
      (Translation3d(0, 0, kHeight + offset.height) * AngleAxisd(kNoseDown + offset.pitch, Vector3d::UnitY()) *
       AngleAxisd(offset.roll, Vector3d::UnitX()))
          .inverse();
  OffsetLegs legs;
  std::array<double, kLegs> heights;
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Vector3d foot = floor_in_body * footOnFloor(leg);
    const LegAngles& angles = legs.angles[i] = robot_model::findLegAngles(leg, {foot.x(), foot.y(), foot.z()});
    heights[i] = foot.z();
    for (const auto& [number, angle] : {std::pair(0, angles.rotator), {1, angles.elevator}, {2, angles.knee}}) {
      const std::string limit = limitOf(table[*table.findById(robot_model::legJointIdentifier(leg, number))], angle);
      legs.limit = legs.limit.empty() ? limit : legs.limit;
    }
    // The comparison is also false if the offset is so large that the result is not a number.
    if (!((footOf(leg, angles) - foot).norm() <= kRounding)) {
      legs.limit = "the legs are too short";
    }
  }
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  if (legs.limit.empty() && *highest - *lowest > kSlant) {
    legs.limit = "the robot would not stand any more";
  }
  return legs;
}

}  // namespace

OffsetLegs findLegs(const BodyOffset& offset, const movement::JointTable& table) {
  const auto legs_at = [&](double part) {
    return legsAt({part * offset.height, part * offset.roll, part * offset.pitch}, table);
  };
  OffsetLegs legs = legs_at(1);
  std::string limit = legs.limit;
  double possible = 0;
  double impossible = 1;
  for (int i = 0; i < kHalvings && !limit.empty(); ++i) {
    const double part = (possible + impossible) / 2;
    legs = legs_at(part);
    limit = legs.limit.empty() ? limit : legs.limit;
    (legs.limit.empty() ? possible : impossible) = part;
  }
  if (!limit.empty()) {
    legs = legs_at(possible);
    legs.limit = limit;
  }
  return legs;
}

}  // namespace aibo_driver::walk
