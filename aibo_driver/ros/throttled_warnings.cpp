#include "throttled_warnings.h"

#include <cstddef>

namespace aibo_driver {
namespace {

constexpr std::chrono::seconds kPeriod{5};

// Texts hold what users send, so there is no end to how many there are.
constexpr std::size_t kMostRemembered = 100;

}  // namespace

void ThrottledWarnings::warn(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  const auto found = last_.find(text);
  if (found != last_.end() && now - found->second < kPeriod) {
    return;
  }
  if (last_.size() >= kMostRemembered) {
    last_.clear();
  }
  last_[text] = now;
  log_(text);
}

}  // namespace aibo_driver
