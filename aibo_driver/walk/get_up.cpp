#include "walk/get_up.h"

namespace aibo_driver::walk {

using aibo_client::MotorState;
using aibo_client::PostureNow;

// The robot may report its posture before or after the end of the movement.
void GetUp::ended(const movement::EndedMovement& ended, movement::SteadyTime now) {
  using Kind = movement::Movement::Kind;
  const bool is_by_feet = ended.movement.kind == Kind::kWalk || ended.movement.kind == Kind::kPosture;
  if (!is_by_feet || ended.how != aibo_client::EndedHow::kFell) {
    return;  // for example, because the robot lies on its side and refuses a node that keeps steering
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  has_fallen_ = ended.movement.source != own_source_ && posture_ != PostureNow::kCarried;
  fallen_ = now;
}

void GetUp::update(const aibo_client::MotorsAndPosture& state, movement::SteadyTime overruled) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    posture_ = state.posture;
    has_fallen_ = has_fallen_ && posture_ == PostureNow::kFallen && overruled < fallen_;
    if (!has_fallen_ || state.motors != MotorState::kOff) {
      return;
    }
    has_fallen_ = false;
  }
  stand_();
}

}  // namespace aibo_driver::walk
