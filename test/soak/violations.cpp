#include "violations.h"

#include <chrono>
#include <cstdio>
#include <ctime>

namespace soak {

void Violations::setScene(const std::string& scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  scene_ = scene;
}

void Violations::add(const std::string& violation) {
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

std::size_t Violations::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return count_;
}

std::size_t Violations::countIn(const std::string& scene) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = by_scene_.find(scene);
  return found == by_scene_.end() ? 0 : found->second;
}

}  // namespace soak
