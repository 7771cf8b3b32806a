/// @file sound.h
/// Sound from the robot's microphones, and sound that it plays. Version 1 of the protocol has neither.
#ifndef AIBO_CLIENT_SOUND_H
#define AIBO_CLIENT_SOUND_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aibo_client/orders.h"

namespace aibo_client {

/// The samples per second of the sounds that the robot plays.
constexpr int kSoundRate = 16000;

/// The most samples that RcServerClient::playSamples() takes at once, 128 ms. They delay a request to stop by 33 ms on
/// a link of 1 Mbit/s. The value is our choice.
constexpr std::size_t kMostSamplesAtOnce = 2048;

/// The highest volume. The lowest is 0, which is silent.
constexpr int kLoudestVolume = 3;
/// The volume that the robot's own volume switch selects.
constexpr int kVolumeOfRobot = 255;

/// Selects the sound that the robot should send.
struct MicrophoneSettings {
  bool on = false;
  int channels = 2;                ///< 2: left and right; 1: the mean of both
  int samples_per_second = 16000;  ///< 8000 or 16000
  /// What waits on a link that is too slow for sound and pictures. true: pictures wait until all that was heard has
  /// been sent, and while less than half a second waits for the speaker. false: sound waits for each picture, and is
  /// left out if it comes too late. The choice also holds for playSamples(), even if `on` is false.
  bool before_pictures = false;

  bool operator==(const MicrophoneSettings& other) const {
    return on == other.on && channels == other.channels && samples_per_second == other.samples_per_second &&
           before_pictures == other.before_pictures;
  }
  bool operator!=(const MicrophoneSettings& other) const { return !(*this == other); }
};

/// What the robot has heard, usually for 16 ms.
struct HeardSound {
  std::uint32_t frame_number = 0;                 ///< the OPEN-R frame (8 ms) in which the first sample was heard
  std::chrono::steady_clock::time_point arrival;  ///< when the first byte was read
  std::uint64_t connection_number = 0;            ///< as in Telemetry
  int channels = 0;
  int samples_per_second = 0;
  /// How many samples of each channel are missing before this piece, because the connection was too slow. It is 0 for
  /// the first piece after a pause.
  std::uint32_t missing = 0;
  std::vector<std::int16_t> samples;  ///< with two channels, left and right in turn
};

/// The progress of a sound that the robot plays.
struct SoundProgress {
  std::uint64_t sound = 0;  ///< the sound's number
  std::size_t room = 0;  ///< how many more samples may follow now; while the sound plays, kSoundRate more each second
};

/// How a sound has ended.
struct SoundEnd {
  std::uint64_t sound = 0;  ///< SoundProgress::sound
  /// kDone: the sound was played to its end. kReplaced, kStopped: a later call ended it. kRefused: the robot ended it,
  /// because no samples came for 2 s. kLost: the connection broke.
  EndedHow how = EndedHow::kUnknown;
  /// @name What the robot says if it ended the sound by itself; otherwise 0
  /// @{
  std::uint32_t samples = 0;  ///< samples that were played, with the silence in the gaps
  std::uint32_t gaps = 0;     ///< how often samples came too late
  std::uint32_t missing = 0;  ///< samples of silence in these gaps
  /// @}
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_SOUND_H
