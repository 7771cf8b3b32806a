/// @file console.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_CONSOLE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_CONSOLE_H

#include <functional>
#include <iosfwd>
#include <list>
#include <optional>
#include <string>
#include <utility>

#include "simulator/openr_host/ip_stack/poll_set.h"
#include "simulator/openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// The wireless console: what objects print goes to a stream and to everybody connected by telnet. What these type is
/// for whoever set the machine up, line by line; objects never see it, as on the robot.
class Console {
 public:
  /// Later ones are told so and turned away.
  static constexpr std::size_t kMostListeners = 8;

  /// Bytes kept for a listener that does not read. What comes on top of that is lost to it, and it is told so.
  static constexpr std::size_t kMostUnread = 64 * 1024;

  /// Characters of a line that is typed. A longer one is told so and left alone.
  static constexpr std::size_t kLongestLine = 256;

  /// Gets a line that a listener typed, without its end; what it returns is printed to that listener alone.
  using OnLine = std::function<std::string(const std::string& line)>;

  /// @param output may be null
  /// @param on_line may be empty: what is typed is ignored
  Console(std::ostream* output, OnLine on_line) : output_(output), on_line_(std::move(on_line)) {}

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
    std::string typed;     ///< of the line that has not ended yet; at most one character too long
  };

  static void print(Listener& listener, const std::string& text);
  static void flush(Listener& listener);
  void read(Listener& listener);
  void take(Listener& listener, char typed);
  void acceptListeners();

  std::ostream* const output_;
  const OnLine on_line_;
  std::optional<TcpListener> port_;
  std::list<Listener> listeners_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_CONSOLE_H
