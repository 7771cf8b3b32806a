#include "resource_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace soak {
namespace {

using test_support::Resources;

// A line through fewer samples says nothing about an hour.
constexpr ResourceLog::Seconds kShortestTrend{600};
constexpr double kAllowedKilobytes = 1024;

}  // namespace

const Resources& ResourceLog::sample(pid_t process, Seconds time) {
  samples_.push_back({process, time, Resources::of(std::to_string(process))});
  return samples_.back().resources;
}

std::vector<ResourceLog::Sample> ResourceLog::warmSamples() const {
  std::map<pid_t, Seconds> births;
  std::vector<Sample> warm;
  for (const Sample& sample : samples_) {
    const Seconds birth = births.emplace(sample.process, sample.time).first->second;
    if (sample.time - birth >= warm_up_) {
      warm.push_back(sample);
    }
  }
  return warm;
}

double ResourceLog::kilobytesPerHour() const {
  struct Sums {
    double count = 0;
    double time = 0;
    double memory = 0;
  };
  const std::vector<Sample> warm = warmSamples();
  std::map<pid_t, Sums> lives;
  for (const Sample& sample : warm) {
    Sums& life = lives[sample.process];
    ++life.count;
    life.time += sample.time.count();
    life.memory += static_cast<double>(sample.resources.resident_kilobytes);
  }
  double products = 0;
  double squares = 0;
  for (const Sample& sample : warm) {
    const Sums& life = lives[sample.process];
    const double time = sample.time.count() - life.time / life.count;
    products += time * (static_cast<double>(sample.resources.resident_kilobytes) - life.memory / life.count);
    squares += time * time;
  }
  return squares > 0 ? 3600 * products / squares : 0;
}

// The minimum over a part of the warm samples, from `begin` to `end`, 0 to 1. Unlike a maximum, it is not disturbed by
// what comes and goes, such as sockets of subscribers.
std::size_t ResourceLog::least(std::size_t Resources::*resource, double begin, double end) const {
  const std::vector<Sample> warm = warmSamples();
  const auto at = [&](double part) { return static_cast<std::size_t>(part * static_cast<double>(warm.size())); };
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = at(begin); i < at(end); ++i) {
    least = std::min(least, warm[i].resources.*resource);
  }
  return least;
}

ResourceLog::Seconds ResourceLog::warmTime() const {
  const std::vector<Sample> warm = warmSamples();
  return warm.empty() ? Seconds(0) : warm.back().time - warm.front().time;
}

void ResourceLog::print() const {
  const auto print = [this](const char* what, std::size_t Resources::*resource) {
    const auto less = [resource](const Sample& a, const Sample& b) {
      return a.resources.*resource < b.resources.*resource;
    };
    const auto ends = std::minmax_element(samples_.begin(), samples_.end(), less);
    std::printf("  %-7s %-12s first %6zu, least %6zu, most %6zu, last %6zu\n", name_.c_str(), what,
                samples_.front().resources.*resource, ends.first->resources.*resource, ends.second->resources.*resource,
                samples_.back().resources.*resource);
  };
  if (samples_.empty()) {
    return;
  }
  print("memory KB", &Resources::resident_kilobytes);
  print("descriptors", &Resources::descriptors);
  print("threads", &Resources::threads);
  if (warmTime() >= kShortestTrend) {
    std::printf("  %-7s after the warm-up (%.0f s), memory changes by %+.0f KB per hour\n", name_.c_str(),
                warm_up_.count(), kilobytesPerHour());
  }
}

void ResourceLog::judge(Violations* violations) const {
  const Seconds time = warmTime();
  if (time < kShortestTrend) {
    return;
  }
  const double growth = kilobytesPerHour() * time.count() / 3600;
  if (test_support::kMemoryCounts && growth > kAllowedKilobytes) {
    violations->add(name_ + ": " + std::to_string(std::lround(growth)) + " KB more");
  }
  if (least(&Resources::descriptors, 0.75, 1) > least(&Resources::descriptors, 0, 0.25)) {
    violations->add(name_ + ": more descriptors at the end than after the warm-up");
  }
  if (least(&Resources::threads, 0.75, 1) > least(&Resources::threads, 0, 0.25)) {
    violations->add(name_ + ": more threads at the end than after the warm-up");
  }
}

}  // namespace soak
