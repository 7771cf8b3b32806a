/// @file soak.h
#ifndef TEST_SOAK_SOAK_H
#define TEST_SOAK_SOAK_H

#include <chrono>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mishaps.h"
#include "options.h"
#include "picture_watch.h"
#include "request_tap.h"
#include "resource_log.h"
#include "support/memory_stick.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/simulated_robot.h"
#include "violations.h"
#include "workload.h"

namespace soak {

/// Runs the driver's node and the robot's server for a long time, with a proxy between them. Calm periods, in which
/// users do all that they can, and faults take turns. Needs a running ROS master and a spinner.
class Soak {
 public:
  /// Starts them.
  explicit Soak(const Options& options);

  /// Runs until the time is over, and prints the results.
  /// @return true if there was no violation
  bool run();

 private:
  struct Tally {
    unsigned tried = 0;
    std::vector<double> recoveries{};  // s
  };

  test_support::FaultProxy::Options proxyOptions();
  void awaitFirstPicture();
  void stayCalm();
  void goWrong(const Mishap& mishap);
  void awaitTrajectory();
  void recover(const Mishap& mishap, PictureAudit::Time healthy);
  void expectNoJointMoves(std::size_t connections_before, std::chrono::milliseconds settling);
  void pass(std::chrono::milliseconds time);
  void look();
  void keepDriverLog();
  void judgeLosses();
  void endDriver();
  ResourceLog::Seconds elapsed() const;
  void report() const;

  const Options options_;
  Random random_;
  Violations violations_;
  RequestTap tap_;
  PictureWatch pictures_;
  const test_support::MemoryStick memory_stick_{"ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\n"};
  test_support::SimulatedRobot robot_;
  test_support::FaultProxy proxy_;
  test_support::DriverProcess driver_;
  Workload workload_;
  const std::vector<Mishap> mishaps_ = allMishaps();
  std::map<std::string, Tally> tallies_;
  unsigned faults_ = 0;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point next_look_ = begin_;
  ResourceLog driver_resources_;
  ResourceLog robot_resources_;
  std::ofstream table_;
  std::ofstream driver_log_;
  std::size_t driver_log_size_ = 0;
  test_support::DiagnosticsListener diagnostics_;
};

}  // namespace soak

#endif  // TEST_SOAK_SOAK_H
