/// @file poll_set.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H

#include <poll.h>

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace openr_host {

/// The descriptors for one wait. The set is filled again for every wait, because there are few sockets, and their
/// events change all the time.
class PollSet {
 public:
  using Handler = std::function<void()>;

  /// Removes all descriptors, but keeps the memory for the next ones.
  void clear();

  /// @param events POLLIN, POLLOUT or both; errors are always included
  /// @param handler called by wait() after an event; it may close its own descriptor, but no other
  void add(int fd, short events, Handler handler);

  /// Waits for a descriptor, up to the deadline (forever without one). After that, calls the handlers of ready
  /// descriptors, in the order of add().
  /// @return false if no descriptor was ready
  /// @throw std::system_error
  bool wait(const std::optional<std::chrono::steady_clock::time_point>& deadline);

 private:
  std::vector<pollfd> descriptors_;
  std::vector<Handler> handlers_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
