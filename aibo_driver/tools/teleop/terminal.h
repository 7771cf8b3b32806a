/// @file terminal.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_TERMINAL_H
#define AIBO_DRIVER_TOOLS_TELEOP_TERMINAL_H

#include <termios.h>

#include <chrono>
#include <optional>

namespace teleop {

/// A terminal whose keys are read one by one without being shown. Ctrl-C still interrupts the program. The destructor
/// restores the terminal.
class Terminal {
 public:
  /// @param descriptor the terminal's descriptor, usually stdin; it stays open
  /// @throw std::runtime_error the descriptor is no terminal, or the terminal cannot be switched; the message says what
  ///   to do
  explicit Terminal(int descriptor);
  ~Terminal();

  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Waits for the next key. A key that sends several bytes is one of the constants in key_steering.h.
  /// @param timeout the longest time to wait; a signal ends it, too
  /// @return empty if no key was pressed in time
  /// @throw std::runtime_error the terminal was closed
  std::optional<char> readKey(std::chrono::milliseconds timeout);

 private:
  std::optional<char> readByte(std::chrono::milliseconds timeout);

  const int descriptor_;
  termios former_settings_{};
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_TERMINAL_H
