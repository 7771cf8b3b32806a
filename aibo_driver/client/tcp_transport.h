/// @file tcp_transport.h
#ifndef AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H
#define AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "client/datagram_socket.h"
#include "client/name_lookup.h"
#include "host_files/file_descriptor.h"
#include "system/event.h"

namespace aibo_client {

using TimePoint = std::chrono::steady_clock::time_point;

/// A connection over TCP (IPv4 or IPv6) that can be made again and again, and a socket for datagrams beside it. It is
/// the only place where the client's thread waits. Any thread may call abort() and wakeUp(). Only the client's thread
/// may call the other functions.
class TcpTransport {
 public:
  /// Where something has arrived.
  struct Readable {
    bool connection;  ///< receive() has bytes or a fault to report
    bool datagrams;   ///< datagrams().receive() has a datagram
  };

  explicit TcpTransport(Resolver resolver = resolveWithSystem);

  /// Connects. A failed attempt leaves nothing behind.
  /// @throw Fault there is no connection at the deadline, or none can be made
  /// @throw StoppedException abort() was called
  void connect(const std::string& host, int port, TimePoint deadline);

  /// Waits until something has arrived, wakeUp() is called, or the deadline passes. Without a connection it only waits
  /// for the last two. Meanwhile it sends what send() has left. It may return early after that, or after 250 ms, so
  /// that the caller can drop what has become too old.
  /// @throw Fault the connection is over
  /// @throw StoppedException abort() was called
  Readable wait(TimePoint deadline);

  /// Reads what has arrived, without waiting.
  /// @return the number of bytes written to buffer; if it is below capacity, nothing more is there now
  /// @throw Fault the connection is over
  std::size_t receive(std::uint8_t* buffer, std::size_t capacity);

  /// Sends a request without waiting. What the network does not take at once is kept, and wait() sends it.
  /// @throw Fault the connection is over, or the peer has long stopped reading
  void send(const std::uint8_t* data, std::size_t size);

  /// True if the network has not taken everything that was given to send().
  bool hasUnsent() const { return !unsent_.empty(); }

  /// Takes a port for datagrams from the connection's peer. From then on, wait() returns early when a datagram is
  /// there.
  /// @return false if the kernel refuses, and errno says why: ENOTCONN if the peer has reset the connection
  bool openDatagrams() { return datagrams_.open(socket_.get()); }

  /// The socket for datagrams. It is open from openDatagrams() to the end of the connection.
  DatagramSocket& datagrams() { return datagrams_; }

  /// Ends the connection, if there is one.
  void close() noexcept;

  /// Ends the wait() in progress, or the next one.
  void wakeUp() noexcept;

  /// Ends connect() and wait(), now and whenever they are called again.
  void abort() noexcept;

 private:
  std::vector<SocketAddress> lookUp(const std::string& host, int port, TimePoint deadline);
  void beginToConnect(int socket, const SocketAddress& address) const;
  void checkConnected(int socket) const;
  bool waitFor(int descriptor, short events, TimePoint deadline);
  std::pair<short, short> pollOnce(int descriptor, short events, TimePoint deadline, int other = -1);
  void sendOn();
  [[noreturn]] void throwFault(int error) const;

  NameLookup name_lookup_;
  aibo_system::Event wake_up_;
  std::atomic<bool> aborted_{false};
  std::string address_;  // "host:port", for messages
  host_files::FileDescriptor socket_;
  DatagramSocket datagrams_;
  std::vector<std::uint8_t> unsent_;  // the bytes given to send() that the network has not taken yet
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_TCP_TRANSPORT_H
