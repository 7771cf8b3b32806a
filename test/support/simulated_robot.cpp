#include "support/simulated_robot.h"

#include <regex>

#include "support/raw_client.h"
#include "support/safety_net.h"

namespace test_support {

void SimulatedRobot::start(int port) {
  std::vector<std::string> command = launcher_;
  command.insert(command.end(), {AIBO_RCSERVER, "--port", std::to_string(port), "--console-port", "0"});
  command.insert(command.end(), options_.begin(), options_.end());
  kept_port_.close();
  process_ = std::make_unique<Process>(command);
  const auto ports = process_->waitForOutput("Console on [0-9.]+:([0-9]+)\n.*listening on [0-9.]+:([0-9]+)");
  console_port_ = std::stoi(ports.at(1));
  port_ = std::stoi(ports.at(2));
}

std::string SimulatedRobot::type(const std::string& line) const {
  RawClient console(console_port_);
  console.send(line + "\n");
  // The console also prints what the robot's objects print meanwhile.
  const std::regex whole_answer("(ok|error): .*\n");
  std::string heard;
  std::smatch answer;
  while (!std::regex_search(heard, answer, whole_answer)) {
    const auto part = console.receive(kSafetyNet);
    if (!part || part->empty()) {
      break;
    }
    heard.append(part->begin(), part->end());
  }
  return answer.str();
}

}  // namespace test_support
