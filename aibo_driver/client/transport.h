/// @file transport.h
#ifndef AIBO_DRIVER_CLIENT_TRANSPORT_H
#define AIBO_DRIVER_CLIENT_TRANSPORT_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace aibo_driver {

using TimePoint = std::chrono::steady_clock::time_point;

/// A connection that can be made again and again, and the one place where the client's thread waits.
/// abort() and wakeUp() may be called from any thread, everything else from the client's thread only.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Connects, or leaves nothing behind.
  /// @throw Fault there is no connection at the deadline, or it is clear earlier that there will be none
  /// @throw StoppedException abort() was called
  virtual void connect(const std::string& host, int port, TimePoint deadline) = 0;

  /// Waits until receive() has something to tell, wakeUp() is called, or the deadline passes. With no connection it
  /// waits for the other two. Meanwhile it sends what send() has left to do, and may come back early when it has.
  /// @return true if receive() has something to tell
  /// @throw Fault the connection is over
  /// @throw StoppedException abort() was called
  virtual bool wait(TimePoint deadline) = 0;

  /// Takes what has arrived, without waiting.
  /// @return bytes written to buffer; below capacity if nothing more is there now
  /// @throw Fault the connection is over
  virtual std::size_t receive(std::uint8_t* buffer, std::size_t capacity) = 0;

  /// Sends a request, without waiting: what the network does not take at once is kept, and sent by wait().
  /// @throw Fault the connection is over, or the peer has long stopped reading
  virtual void send(const std::uint8_t* data, std::size_t size) = 0;

  /// Ends the connection, if there is one.
  virtual void close() noexcept = 0;

  /// Ends the wait() in progress, or the next one.
  virtual void wakeUp() noexcept = 0;

  /// Ends connect() and wait() now and for ever.
  virtual void abort() noexcept = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_TRANSPORT_H
