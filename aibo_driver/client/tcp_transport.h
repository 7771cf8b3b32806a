/// @file tcp_transport.h
#ifndef AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H
#define AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "client/event.h"
#include "client/file_descriptor.h"
#include "client/name_lookup.h"
#include "client/transport.h"

namespace aibo_driver {

/// TCP over IPv4 or IPv6, on a non-blocking socket.
class TcpTransport : public Transport {
 public:
  explicit TcpTransport(Resolver resolver = resolveWithSystem);

  void connect(const std::string& host, int port, TimePoint deadline) override;
  bool wait(TimePoint deadline) override;
  std::size_t receive(std::uint8_t* buffer, std::size_t capacity) override;
  void send(const std::uint8_t* data, std::size_t size) override;
  void close() noexcept override;
  void wakeUp() noexcept override;
  void abort() noexcept override;

 private:
  std::vector<SocketAddress> lookUp(const std::string& host, int port, TimePoint deadline);
  FileDescriptor connectTo(const SocketAddress& address, TimePoint deadline);
  FileDescriptor beginToConnect(const SocketAddress& address) const;
  void checkConnected(int socket) const;
  bool waitFor(int descriptor, short events, TimePoint deadline);
  short pollOnce(int descriptor, short events, TimePoint deadline);
  void sendOn();
  [[noreturn]] void throwFault(int error) const;

  NameLookup name_lookup_;
  Event wake_up_;
  std::atomic<bool> aborted_{false};
  std::string address_;  // "host:port", for messages
  FileDescriptor socket_;
  std::vector<std::uint8_t> unsent_;  // of what send() was given
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H
