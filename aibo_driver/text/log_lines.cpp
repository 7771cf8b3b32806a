#include "text/log_lines.h"

#include "text/plain_text.h"

namespace aibo_driver::text {

LogLines::LogLines(std::function<TimePoint()> now) : now_(std::move(now)) {}

std::optional<std::string> LogLines::admit(const std::string& file, int line, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  aibo_system::RateLimit& limit = limits_.try_emplace({file, line}, kBurst).first->second;
  const aibo_system::RateLimit::Admission admission = limit.admit(now_(), kPeriod);
  if (!admission.is_admitted) {
    return std::nullopt;
  }
  const std::string plain = plainLine(text, kLongest);
  return admission.left_out == 0 ? plain
                                 : plain + " (earlier lines left out: " + std::to_string(admission.left_out) + ")";
}

}  // namespace aibo_driver::text
