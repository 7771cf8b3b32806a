/// @file get_up.h
#ifndef AIBO_DRIVER_WALK_GET_UP_H
#define AIBO_DRIVER_WALK_GET_UP_H

#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "aibo_client/walk.h"
#include "movement/movement.h"

namespace aibo_driver::walk {

/// The parameter get_up: decides when a robot that has fallen gets up by itself.
///
/// The robot gets up once after each fall that has ended a walk or a posture, when its motors have gone off because it
/// has lain for a second. It stays down if somebody has lifted it or put it on its feet since, if somebody has given an
/// order that overrules others (for example, motors off), if the connection was lost, or if it fell while it got up. It
/// also stays down if somebody laid it on its side while nothing moved it.
///
/// All member functions may be called from any thread.
class GetUp {
 public:
  /// @param own_source the source of the order that `stand` gives (movement::Order)
  /// @param stand makes the robot stand; called on the thread of the call that causes it, without a lock
  GetUp(std::string own_source, std::function<void()> stand)
      : own_source_(std::move(own_source)), stand_(std::move(stand)) {}

  /// Call this when a movement has ended.
  /// @param now the time of the steady clock
  void ended(const movement::EndedMovement& ended, movement::SteadyTime now);

  /// Call this when the robot has reported its motors and posture, or when they are not known any more.
  /// @param overruled see Mover::State::overruled
  void update(const aibo_client::MotorsAndPosture& state, movement::SteadyTime overruled);

 private:
  const std::string own_source_;
  const std::function<void()> stand_;
  std::mutex mutex_;
  aibo_client::PostureNow posture_ = aibo_client::PostureNow::kUnknown;
  bool has_fallen_ = false;      ///< the robot has fallen, and nobody has touched it since
  movement::SteadyTime fallen_;  ///< when the robot's latest fall ended a movement
};

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_GET_UP_H
