/// @file endpoint.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H

#include <cerrno>
#include <cstddef>
#include <functional>

#include "simulator/openr_host/ip_stack/poll_set.h"

namespace openr_host {

/// True for the error of a call that is to be tried again when the socket is ready.
inline bool isTransient(int error) {
  return error == EAGAIN || error == EINTR;
}

/// A size as messages have it, which was checked to be 1 or more.
inline std::size_t sizeOf(int size) {
  return static_cast<std::size_t>(size);
}

/// An endpoint of the IPStack, of whatever kind.
class Endpoint {
 public:
  Endpoint() = default;
  virtual ~Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  /// Nothing can be asked of it any more, and all that was asked has been answered.
  virtual bool isClosed() const = 0;

  /// Whether something under way uses memory for which this is true.
  virtual bool uses(const std::function<bool(const void*, std::size_t)>& is_concerned) const = 0;

  virtual void addTo(PollSet& poll_set) = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_ENDPOINT_H
