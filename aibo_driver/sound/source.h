/// @file source.h
#ifndef AIBO_DRIVER_SOUND_SOURCE_H
#define AIBO_DRIVER_SOUND_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace aibo_driver::sound {

/// Gives the samples of a sound for the robot: mono, aibo_client::kSoundRate a second.
class Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// The next samples.
  /// @return fewer than `most` only at the end
  virtual std::vector<std::int16_t> read(std::size_t most) = 0;
};

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_SOURCE_H
