/// @file pseudo_terminal.h
#ifndef TEST_SUPPORT_PSEUDO_TERMINAL_H
#define TEST_SUPPORT_PSEUDO_TERMINAL_H

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <string>
#include <utility>

namespace test_support {

/// A pseudo terminal, in which somebody types.
class PseudoTerminal {
 public:
  PseudoTerminal() { exists_ = ::openpty(&keys_, &terminal_, name_, nullptr, nullptr) == 0; }
  ~PseudoTerminal() {
    close();
    ::close(terminal_);
  }

  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// False if this system gives none, for example because /dev/pts is not mounted.
  bool exists() const { return exists_; }
  std::string name() const { return name_; }
  int descriptor() const { return terminal_; }

  void type(const std::string& keys) const {
    EXPECT_EQ(::write(keys_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }

  /// The user closes it.
  void close() { ::close(std::exchange(keys_, -1)); }

 private:
  bool exists_ = false;
  int keys_ = -1;
  int terminal_ = -1;
  char name_[64] = {};
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PSEUDO_TERMINAL_H
