#include "simulator/openr_host/ip_stack/poll_set.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <thread>
#include <utility>

namespace openr_host {

void PollSet::clear() {
  descriptors_.clear();
  handlers_.clear();
}

void PollSet::add(int fd, short events, Handler handler) {
  descriptors_.push_back({fd, events, 0});
  handlers_.push_back(std::move(handler));
}

bool PollSet::wait(const std::optional<std::chrono::steady_clock::time_point>& deadline) {
  timespec timeout{};
  if (deadline) {
    // The wait has a finer unit than poll()'s milliseconds, which are too coarse for frames of 8 ms.
    const auto left =
        std::max(std::chrono::steady_clock::duration::zero(), *deadline - std::chrono::steady_clock::now());
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
    timeout.tv_sec = static_cast<time_t>(seconds.count());
    timeout.tv_nsec = static_cast<long>(std::chrono::nanoseconds(left - seconds).count());
  }
  const int ready = ppoll(descriptors_.data(), descriptors_.size(), deadline ? &timeout : nullptr, nullptr);
  if (ready < 0 && errno == ENOMEM) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // wait until the kernel has memory again
  } else if (ready < 0 && errno != EINTR) {
    throw std::system_error(errno, std::generic_category(), "ppoll");
  }
  if (ready <= 0) {
    return false;
  }
  for (std::size_t i = 0; i < descriptors_.size(); ++i) {
    if (descriptors_[i].revents != 0) {
      handlers_[i]();
    }
  }
  return true;
}

}  // namespace openr_host
