/// @file log_lines.h
#ifndef AIBO_DRIVER_TEXT_LOG_LINES_H
#define AIBO_DRIVER_TEXT_LOG_LINES_H

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "system/rate_limit.h"

namespace aibo_driver::text {

/// Makes all lines of a log plain, short and few. A library such as roscpp quotes what strangers send to it, as often
/// as they send it.
///
/// Each statement that logs may log kBurst lines at once, and in the long run one per kPeriod. So a flood from one of
/// them hides no line of another one. The next line of a statement says how many were left out. Lines are cut at
/// kLongest bytes and shown by plainLine(). Any thread may use it.
class LogLines {
 public:
  static constexpr int kBurst = 100;
  static constexpr std::chrono::seconds kPeriod{1};
  static constexpr std::size_t kLongest = 2000;

  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param now another clock, for tests
  explicit LogLines(std::function<TimePoint()> now = &std::chrono::steady_clock::now);

  /// @param file the source file of the statement that logs, and its line there
  /// @return what to log; nothing if the line is left out
  std::optional<std::string> admit(const std::string& file, int line, const std::string& text);

 private:
  const std::function<TimePoint()> now_;
  std::mutex mutex_;
  std::map<std::pair<std::string, int>, aibo_system::RateLimit> limits_;  ///< guarded by mutex_; none is ever removed
};

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_LOG_LINES_H
