#include "walk/walk_odometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aibo_driver::walk {

using aibo_client::PostureNow;

namespace {

constexpr double kFrame = 0.008;  // s, an OPEN-R frame

// If measurements were lost on their way, the velocity is the average since the last measurement that arrived. In a gap
// that is longer than this, the robot may even have stopped and begun again.
constexpr double kLongGap = 0.5;  // s

// If the connection breaks, a robot that walks goes on for up to half a second and then brakes.
constexpr double kLostWay = 0.1;   // m
constexpr double kLostTurn = 0.5;  // rad

// Somebody who lifts a robot may put it down somewhere else, in any direction.
constexpr double kLiftedWay = 1.0;   // m
constexpr double kLiftedTurn = 3.2;  // rad

}  // namespace

bool WalkOdometry::update(const aibo_client::Telemetry& telemetry) {
  if (!telemetry.walk || !telemetry.frame_number) {
    return false;
  }
  const Sample sample{realVelocity(telemetry.walk->velocity, settings_), telemetry.connection_number,
                      *telemetry.frame_number};
  if (const std::optional<Sample> last = std::exchange(last_, sample)) {
    advance(*last, sample);
  }
  return true;
}

void WalkOdometry::motionEnded(const aibo_client::ActivityEnd& end) {
  if (end.how == aibo_client::EndedHow::kFell && posture_ == PostureNow::kUnknown) {
    odometry_.lose(kLiftedWay, kLiftedTurn);
  }
}

void WalkOdometry::update(const aibo_client::MotorsAndPosture& state) {
  const auto is_off_its_feet = [](PostureNow posture) {
    return posture == PostureNow::kFallen || posture == PostureNow::kCarried;
  };
  const bool was_off_its_feet = is_off_its_feet(std::exchange(posture_, state.posture));
  if (is_off_its_feet(state.posture) && !was_off_its_feet) {
    odometry_.lose(kLiftedWay, kLiftedTurn);
  }
}

void WalkOdometry::advance(const Sample& last, const Sample& sample) {
  if (last.connection_number != sample.connection_number) {
    if (!last.velocity.isZero()) {
      odometry_.lose(kLostWay, kLostTurn);
    }
    return;
  }
  const double time = kFrame * static_cast<double>(sample.frame_number - last.frame_number);
  const aibo_client::WalkVelocity& velocity = sample.velocity;
  odometry_.walk(velocity, time);  // the velocity is the average since the previous measurement
  if (time > kLongGap) {
    odometry_.lose(std::hypot(velocity.forward, velocity.left) * time / 2,
                   std::min(std::abs(velocity.turn) * time / 2, kLiftedTurn));
  }
}

}  // namespace aibo_driver::walk
