/// @file dns_endpoint.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_DNS_ENDPOINT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_DNS_ENDPOINT_H

#include <DNSEndpointMsg.h>

#include <memory>
#include <string>

#include "simulator/openr_host/ip_stack/endpoint.h"
#include "simulator/openr_host/ip_stack/socket.h"

namespace openr_host {

/// Asks this computer's resolver, which may take many seconds, in a thread of its own.
class DnsEndpoint : public Endpoint {
 public:
  static constexpr DNSEndpointError kOperationInvalid = DNS_OPERATION_INVALID;

  /// @param deliver must outlive this
  explicit DnsEndpoint(const Deliver& deliver) : deliver_(deliver), asking_(deliver) {}

  /// Answers a request that is not about a host.
  void answer(DNSEndpointBaseMsg& message);

  /// Answered later, or at once with an error.
  void askForHost(const Envelope& message);

  bool isClosed() const override { return is_closed_; }
  bool uses(const std::function<bool(const void*, std::size_t)>& /*is_concerned*/) const override { return false; }
  void addTo(PollSet& poll_set) override;

 private:
  /// What the resolver has found. Its thread has this, too, and may outlive the endpoint.
  struct Found {
    DNSEndpointError error = DNS_FAIL;
    std::string name;
    IPAddress address;
    int addresses = 0;
    FileDescriptor done;  ///< readable when the rest is complete
  };

  static void find(antOperation operation, Found* found);
  void finish();

  const Deliver& deliver_;
  PendingMessage<DNSEndpointHostMsg> asking_;
  std::shared_ptr<Found> found_;
  bool is_closed_ = false;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_DNS_ENDPOINT_H
