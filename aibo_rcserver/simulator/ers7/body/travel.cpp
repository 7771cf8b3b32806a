#include "simulator/ers7/body/travel.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using openr_host::kFrameSeconds;
using robot_model::FOOT_RADIUS;

/// The body's radius of gyration about the vertical axis, in metres, for a box of the size of body and legs, 28 by 18
/// cm.
constexpr double kGyration = 0.096;

/// In m/s. Below this speed of a foot, friction grows with the speed.
constexpr double kCreep = 0.0005;

constexpr double kHoldSeconds = 0.5;
constexpr double kLiftHeight = 0.25;
constexpr double kAccelerometerSeconds = 0.02;

/// Steepest slope of the body, as a tangent, with a foot beyond an edge (our choice).
constexpr double kSteepestAtEdge = 0.26;

/// Balls around the body that detect obstacles (our choice, estimated from the body's shape). The head's ball keeps
/// things away from the camera.
const Vector3d kChest(0.06, 0, 0);
const Vector3d kRump(-0.06, 0, 0);
const Vector3d kFace(0.03, 0, 0);  // in the head
constexpr double kBumperRadii[] = {0.09, 0.09, 0.075};

/// The corners of back and head on which the robot may lie. They are raised like those of the belly (our choice,
/// estimated from the body's shape).
const Vector3d kBack[] = {
    {0.085, 0.045, 0.045}, {0.085, -0.045, 0.045}, {-0.085, 0.045, 0.045}, {-0.085, -0.045, 0.045}};
const Vector3d kHead[] = {{0.04, 0, 0.03}, {-0.03, 0, 0.03}, {0.09, 0, -0.02}, {0.04, 0.04, 0}, {0.04, -0.04, 0}};

bool isSameLeg(const LegAngles& a, const LegAngles& b) {
  return a.rotator == b.rotator && a.elevator == b.elevator && a.knee == b.knee;
}

bool isSameHead(const HeadAngles& a, const HeadAngles& b) {
  return a.neck_tilt == b.neck_tilt && a.head_pan == b.head_pan && a.head_tilt == b.head_tilt;
}

Quaterniond attitudeOn(Side side) {
  const double quarter = std::acos(-1.0) / 2;
  switch (side) {
    case Side::kLeft:
      return Quaterniond(AngleAxisd(-quarter, Vector3d::UnitX()));
    case Side::kRight:
      return Quaterniond(AngleAxisd(quarter, Vector3d::UnitX()));
    case Side::kBack:
      return Quaterniond(AngleAxisd(2 * quarter, Vector3d::UnitX()));
    case Side::kFeet:
      break;
  }
  return Quaterniond::Identity();
}

/// Moves a value towards another one, by at most `most`.
double approach(double value, double end, double most) {
  return value + std::clamp(end - value, -most, most);
}

Supports turned(const Isometry3d& pose, const Supports& supports) {
  Supports result;
  std::transform(supports.begin(), supports.end(), result.begin(), [&](const Vector3d& point) { return pose * point; });
  return result;
}

/// The share of its full load that a support carries at this height.
double loadAt(double height) {
  return std::clamp(1 - height / kPawTravel, 0.0, 1.0);
}

struct Contact {
  Vector2d place;     ///< from the body's origin, horizontal
  Vector2d velocity;  ///< relative to the body, horizontal
  double load;        ///< share of the weight

  /// Turns the body's velocity (x, y, turn) into this point's velocity on the floor.
  Eigen::Matrix<double, 2, 3> lever() const {
    Eigen::Matrix<double, 2, 3> lever;
    lever << 1, 0, -place.y(), 0, 1, place.x();
    return lever;
  }
};

/// The body's velocity (x, y, turn) after a frame on these contacts. It minimises the kinetic energy relative to
/// `before` plus the energy lost in friction. Above kCreep, friction depends on the load but not on the speed. The
/// solution repeats weighted least squares: a contact that slips faster gets less weight.
Vector3d dragged(const std::vector<Contact>& contacts, const Vector3d& before) {
  constexpr int kMostRounds = 30;
  constexpr double kExact = 1e-9;
  const Eigen::Matrix3d inertia = Vector3d(1, 1, kGyration * kGyration).asDiagonal();
  const double grip = kFriction * kGravity * kFrameSeconds;
  Vector3d velocity = before;
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::Matrix3d matrix = inertia;
    Vector3d sum = inertia * before;
    for (const Contact& contact : contacts) {
      const auto lever = contact.lever();
      const double slip = (lever * velocity + contact.velocity).norm();
      const double weight = grip * contact.load / std::max(slip, kCreep);
      matrix += weight * lever.transpose() * lever;
      sum -= weight * lever.transpose() * contact.velocity;
    }
    const Vector3d better = matrix.inverse() * sum;
    const bool is_exact = (better - velocity).norm() < kExact;
    velocity = better;
    if (is_exact) {
      break;
    }
  }
  return velocity;
}

/// How far an obstacle reaches into a bumper, as a negative number.
double intrusion(const Scene& scene, const Vector3d& middle, double radius) {
  return std::min(0.0, scene.clearance(middle) - radius);
}

/// The horizontal direction away from the closest obstacle.
Vector2d wayOut(const Scene& scene, const Vector3d& point) {
  constexpr double kStep = 0.001;
  const auto slope = [&](const Vector3d& along) {
    return scene.clearance(point + kStep * along) - scene.clearance(point - kStep * along);
  };
  return Vector2d(slope(Vector3d::UnitX()), slope(Vector3d::UnitY())).normalized();
}

}  // namespace

Travel::Travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, double ground)
    : legs_(legs),
      supports_(supportsOf(legs)),
      ground_(ground),
      head_(head),
      floor_(restOn(supports_).floor),
      stance_(stanceOver(floor_, supports_)) {
  stance_.body.translation().z() += ground_;
}

// The robot stays where it stands if only things in the scene move, because they do not push it.
void Travel::passFrame(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene) {
  const bool joints_rest = std::equal(legs.begin(), legs.end(), legs_.begin(), isSameLeg) && isSameHead(head, head_);
  if (is_settled_ && joints_rest) {
    return;
  }
  const Travel before = *this;
  travel(legs, head, scene);
  is_settled_ = joints_rest && held_ == before.held_ && raised_ == before.raised_ && step_.isZero(0) &&
                floor_.slope == before.floor_.slope && floor_.height == before.floor_.height &&
                stance_.body.matrix() == before.stance_.body.matrix() && acceleration_ == before.acceleration_;
}

void Travel::travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene) {
  const Vector3d place_before = stance_.body.translation();
  const Bumpers bumpers_before = bumpers();
  const Supports before = turned(stanceOver(floor_, supports_).body, supports_);
  const Supports rolled = rolledBetween(legs_, legs);
  legs_ = legs;
  supports_ = supportsOf(legs);
  loseGround(scene);
  head_ = head;
  floor_ = tip(supports_, restOn(supports_), floor_.slope, kFrameSeconds);
  const Stance freely = stanceOver(floor_, supports_);
  passFrameOfHolding();
  step_ = isOnFeet() ? push(before, turned(freely.body, supports_), rolled) : Step::Zero();
  move(step_);
  stance_.body = poseInPlace();
  std::transform(freely.paw_down.begin(), freely.paw_down.end(), stance_.paw_down.begin(),
                 [this](bool is_down) { return is_down && isOnFeet(); });
  stopAtObstacles(bumpers_before, scene);
  fallOff(scene);
  feelAcceleration(place_before);
}

/// Supports that are beyond an edge no longer reach the floor.
void Travel::loseGround(const Scene& scene) {
  constexpr double kOutOfReach = 1;
  is_beyond_edge_ = false;
  for (Vector3d& support : supports_) {
    if (isOverEdge((stance_.body * support).head<2>(), scene)) {
      is_beyond_edge_ = true;
      support.z() += kOutOfReach;
    }
  }
}

void Travel::fallOff(const Scene& scene) {
  if (isOnFeet() && is_beyond_edge_ &&
      (floor_.slope.norm() > kSteepestAtEdge || isOverEdge({place_.x, place_.y}, scene))) {
    has_fallen_off_ = true;
    ground_ = 0;
    lie(Side::kLeft);
  }
}

/// Holds the robot. Between two sides, the robot first returns to its feet.
void Travel::passFrameOfHolding() {
  const bool wants_hold = is_lifted_ || wanted_side_ != Side::kFeet;
  if (held_ == 0) {
    side_ = wanted_side_;
    hold_ = attitudeOn(side_);
  }
  held_ = approach(held_, wants_hold && side_ == wanted_side_ ? 1 : 0, kFrameSeconds / kHoldSeconds);
  raised_ = approach(raised_, is_lifted_ ? kLiftHeight : 0, kLiftHeight * kFrameSeconds / kHoldSeconds);
}

Isometry3d Travel::poseInPlace() const {
  const Isometry3d freely = stanceOver(floor_, supports_).body;
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() =
      (AngleAxisd(place_.yaw, Vector3d::UnitZ()) * Quaterniond(freely.linear()).slerp(held_, hold_)).toRotationMatrix();
  pose.translation() = Vector3d(place_.x, place_.y, freely.translation().z() + ground_);
  if (!isOnFeet()) {
    const Vector3d up = pose.linear().row(2);
    double lowest = 0;
    const auto add = [&](const Vector3d& point) { lowest = std::min(lowest, up.dot(point)); };
    std::for_each(supports_.begin(), supports_.end(), add);
    std::for_each(std::begin(kBack), std::end(kBack), add);
    const Isometry3d head_in_body = headInBody(head_);
    std::for_each(std::begin(kHead), std::end(kHead), [&](const Vector3d& point) { add(head_in_body * point); });
    pose.translation().z() = FOOT_RADIUS - lowest + raised_ + ground_;
  }
  return pose;
}

/// The step that friction and the last step cause.
/// @param before,now the supports in a frame above the body's place, with its heading
/// @param rolled how far the supports have rolled since `before`
Travel::Step Travel::push(const Supports& before, const Supports& now, const Supports& rolled) const {
  std::vector<Contact> contacts;
  double loads = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double load = loadAt(std::max(before[i].z(), now[i].z()) - FOOT_RADIUS);
    if (load > 0) {
      contacts.push_back(
          {(before[i] + now[i]).head<2>() / 2, (now[i] + rolled[i] - before[i]).head<2>() / kFrameSeconds, load});
      loads += load;
    }
  }
  for (Contact& contact : contacts) {
    contact.load /= loads;
  }
  return kFrameSeconds * dragged(contacts, step_ / kFrameSeconds);
}

void Travel::move(const Step& step) {
  const Vector2d shift = Eigen::Rotation2Dd(place_.yaw + step.z() / 2) * step.head<2>();
  place_.x += shift.x();
  place_.y += shift.y();
  place_.yaw += step.z();
}

Travel::Bumpers Travel::bumpers() const {
  return {stance_.body * kChest, stance_.body * kRump, stance_.body * (headInBody(head_) * kFace)};
}

/// Takes back movement that led further into an obstacle. The body may already have been inside, for instance because
/// the ball rolled there.
void Travel::stopAtObstacles(const Bumpers& before, const Scene& scene) {
  constexpr int kRounds = 4;  // in a corner, several bumpers touch several things
  Vector2d taken_back = Vector2d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vector3d middle = bumpers()[i];
      const double radius = kBumperRadii[i];
      const double further = intrusion(scene, middle, radius) - intrusion(scene, before[i], radius);
      if (further < 0) {
        const Vector2d back = -further * wayOut(scene, middle);
        stance_.body.translation().head<2>() += back;
        taken_back += back;
      }
    }
  }
  is_stopped_ = !taken_back.isZero(0);
  place_.x += taken_back.x();
  place_.y += taken_back.y();
  step_.head<2>() += Eigen::Rotation2Dd(-place_.yaw) * taken_back;
}

void Travel::feelAcceleration(const Vector3d& before) {
  const Vector3d velocity = (stance_.body.translation() - before) / kFrameSeconds;
  const Vector3d acceleration = (velocity - velocity_) / kFrameSeconds;
  velocity_ = velocity;
  acceleration_ += (acceleration - acceleration_) * (1 - std::exp(-kFrameSeconds / kAccelerometerSeconds));
}

}  // namespace simulated_ers7
