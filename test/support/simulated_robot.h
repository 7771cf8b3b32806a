/// @file simulated_robot.h
#ifndef TEST_SUPPORT_SIMULATED_ROBOT_H
#define TEST_SUPPORT_SIMULATED_ROBOT_H

#include <memory>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/sockets.h"

namespace test_support {

/// The executable aibo_rcserver with a simulated ERS-7, on a free port of 127.0.0.1.
class SimulatedRobot {
 public:
  /// @param options further options of the executable, such as {"--protocol-version", "1"}
  /// @param launcher command that starts the executable and becomes its process, such as {"ip", "netns", "exec", "a"}
  explicit SimulatedRobot(const std::vector<std::string>& options = {}, const std::vector<std::string>& launcher = {})
      : options_(options), launcher_(launcher) {
    start(portOf(bindTo("127.0.0.1", 0)));
  }

  int port() const { return port_; }
  int consolePort() const { return console_port_; }

  /// Types a line at its console, such as "press chin".
  /// @return the answer, "ok: ..." or "error: ..."; empty if none came
  /// @throw std::system_error the console cannot be reached
  std::string type(const std::string& line) const;

  /// Kills it by SIGKILL. Until restart(), no other program gets its port, but nothing listens there.
  /// @throw std::system_error the port cannot be kept
  void kill() {
    process_.reset();
    kept_port_ = bindTo("127.0.0.1", port_);
  }

  /// Starts it again, on the same port. Returns when it listens.
  void restart() { start(port_); }

  bool isRunning() { return process_ && process_->isRunning(); }

  /// Its process; only until kill().
  Process& process() { return *process_; }

 private:
  void start(int port);

  const std::vector<std::string> options_;
  const std::vector<std::string> launcher_;
  int port_ = 0;
  int console_port_ = 0;
  std::unique_ptr<Process> process_;
  host_files::FileDescriptor kept_port_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_SIMULATED_ROBOT_H
