#include "support/simulated_robot.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <regex>
#include <string>
#include <vector>

namespace test_support {
namespace {

constexpr std::chrono::seconds kPatience{30};

}  // namespace

void SimulatedRobot::start(int port) {
  std::vector<std::string> command{AIBO_RCSERVER, "--port", std::to_string(port), "--console-port", "0"};
  command.insert(command.end(), options_.begin(), options_.end());
  process_ = std::make_unique<Process>(command);
  const auto ports = process_->waitForOutput("Console on [0-9.]+:([0-9]+)\n.*listening on [0-9.]+:([0-9]+)", kPatience);
  console_port_ = std::stoi(ports.at(1));
  port_ = std::stoi(ports.at(2));
}

std::string SimulatedRobot::type(const std::string& line) const {
  const int console = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(console_port_));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const timeval patience{kPatience.count(), 0};
  ::setsockopt(console, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  std::string heard;
  std::smatch answer;
  const std::string typed = line + "\n";
  if (::connect(console, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
      ::send(console, typed.data(), typed.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(typed.size())) {
    // What the robot's objects print meanwhile comes, too.
    const std::regex whole_answer("(ok|error): .*\n");
    char character = 0;
    while (!std::regex_search(heard, answer, whole_answer) && ::recv(console, &character, 1, 0) == 1) {
      heard += character;
    }
  }
  ::close(console);
  return answer.str();
}

}  // namespace test_support
