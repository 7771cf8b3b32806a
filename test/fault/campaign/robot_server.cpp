#include "campaign/robot_server.h"

#include <atomic>
#include <future>
#include <map>
#include <thread>

#include "campaign/syscalls.h"
#include "protocol/version1.h"
#include "simulator/ers7/simulated_ers7.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {

class RobotServer::Implementation {
 public:
  explicit Implementation(int mark) {
    std::promise<int> port;
    thread_ = std::thread([this, mark, &port] { run(mark, &port); });
    port_ = port.get_future().get();
  }

  ~Implementation() {
    machine_->stop();
    thread_.join();
  }

  int port() const { return port_; }

  std::uint32_t frame() const { return clock_.frame(); }

  milliseconds takeLongestImageGap() { return milliseconds(longest_gap_.exchange(0)); }

 private:
  // A machine belongs to the thread that made it.
  void run(int mark, std::promise<int>* port) {
    simulated_ers7::SimulatedErs7 robot;
    openr_host::MachineOptions options;
    constexpr auto kRobotPort = static_cast<std::uint16_t>(protocol::RCSERVER_PORT);
    options.ports = {{kRobotPort, 0}};
    options.memory_stick = MEMORY_STICK;
    options.catalog = objectCatalog();
    options.on_camera_image = [this] { noteImage(); };
    openr_host::Machine machine(options, clock_, robot);
    try {
      machine.boot();
    } catch (...) {
      port->set_exception(std::current_exception());
      return;
    }
    machine_ = &machine;
    syscalls::markThisThread(mark);
    port->set_value(machine.hostPort(kRobotPort));
    machine.run();
    machine.shutdown();
  }

  void noteImage() {
    const TimePoint now = steady_clock::now();
    const auto gap = std::chrono::duration_cast<milliseconds>(now - last_image_).count();
    if (last_image_ != TimePoint() && gap > longest_gap_) {
      longest_gap_ = gap;
    }
    last_image_ = now;
  }

  openr_host::WallClock clock_;
  openr_host::Machine* machine_ = nullptr;
  int port_ = 0;
  TimePoint last_image_;  // used by the machine's thread alone
  std::atomic<milliseconds::rep> longest_gap_{0};
  std::thread thread_;
};

RobotServer::RobotServer(int mark) : implementation_(std::make_unique<Implementation>(mark)) {}

RobotServer::~RobotServer() = default;

int RobotServer::port() const {
  return implementation_->port();
}

std::uint32_t RobotServer::frame() const {
  return implementation_->frame();
}

milliseconds RobotServer::takeLongestImageGap() {
  return implementation_->takeLongestImageGap();
}

}  // namespace fault_bench
