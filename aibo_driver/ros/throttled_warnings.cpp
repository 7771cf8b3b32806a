#include "ros/throttled_warnings.h"

#include <cctype>
#include <cstddef>
#include <sstream>

namespace aibo_driver::node {
namespace {

constexpr std::chrono::seconds kRepetitionPeriod{5};

// Texts quote what users send, so their number is not limited.
constexpr std::size_t kMostRemembered = 100;

std::string withoutNumbers(const std::string& text) {
  std::istringstream words(text);
  std::string others;
  for (std::string word; words >> word;) {
    const bool is_number = word.front() == '-' || std::isdigit(static_cast<unsigned char>(word.front())) != 0;
    others += is_number ? " " : word + " ";
  }
  return others;
}

}  // namespace

void ThrottledWarnings::warn(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  const std::string kind = withoutNumbers(text);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = last_.find(kind);
    if (found != last_.end() && now - found->second < kRepetitionPeriod) {
      return;
    }
    if (last_.size() >= kMostRemembered) {
      last_.clear();
    }
    last_[kind] = now;
  }
  log_(text);
}

}  // namespace aibo_driver::node
