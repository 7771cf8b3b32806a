#include "simulated_robot.h"

#include <string>

namespace test_support {

void SimulatedRobot::start(int port) {
  process_ = std::make_unique<Process>(
      std::vector<std::string>{AIBO_RCSERVER, "--port", std::to_string(port), "--no-console"});
  port_ = std::stoi(process_->waitForOutput("listening on [0-9.]+:([0-9]+)", std::chrono::seconds(30)).at(1));
}

}  // namespace test_support
