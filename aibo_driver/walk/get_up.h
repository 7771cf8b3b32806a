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
/// It does so once after each fall that has ended a walk or a posture, when its motors have gone off because it has
/// lain for a second. It stays down if somebody has lifted it or put it on its feet since, if somebody has given an
/// order that overrules others (for example, motors off), if the connection was lost, or if it fell while it got up. A
/// robot that was laid on its side while nothing moved it stays there, too.
///
/// All member functions may be called from any thread.
class GetUp {
 public:
  /// @param own_source see movement::Order: that of the order that `stand` gives
  /// @param stand makes the robot stand; called on the thread of the call that causes it, without a lock
  GetUp(std::string own_source, std::function<void()> stand)
      : own_source_(std::move(own_source)), stand_(std::move(stand)) {}

  /// A movement has ended.
  /// @param now the time of the steady clock
  void ended(const movement::EndedMovement& ended, movement::SteadyTime now);

  /// The robot has reported its motors and its posture, or they are not known any more.
  /// @param overruled see Mover::State::overruled
  void update(const aibo_client::MotorsAndPosture& state, movement::SteadyTime overruled);

 private:
  const std::string own_source_;
  const std::function<void()> stand_;
  std::mutex mutex_;
  aibo_client::PostureNow posture_ = aibo_client::PostureNow::kUnknown;
  bool has_fallen_ = false;      ///< and has not been touched since
  movement::SteadyTime fallen_;  ///< when its latest fall ended a movement
};

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_GET_UP_H
