/// @file sound_intake.h
#ifndef AIBO_DRIVER_CLIENT_SOUND_INTAKE_H
#define AIBO_DRIVER_CLIENT_SOUND_INTAKE_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "aibo_client/sound.h"
#include "client/notifier.h"
#include "system/rate_limit.h"

namespace aibo_client {

/// Samples of a sound that were sent to the robot. If there are none, the sound was stopped.
struct SoundPart {
  std::uint64_t sound = 0;  ///< SoundProgress::sound
  std::uint32_t position = 0;
  std::uint32_t size = 0;
  bool is_last = false;
};

/// Handles the sound of one connection, in both directions. It does not trust the robot: it delivers no more than was
/// asked for, and reports the end of each sound once. It belongs to the client's thread.
class SoundIntake {
 public:
  /// @param context must outlive the object
  explicit SoundIntake(const ConnectionContext& context) : context_(context) {}

  /// Call this with each request to the robot. Sound is dropped until the robot has answered.
  void askedFor(const MicrophoneSettings& settings);
  const MicrophoneSettings& asked() const { return asked_; }

  /// Call this with the answer to the newest request.
  void inForce(const MicrophoneSettings& settings) { in_force_ = settings; }

  /// Delivers what the robot has heard.
  /// @param arrival when the first byte was read
  /// @throw ProtocolException no server of this version sends this
  void heard(const unsigned char* payload, std::size_t size, std::chrono::steady_clock::time_point arrival);

  /// Call this when the robot has accepted samples or stopped the sound.
  void accepted(const SoundPart& part);

  /// Reports the end of a sound that the robot has announced.
  /// @throw ProtocolException no server of this version sends this
  void ended(const unsigned char* payload, std::size_t size);

  /// Call this when the connection ends.
  void connectionLost() { end(EndedHow::kLost); }

 private:
  /// The most frames that may come at once, 1 s. A push with more is dropped.
  static constexpr int kMostFrames = 125;

  void end(EndedHow how);
  unsigned frameSize() const;
  std::uint32_t missingBefore(std::uint32_t frame_number, unsigned count,
                              std::chrono::steady_clock::time_point arrival);

  const ConnectionContext& context_;
  MicrophoneSettings asked_;
  std::optional<MicrophoneSettings> in_force_;
  std::optional<std::uint32_t> next_frame_;      ///< the frame in which the next piece begins if none is missing
  unsigned beyond_frame_ = 0;                    ///< samples of that frame that have been heard already
  std::chrono::steady_clock::time_point began_;  ///< when the first sound came since next_frame_ was empty
  std::uint64_t frames_ = 0;                     ///< frames that came or were missing since began_
  aibo_system::RateLimit limit_{kMostFrames};
  std::optional<SoundPart> playing_;  ///< the newest part of the sound that plays
  std::uint64_t ended_ = 0;           ///< the newest sound whose end was reported
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_SOUND_INTAKE_H
