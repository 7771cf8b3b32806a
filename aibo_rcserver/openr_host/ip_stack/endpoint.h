/// @file endpoint.h
#ifndef OPENR_HOST_IP_STACK_ENDPOINT_H
#define OPENR_HOST_IP_STACK_ENDPOINT_H

#include <cstddef>
#include <functional>

#include "openr_host/ip_stack/poll_set.h"

namespace openr_host {

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

#endif  // OPENR_HOST_IP_STACK_ENDPOINT_H
