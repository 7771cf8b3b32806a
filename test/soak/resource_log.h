/// @file resource_log.h
#ifndef TEST_SOAK_RESOURCE_LOG_H
#define TEST_SOAK_RESOURCE_LOG_H

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "support/resources.h"

namespace soak {

/// The resources of a process over time.
class ResourceLog {
 public:
  /// @param path of a table that is written for plots: seconds, KB, descriptors, threads
  explicit ResourceLog(const std::string& path) : table_(path) {}

  /// Takes a sample.
  /// @param seconds since the beginning
  void sample(int process, double seconds) {
    const Resources now = Resources::of(std::to_string(process));
    table_ << seconds << ',' << now.resident_kilobytes << ',' << now.descriptors << ',' << now.threads << std::endl;
    if (seconds >= kWarmUp) {
      samples_.push_back({seconds, now});
    }
  }

  /// @return what has grown from the first quarter to the last one, after a warm-up of 5 minutes; empty if nothing has
  ///   grown, or if less than 10 more minutes were measured, which is too short
  std::string growth() const {
    if (samples_.empty() || samples_.back().seconds - samples_.front().seconds < kShortest) {
      return "";
    }
    std::string text;
    for (const auto& [resource, allowed, unit] :
         {std::tuple(&Resources::descriptors, std::size_t{0}, " descriptors more "),
          {&Resources::threads, 0, " threads more "},
          {&Resources::resident_kilobytes, kAllowedKilobytes, " KB more"}}) {
      const bool counts = test_support::kMemoryCounts || resource != &Resources::resident_kilobytes;
      if (const std::size_t count = added(resource); counts && count > allowed) {
        text += std::to_string(count) + unit;
      }
    }
    return text;
  }

 private:
  using Resources = test_support::Resources;

  struct Sample {
    double seconds;
    Resources resources;
  };

  static constexpr double kWarmUp = 300;    // s
  static constexpr double kShortest = 600;  // s
  static constexpr std::size_t kAllowedKilobytes = 1024;

  // Unlike a maximum, a minimum is not disturbed by what comes and goes, such as sockets of subscribers.
  std::size_t added(std::size_t Resources::*resource) const {
    const auto less = [resource](const Sample& a, const Sample& b) {
      return a.resources.*resource < b.resources.*resource;
    };
    const auto quarter = static_cast<std::ptrdiff_t>(samples_.size() / 4);
    const auto first = std::min_element(samples_.begin(), samples_.begin() + quarter, less);
    const auto last = std::min_element(samples_.end() - quarter, samples_.end(), less);
    return std::max(last->resources.*resource, first->resources.*resource) - first->resources.*resource;
  }

  std::ofstream table_;
  std::vector<Sample> samples_;  // after the warm-up
};

}  // namespace soak

#endif  // TEST_SOAK_RESOURCE_LOG_H
