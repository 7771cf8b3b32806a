/// @file level.h
#ifndef AIBO_DRIVER_SOUND_LEVEL_H
#define AIBO_DRIVER_SOUND_LEVEL_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace aibo_driver::sound {

/// The loudness of what was heard.
class Level {
 public:
  void add(const std::vector<std::int16_t>& samples) {
    for (const std::int16_t sample : samples) {
      sum_ += static_cast<double>(sample) * sample;
    }
    count_ += samples.size();
  }

  /// The number of samples since take().
  std::size_t count() const { return count_; }

  /// Returns the level since the last call, and begins anew. Call this only if count() is above 0.
  /// @return the effective value in dB, where 0 is that of the loudest square wave; at least -90.3
  double take() {
    constexpr double kLowest = 1;  // samples are whole numbers
    constexpr double kFullScale = 32768;
    const double effective = std::sqrt(std::exchange(sum_, 0) / static_cast<double>(std::exchange(count_, 0)));
    return 20 * std::log10(std::max(kLowest, effective) / kFullScale);
  }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_LEVEL_H
