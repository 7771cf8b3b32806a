/// @file console.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <list>
#include <optional>
#include <string>
#include <utility>

#include "simulator/openr_host/ip_stack/poll_set.h"
#include "simulator/openr_host/ip_stack/tcp_listener.h"

namespace openr_host {

/// The console's TCP port on the robot (report, section 2.2).
constexpr std::uint16_t kConsolePort = 59000;

/// The wireless console. What objects print goes to a stream and to all telnet connections. Typed lines go to a
/// callback; objects never see them, as on the robot.
///
/// A web page could make a browser send lines to this port. So a listener whose first line is not a command is
/// disconnected and not obeyed.
class Console {
 public:
  /// The most listeners. Any other one gets a message and is disconnected.
  static constexpr std::size_t kMostListeners = 8;

  /// How many bytes are kept for a listener that does not read. It loses further text, and is told so.
  static constexpr std::size_t kMostUnread = 64 * 1024;

  /// The most characters in a typed line. A longer line is answered by an error.
  static constexpr std::size_t kLongestLine = 256;

  /// Called with a typed line, without its end. The result is printed only to that listener; it is empty if there is no
  /// such command.
  using OnLine = std::function<std::optional<std::string>(const std::string& line)>;

  /// @param output may be null
  /// @param on_line may be empty; in that case typed lines are ignored
  Console(std::ostream* output, OnLine on_line) : output_(output), on_line_(std::move(on_line)) {}

  /// Opens a port of this computer for listeners.
  /// @return the port
  /// @throw the exceptions of TcpListener
  std::uint16_t takePort(const std::string& bind_address, std::uint16_t port);

  /// Prints to the output and all listeners, without waiting.
  void print(const std::string& text);

  /// Adds the port and all listeners' sockets, with handlers.
  void addTo(PollSet& poll_set);

 private:
  struct Listener {
    FileDescriptor socket;
    std::string unsent;
    std::size_t lost = 0;   ///< prints that did not fit
    std::string typed;      ///< the unfinished line, which is at most one character too long
    bool is_known = false;  ///< the listener has typed a command
  };

  static void print(Listener& listener, const std::string& text);
  static void flush(Listener& listener);
  void read(Listener& listener);
  void take(Listener& listener, char typed);
  void obey(Listener& listener, const std::string& line);
  void refuse(Listener& listener, const std::string& why);
  void acceptListeners();

  std::ostream* const output_;
  const OnLine on_line_;
  std::optional<TcpListener> port_;
  std::list<Listener> listeners_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONSOLE_H
