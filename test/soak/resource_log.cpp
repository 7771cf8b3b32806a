#include "resource_log.h"

#include <algorithm>

namespace soak {
namespace {

using test_support::Resources;

constexpr double kWarmUp = 300;    // s
constexpr double kShortest = 600;  // s
constexpr std::size_t kAllowedKilobytes = 1024;

}  // namespace

void ResourceLog::sample(int process, double seconds) {
  const Resources now = Resources::of(std::to_string(process));
  table_ << seconds << ',' << now.resident_kilobytes << ',' << now.descriptors << ',' << now.threads << std::endl;
  if (seconds >= kWarmUp) {
    samples_.push_back({seconds, now});
  }
}

std::string ResourceLog::growth() const {
  if (samples_.empty() || samples_.back().seconds - samples_.front().seconds < kShortest) {
    return "";
  }
  // Unlike a maximum, a minimum is not disturbed by what comes and goes, such as sockets of subscribers.
  const auto added = [this](std::size_t Resources::*resource) {
    const auto less = [resource](const Sample& a, const Sample& b) {
      return a.resources.*resource < b.resources.*resource;
    };
    const auto quarter = static_cast<std::ptrdiff_t>(samples_.size() / 4);
    const auto first = std::min_element(samples_.begin(), samples_.begin() + quarter, less);
    const auto last = std::min_element(samples_.end() - quarter, samples_.end(), less);
    return std::max(last->resources.*resource, first->resources.*resource) - first->resources.*resource;
  };
  std::string text;
  if (const auto count = added(&Resources::descriptors); count > 0) {
    text += std::to_string(count) + " descriptors more ";
  }
  if (const auto count = added(&Resources::threads); count > 0) {
    text += std::to_string(count) + " threads more ";
  }
  if (const auto count = added(&Resources::resident_kilobytes);
      test_support::kMemoryCounts && count > kAllowedKilobytes) {
    text += std::to_string(count) + " KB more";
  }
  return text;
}

}  // namespace soak
