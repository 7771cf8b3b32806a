#include "tools/teleop/terminal.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include "tools/teleop/key_steering.h"

namespace teleop {
namespace {

/// True for the byte that ends the sequence of a special key (ECMA-48, section 5.4).
bool isFinal(char byte) {
  return byte >= '@' && byte <= '~';
}

}  // namespace

Terminal::Terminal(int descriptor) : descriptor_(descriptor) {
  if (::tcgetattr(descriptor_, &former_settings_) != 0) {
    throw std::runtime_error(
        "The keys are read from a terminal, and this program's input is not one. Start it in a terminal of its own: "
        "rosrun aibo_driver aibo_teleop_keyboard");
  }
  termios settings = former_settings_;
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0) {
    throw std::runtime_error(std::string("The terminal cannot be switched to single keys: ") + std::strerror(errno));
  }
}

Terminal::~Terminal() {
  ::tcsetattr(descriptor_, TCSADRAIN, &former_settings_);
}

// An arrow key sends ESC [ A or ESC O A. Such a sequence, read as letters, would make the robot walk: O is a direction.
std::optional<char> Terminal::readKey(std::chrono::milliseconds timeout) {
  constexpr char kEscape = '\x1b';
  constexpr std::chrono::milliseconds kSameKey(20);  // a terminal sends these bytes at once
  const std::optional<char> key = readByte(timeout);
  if (key != kEscape) {
    return key;
  }
  const std::optional<char> introducer = readByte(kSameKey);
  if (introducer != '[' && introducer != 'O') {
    return kOtherSpecialKey;
  }
  std::optional<char> last = readByte(kSameKey);
  const bool is_short = last && isFinal(*last);
  while (last && !isFinal(*last)) {  // a sequence can have numbers and semicolons, as for Delete, or Ctrl with an arrow
    last = readByte(kSameKey);
  }
  constexpr char kArrows[] = {kArrowUp, kArrowDown, kArrowRight, kArrowLeft};  // A to D
  return is_short && *last >= 'A' && *last <= 'D' ? kArrows[*last - 'A'] : kOtherSpecialKey;
}

std::optional<char> Terminal::readByte(std::chrono::milliseconds timeout) {
  pollfd wait{descriptor_, POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) {
    return std::nullopt;
  }
  char key = 0;
  const ssize_t size = ::read(descriptor_, &key, 1);
  if (size < 0 && errno == EINTR) {
    return std::nullopt;
  }
  if (size <= 0) {
    throw std::runtime_error("The terminal was closed.");
  }
  return key;
}

}  // namespace teleop
