/// @file robot_thread.h
#ifndef TEST_SUPPORT_ROBOT_THREAD_H
#define TEST_SUPPORT_ROBOT_THREAD_H

#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <thread>
#include <utility>

#include "protocol/version1.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"
#include "simulator/openr_host/virtual_robot.h"

namespace test_support {

/// The robot's own server, in real time and on a thread of its own. For programs that link the libraries object_catalog
/// and openr_host.
class RobotThread {
 public:
  static constexpr auto kRobotPort = static_cast<std::uint16_t>(protocol::RCSERVER_PORT);

  /// The project's memory stick, and a free port of 127.0.0.1.
  static openr_host::MachineOptions defaultOptions() {
    openr_host::MachineOptions options;
    options.ports = {{kRobotPort, std::uint16_t{0}}};
    options.memory_stick = MEMORY_STICK;
    options.catalog = objectCatalog();
    return options;
  }

  /// Returns when the server listens.
  /// @param robot has to outlive the thread
  /// @param options their `ports` have to name kRobotPort
  /// @param begin what the thread does first
  /// @throw openr_host::BootError, and whatever `begin` throws
  explicit RobotThread(openr_host::VirtualRobot& robot, openr_host::MachineOptions options = defaultOptions(),
                       const std::function<void()>& begin = nullptr)
      : machine_(std::move(options), clock_, robot) {
    std::promise<void> booted;
    std::future<void> result = booted.get_future();
    thread_ = std::thread([this, &begin, booted = std::move(booted)]() mutable { run(begin, &booted); });
    try {
      result.get();
    } catch (...) {
      thread_.join();
      throw;
    }
  }
  ~RobotThread() {
    machine_.stop();
    thread_.join();
  }

  RobotThread(const RobotThread&) = delete;
  RobotThread& operator=(const RobotThread&) = delete;

  /// Where clients connect.
  int port() const { return machine_.hostPort(kRobotPort); }

 private:
  void run(const std::function<void()>& begin, std::promise<void>* booted) {
    try {
      if (begin) {
        begin();
      }
      machine_.boot();
    } catch (...) {
      booted->set_exception(std::current_exception());
      return;
    }
    booted->set_value();
    machine_.run();
    machine_.shutdown();
  }

  openr_host::WallClock clock_;
  openr_host::Machine machine_;
  std::thread thread_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROBOT_THREAD_H
