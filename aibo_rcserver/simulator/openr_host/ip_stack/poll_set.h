/// @file poll_set.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H

#include <poll.h>

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace openr_host {

/// What one wait waits for. Filled again for every wait: there are only a handful of sockets, and what each waits for
/// changes all the time.
class PollSet {
 public:
  using Handler = std::function<void()>;

  /// @param events POLLIN, POLLOUT or both; errors always count too
  /// @param handler called by wait() if one of these is there. It may close its own descriptor, but no other one.
  void add(int fd, short events, Handler handler);

  /// Waits until the deadline, for ever without one, or until a descriptor is ready; then calls the handlers of those
  /// that are, in the order in which they were added.
  /// @return false if none was
  /// @throw std::system_error
  bool wait(const std::optional<std::chrono::steady_clock::time_point>& deadline);

 private:
  std::vector<pollfd> descriptors_;
  std::vector<Handler> handlers_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
