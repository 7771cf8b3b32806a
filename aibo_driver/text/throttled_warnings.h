/// @file throttled_warnings.h
#ifndef AIBO_DRIVER_TEXT_THROTTLED_WARNINGS_H
#define AIBO_DRIVER_TEXT_THROTTLED_WARNINGS_H

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "system/rate_limit.h"

namespace aibo_driver::text {

/// Logs what is wrong with data from others. Some programs repeat a mistake many times a second, and a stranger may
/// make another one each time. Neither may flood the log or hide other warnings. Any thread may use it. The log may
/// take its time, so never call it while a lock is held.
///
/// A warning is logged at most once per kRepetitionPeriod. Two warnings that differ only in numbers count as the same,
/// unless the number is part of a name. Of all warnings together, kBurst may be logged at once, and in the long run one
/// per kPeriod. The next warning says how many were left out. Texts are cut at kLongest bytes and shown by plainLine().
class ThrottledWarnings {
 public:
  static constexpr std::chrono::seconds kRepetitionPeriod{5};
  static constexpr int kBurst = 20;
  static constexpr std::chrono::seconds kPeriod{1};
  static constexpr std::size_t kLongest = 1000;

  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param log logs a warning
  /// @param now another clock, for tests
  explicit ThrottledWarnings(std::function<void(const std::string& text)> log,
                             std::function<TimePoint()> now = &std::chrono::steady_clock::now);

  void warn(const std::string& text);

  /// Logs a text even if it was logged a moment ago, for events that others cause.
  void say(const std::string& text);

 private:
  bool isNew(const std::string& kind, TimePoint now);

  const std::function<void(const std::string&)> log_;
  const std::function<TimePoint()> now_;
  std::mutex mutex_;
  std::map<std::string, TimePoint> last_;  ///< when each text was logged; texts without numbers. Guarded by mutex_
  aibo_system::RateLimit limit_{kBurst};
};

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_THROTTLED_WARNINGS_H
