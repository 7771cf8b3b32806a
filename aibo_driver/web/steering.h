/// @file steering.h
#ifndef AIBO_DRIVER_WEB_STEERING_H
#define AIBO_DRIVER_WEB_STEERING_H

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

namespace aibo_driver::web {

/// A page that is open in a browser. Each has its own number.
using Page = std::uint64_t;

using TimePoint = std::chrono::steady_clock::time_point;

/// Decides which page steers, and when its walk ends. One page steers at a time: as long as a finger is on one of its
/// pads, which the page has to repeat.
class Steering {
 public:
  /// After this time without a repetition, nobody steers. Pages repeat every 0.1 s.
  static constexpr std::chrono::milliseconds kHold{300};

  /// A finger is on a pad.
  /// @param walks it is on the pad for the legs
  /// @return false if another page steers
  bool hold(Page page, bool walks, TimePoint now) {
    if (page_.value_or(page) != page) {
      return false;
    }
    page_ = page;
    last_ = now;
    walks_ = walks_ || walks;
    return true;
  }

  /// No finger is on the page any more.
  /// @return true if the robot has to be told to stand
  bool letGo(Page page) {
    if (page_ != page) {
      return false;
    }
    page_.reset();
    return std::exchange(walks_, false);
  }

  /// Call this at the time of end().
  /// @return as for letGo()
  bool expire(TimePoint now) { return page_ && now >= end() && letGo(*page_); }

  /// Who steers.
  std::optional<Page> page() const { return page_; }

  /// When the page stops steering, unless it repeats what it wants.
  TimePoint end() const { return last_ + kHold; }

 private:
  std::optional<Page> page_;
  TimePoint last_;
  bool walks_ = false;
};

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_STEERING_H
