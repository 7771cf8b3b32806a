/// @file throttled_warnings.h
#ifndef AIBO_DRIVER_ROS_THROTTLED_WARNINGS_H
#define AIBO_DRIVER_ROS_THROTTLED_WARNINGS_H

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace aibo_driver::node {

/// Logs each different warning only once in a while: a program that repeats its mistake many times a second neither
/// floods the log nor hides other warnings. Two warnings that differ only in numbers are the same; numbers within names
/// count. From any thread.
class ThrottledWarnings {
 public:
  /// @param log logs a warning
  explicit ThrottledWarnings(std::function<void(const std::string& text)> log) : log_(std::move(log)) {}

  void warn(const std::string& text);

 private:
  const std::function<void(const std::string&)> log_;
  std::mutex mutex_;
  std::map<std::string, std::chrono::steady_clock::time_point> last_;  ///< when each was logged; texts without numbers
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_THROTTLED_WARNINGS_H
