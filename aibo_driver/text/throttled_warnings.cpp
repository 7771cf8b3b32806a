#include "text/throttled_warnings.h"

#include <cctype>
#include <sstream>
#include <utility>

#include "text/plain_text.h"

namespace aibo_driver::text {
namespace {

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

ThrottledWarnings::ThrottledWarnings(std::function<void(const std::string& text)> log, std::function<TimePoint()> now)
    : log_(std::move(log)), now_(std::move(now)) {}

void ThrottledWarnings::warn(const std::string& text) {
  if (isNew(withoutNumbers(plainLine(text, kLongest)), now_())) {
    say(text);
  }
}

void ThrottledWarnings::say(const std::string& text) {
  const std::string line = plainLine(text, kLongest);
  const aibo_system::RateLimit::Admission admission = limit_.admit(now_(), kPeriod);
  if (admission.is_admitted) {
    log_(admission.left_out == 0 ? line
                                 : line + " (earlier messages left out: " + std::to_string(admission.left_out) + ")");
  }
}

// Texts quote what strangers send, so we remember no more texts than may have been logged in kRepetitionPeriod.
bool ThrottledWarnings::isNew(const std::string& kind, TimePoint now) {
  constexpr std::size_t kMostRemembered = kBurst + kRepetitionPeriod / kPeriod;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto each = last_.begin(); each != last_.end();) {
    each = now - each->second >= kRepetitionPeriod ? last_.erase(each) : std::next(each);
  }
  if (last_.size() >= kMostRemembered) {
    return last_.count(kind) == 0;
  }
  return last_.emplace(kind, now).second;
}

}  // namespace aibo_driver::text
