/// @file stick_slot.h
/// The memory stick in the robot's slot, and what may be wrong with it.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <cstddef>
#include <limits>

namespace simulated_ers7 {

enum class StickState {
  kReady,
  kFull,    ///< no byte can be written
  kLocked,  ///< its switch protects it from being written
  kOut,     ///< there is none in the slot; files that are open stay open
  kSlow     ///< each job takes StickSlot::kSlowJob
};

/// The content of the stick is a folder on this computer. Only what OPEN-R's programs notice of the stick itself is
/// here.
class StickSlot {
 public:
  /// Longer than anything on a real stick is known to take.
  static constexpr std::chrono::milliseconds kSlowJob{2000};

  void set(StickState state) {
    state_ = state;
    room_ = state == StickState::kFull ? 0 : std::numeric_limits<std::size_t>::max();
  }

  /// What OPENR::GetMemoryStickStatus() tells.
  OMemoryStickStatus status() const {
    if (state_ == StickState::kOut) {
      return omemorystickNOT_EXIST;
    }
    return state_ == StickState::kLocked ? omemorystickWRITE_PROTECTED : omemorystickWRITABLE;
  }

  /// Bytes that still fit (HostSettings::room).
  const std::size_t* room() const { return &room_; }

  /// How long the stick keeps FileKeeper busy with each job, unless something else takes longer.
  std::chrono::milliseconds jobTime() const {
    return state_ == StickState::kSlow ? kSlowJob : std::chrono::milliseconds(0);
  }

 private:
  StickState state_ = StickState::kReady;
  std::size_t room_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_STICK_SLOT_H
