#include "client/reconnect_backoff.h"

#include <algorithm>

namespace aibo_driver {

using std::chrono::milliseconds;

ReconnectBackoff::ReconnectBackoff(milliseconds shortest, milliseconds longest, unsigned seed)
    : shortest_(shortest), longest_(longest), current_(shortest), random_(seed) {}

milliseconds ReconnectBackoff::next() {
  const milliseconds whole = current_;
  current_ = std::min(2 * current_, longest_);
  std::uniform_int_distribution<milliseconds::rep> part(whole.count() / 2, whole.count());
  return milliseconds(part(random_));
}

void ReconnectBackoff::reset() {
  current_ = shortest_;
}

}  // namespace aibo_driver
