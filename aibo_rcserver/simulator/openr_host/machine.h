/// @file machine.h
/// OPEN-R on Linux: boots the objects of a memory stick and runs them.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/console.h"
#include "simulator/openr_host/ip_stack/poll_set.h"
#include "simulator/openr_host/ip_stack/socket.h"
#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

class System;
class VirtualRobotAudioComm;
class VirtualRobotComm;
struct ServiceConnection;

/// Thrown if the memory stick cannot be booted. The text names the file and line, or the port, and a remedy.
class BootError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct MachineOptions {
  /// The address of this computer for clients. "0.0.0.0" means all addresses.
  std::string bind_address = "127.0.0.1";

  /// For each port of the robot, the port of this computer; 0 means any free one (Machine::hostPort()). boot() opens
  /// these ports for TCP, and the same ones after a reboot. Any other port, and UDP, opens when an object listens on it
  /// or binds it; UDP has the numbers given here, too. Any other port has the same number on both sides.
  std::map<std::uint16_t, std::uint16_t> ports = {{kConsolePort, kConsolePort}};

  /// The folder of the memory stick, with OPEN-R/MW/CONF/OBJECT.CFG in any case. Connected objects need CONNECT.CFG
  /// beside it, and FindDesignData() needs DESIGNDB.CFG.
  std::string memory_stick;

  /// The objects for the files in OBJECT.CFG, by name in capitals: {"RCSERVER.BIN", describeRCServer()}. Other objects
  /// are loaded from OPEN-R/MW/OBJS on the memory stick.
  std::map<std::string, ObjectDescription> catalog;

  /// The stream for what the console prints. It may be null, and must outlive the machine.
  std::ostream* console = nullptr;

  /// Called with each line typed at the console, without its end. It returns the answer, which is empty if there is no
  /// such command. Without a function, typed lines are ignored, as on the robot. The thread that runs the machine calls
  /// it, and it must not throw.
  std::function<std::optional<std::string>(const std::string& line)> on_console_line;

  /// How long objects take; if empty, no time. A busy object gets no message (Level2 Reference Guide, chapter 1), and
  /// what it has sent leaves it when it has finished. Meanwhile all other objects run, as those of a higher scheduling
  /// class do.
  HandlerTime handler_time;
};

/// A robot: its objects, messages, sockets and time. Everything runs on the thread that calls these functions. Each
/// message is handled completely before the next one. A thread may have several machines, but run only one at a time.
class Machine {
 public:
  /// @param clock, robot must outlive the machine
  Machine(MachineOptions options, Clock& clock, VirtualRobot& robot);

  ~Machine();

  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// Reads OBJECT.CFG and CONNECT.CFG, opens the ports, and creates the objects. Calls DoInit of all objects in the
  /// order of OBJECT.CFG, connects them, and calls DoStart of all. After shutdown(), boot() may be called again.
  /// @throw BootError the boot failed, and nothing is left running
  void boot();

  /// Handles events until stop(), or until an object shuts the robot down (OPENR::Shutdown()). The console reports the
  /// latter, and the machine is off, or boots again on the same ports with new objects, as the object requested. The
  /// same holds for runPending() and runUntil().
  /// @throw BootError the machine cannot boot again, and is off
  void run();

  bool isOn() const { return system_ != nullptr; }

  /// Makes run() return soon. Any thread and any signal handler may call this function, but no other.
  void stop() noexcept;

  /// Handles what is due, without waiting: the clock's frame, messages, sockets. It is meant for tests.
  /// @throw std::logic_error the machine is off
  void runPending();

  /// Handles events until `done` returns true. It is meant for tests that wait for a socket.
  /// @return false if the limit was reached or the machine went off first
  bool runUntil(const std::function<bool()>& done, std::chrono::milliseconds limit = std::chrono::seconds(20));

  /// Calls DoStop, then DoDestroy of all objects, and closes all sockets. Drops queued messages.
  void shutdown() noexcept;

  /// The port of this computer for a port of the robot. Call this after boot().
  /// @throw std::out_of_range the port is not in MachineOptions::ports
  std::uint16_t hostPort(std::uint16_t robot_port) const { return options_.ports.at(robot_port); }

 private:
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  void load();
  void createObjects();
  std::vector<ServiceConnection> readConnections() const;
  void takePorts();
  System& running() const;
  void clearWake();
  bool beginFrame();
  std::function<std::optional<std::string>(const std::string& line)> consoleListener();
  bool handle(const Deadline& latest);
  bool handleMessages();
  bool handleSockets(const Deadline& latest);
  void obeyShutdownRequest();
  Deadline nextEvent() const;

  MachineOptions options_;  ///< `ports` has the ports that were opened
  Clock& clock_;
  VirtualRobot& robot_;
  std::unique_ptr<System> system_;
  VirtualRobotComm* robot_comm_ = nullptr;
  VirtualRobotAudioComm* audio_comm_ = nullptr;
  std::optional<longword> last_frame_;
  FileDescriptor wake_;  ///< readable after stop()
  PollSet poll_set_;
  std::atomic<bool> stop_requested_{false};
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H
