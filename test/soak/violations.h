/// @file violations.h
#ifndef TEST_SOAK_VIOLATIONS_H
#define TEST_SOAK_VIOLATIONS_H

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <map>
#include <mutex>
#include <string>

namespace soak {

/// Prints violations as they happen, and counts them. Any thread.
class Violations {
 public:
  /// Names what goes on from now on; the name is printed with each violation.
  void setScene(const std::string& scene) {
    const std::lock_guard<std::mutex> lock(mutex_);
    scene_ = scene;
  }

  void add(const std::string& violation) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
    ++by_scene_[scene_];
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm local{};
    char clock[16];
    std::strftime(clock, sizeof clock, "%H:%M:%S", localtime_r(&now, &local));
    std::printf("%s VIOLATION (%s): %s\n", clock, scene_.c_str(), violation.c_str());
    std::fflush(stdout);
  }

  std::size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }

  /// Violations in scenes of this name.
  std::size_t countIn(const std::string& scene) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = by_scene_.find(scene);
    return found == by_scene_.end() ? 0 : found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::string scene_;
  std::map<std::string, std::size_t> by_scene_;
  std::size_t count_ = 0;
};

}  // namespace soak

#endif  // TEST_SOAK_VIOLATIONS_H
