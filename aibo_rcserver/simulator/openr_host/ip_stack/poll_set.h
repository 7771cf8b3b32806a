/// @file poll_set.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H

#include <poll.h>

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

namespace openr_host {

/// The descriptors for one wait. It is filled again for every wait: there are few sockets, and their events change all
/// the time.
class PollSet {
 public:
  using Handler = std::function<void()>;

  /// Keeps the memory for the next descriptors.
  void clear();

  /// @param events POLLIN, POLLOUT or both; errors are always included
  /// @param handler called by wait() after an event; it may close its own descriptor, but no other
  void add(int fd, short events, Handler handler);

  /// Waits for a descriptor, up to the deadline (forever without one). Then calls the handlers of ready descriptors, in
  /// the order of add().
  /// @return false if none was ready
  /// @throw std::system_error
  bool wait(const std::optional<std::chrono::steady_clock::time_point>& deadline);

 private:
  std::vector<pollfd> descriptors_;
  std::vector<Handler> handlers_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_POLL_SET_H
