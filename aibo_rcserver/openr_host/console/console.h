/// @file console.h
#ifndef OPENR_HOST_CONSOLE_CONSOLE_H
#define OPENR_HOST_CONSOLE_CONSOLE_H

#include <iosfwd>
#include <list>
#include <optional>
#include <string>

#include "openr_host/ip_stack/poll_set.h"
#include "openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// The wireless console: what objects print goes to a stream and to everybody connected by telnet.
class Console {
 public:
  /// Later ones are told so and turned away.
  static constexpr std::size_t kMostListeners = 8;

  /// Bytes kept for a listener that does not read. What comes on top of that is lost to it, and it is told so.
  static constexpr std::size_t kMostUnread = 64 * 1024;

  /// @param output may be null
  explicit Console(std::ostream* output) : output_(output) {}

  /// Takes a port of this computer for listeners.
  /// @return the port taken
  /// @throw as TcpListener
  std::uint16_t takePort(const std::string& bind_address, std::uint16_t port);

  /// Never waits for a listener.
  void print(const std::string& text);

  void addTo(PollSet& poll_set);

 private:
  struct Listener {
    FileDescriptor socket;
    std::string unsent;
    std::size_t lost = 0;  ///< prints that found no room
  };

  static void print(Listener& listener, const std::string& text);
  static void flush(Listener& listener);
  static void discardInput(Listener& listener);
  void acceptListeners();

  std::ostream* const output_;
  std::optional<TcpListener> port_;
  std::list<Listener> listeners_;
};

}  // namespace openr_host

#endif  // OPENR_HOST_CONSOLE_CONSOLE_H
