#ifndef TEST_FAULT_RADIO_NETWORK_HOST_H
#define TEST_FAULT_RADIO_NETWORK_HOST_H

#include <stdexcept>
#include <string>

namespace fault_bench {

/// This machine cannot play two hosts; the text says what is missing.
class NoNetworkHosts : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A host of its own, as far as the network goes: a network namespace with a loopback device and one TUN device, which
/// is the only way out. It is gone with the last thread and descriptor in it.
class NetworkHost {
 public:
  /// @param address of the host, IPv4; it takes 10.0.0.0/8 for its neighbourhood
  /// @throw NoNetworkHosts
  explicit NetworkHost(const std::string& address);
  ~NetworkHost();

  NetworkHost(const NetworkHost&) = delete;
  NetworkHost& operator=(const NetworkHost&) = delete;

  const std::string& address() const { return address_; }

  /// The calling thread, and whatever threads and processes it starts from now on, are on this host for good.
  void enter() const;

  /// Reads and writes the IP packets of the host's TUN device, one each time.
  int packets() const { return packets_; }

 private:
  const std::string address_;
  int name_space_ = -1;
  int packets_ = -1;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_NETWORK_HOST_H
