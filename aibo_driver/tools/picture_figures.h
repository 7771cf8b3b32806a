/// @file picture_figures.h
#ifndef AIBO_DRIVER_TOOLS_PICTURE_FIGURES_H
#define AIBO_DRIVER_TOOLS_PICTURE_FIGURES_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>

namespace aibo_driver::tools {

/// How many pictures came in a time, and how late.
class PictureFigures {
 public:
  using Milliseconds = std::chrono::duration<double, std::milli>;

  void add(std::size_t bytes, Milliseconds latency) {
    ++pictures_;
    bytes_ += bytes;
    latencies_ += latency;
    worst_ = std::max(worst_, latency);
  }

  bool empty() const { return pictures_ == 0; }

  /// In words.
  /// @param time in which they came
  std::string words(std::chrono::duration<double> time) const;

 private:
  std::size_t pictures_ = 0;
  std::size_t bytes_ = 0;
  Milliseconds latencies_{};
  Milliseconds worst_{};
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PICTURE_FIGURES_H
