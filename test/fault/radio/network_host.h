#ifndef TEST_FAULT_RADIO_NETWORK_HOST_H
#define TEST_FAULT_RADIO_NETWORK_HOST_H

#include <stdexcept>
#include <string>

#include "host_files/file_descriptor.h"

namespace fault_bench {

/// Thrown if this machine cannot act as two hosts. The text says what is missing.
class NoNetworkHosts : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A network namespace with a loopback device and one TUN device, which is the only way out. To the network, it is a
/// host of its own. It lasts until the last thread has left it and its descriptors are closed.
class NetworkHost {
 public:
  /// @param address IPv4 address of the host; 10.0.0.0/8 is its network
  /// @throw NoNetworkHosts
  explicit NetworkHost(const std::string& address);

  const std::string& address() const { return address_; }

  /// Moves the calling thread to this host for good, with all threads and processes that it starts from now on.
  void enter() const;

  /// A descriptor for the IP packets of the host's TUN device: each read or write is one packet.
  int packets() const { return packets_.get(); }

 private:
  const std::string address_;
  host_files::FileDescriptor name_space_;
  host_files::FileDescriptor packets_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_NETWORK_HOST_H
