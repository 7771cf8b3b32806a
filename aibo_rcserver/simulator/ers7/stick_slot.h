/// @file stick_slot.h
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <cstddef>
#include <limits>

namespace simulated_ers7 {

enum class StickState {
  kReady,
  kFull,    ///< no room for another byte
  kLocked,  ///< the switch on the stick prevents writing
  kOut,     ///< the slot is empty; open files stay open
  kSlow     ///< each job takes StickSlot::kSlowJob
};

/// The state of the memory stick as OPEN-R's programs see it. Its content is a folder on this computer.
class StickSlot {
 public:
  /// How long a job takes on a slow stick: longer than any known job on a real one.
  static constexpr std::chrono::milliseconds kSlowJob{2000};

  void set(StickState state) {
    state_ = state;
    room_ = state == StickState::kFull ? 0 : std::numeric_limits<std::size_t>::max();
  }

  /// The status for OPENR::GetMemoryStickStatus().
  OMemoryStickStatus status() const {
    if (state_ == StickState::kOut) {
      return omemorystickNOT_EXIST;
    }
    return state_ == StickState::kLocked ? omemorystickWRITE_PROTECTED : omemorystickWRITABLE;
  }

  /// How many bytes still fit (HostSettings::room).
  const std::size_t* room() const { return &room_; }

  /// How long a job takes, unless something else takes longer.
  std::chrono::milliseconds jobTime() const {
    return state_ == StickState::kSlow ? kSlowJob : std::chrono::milliseconds(0);
  }

 private:
  StickState state_ = StickState::kReady;
  std::size_t room_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H
