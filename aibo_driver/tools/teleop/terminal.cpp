#include "tools/teleop/terminal.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace teleop {

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

std::optional<char> Terminal::readKey(std::chrono::milliseconds timeout) {
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
