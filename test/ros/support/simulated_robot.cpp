#include "simulated_robot.h"

#include <string>
#include <vector>

namespace test_support {

void SimulatedRobot::start(int port) {
  std::vector<std::string> command{AIBO_RCSERVER, "--port", std::to_string(port), "--no-console"};
  command.insert(command.end(), options_.begin(), options_.end());
  process_ = std::make_unique<Process>(command);
  port_ = std::stoi(process_->waitForOutput("listening on [0-9.]+:([0-9]+)", std::chrono::seconds(30)).at(1));
}

}  // namespace test_support
