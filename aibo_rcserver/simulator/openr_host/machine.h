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
#include "simulator/openr_host/ip_stack/poll_set.h"
#include "simulator/openr_host/ip_stack/socket.h"
#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/processor.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

class System;
class VirtualRobotComm;
struct ServiceConnection;

/// The wireless console's port on the robot (report, section 2.2).
constexpr std::uint16_t kConsolePort = 59000;

/// The memory stick cannot be booted. The text names the file and line, or the port, and says what to do.
class BootError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct MachineOptions {
  /// Address of this computer on which clients may connect; "0.0.0.0" means all of them.
  std::string bind_address = "127.0.0.1";

  /// The port on this computer for each port of the robot; 0 means any free one, see Machine::hostPort(). boot() takes
  /// these ports, after a reboot the same ones again. Any other port has the same number on both sides, and is taken
  /// when an object listens on it.
  std::map<std::uint16_t, std::uint16_t> ports = {{kConsolePort, kConsolePort}};

  /// Folder with the content of the memory stick: OPEN-R/MW/CONF/OBJECT.CFG, in any case; CONNECT.CFG beside it if
  /// objects are connected; DESIGNDB.CFG if one calls FindDesignData().
  std::string memory_stick;

  /// The objects for the files named in OBJECT.CFG, by name in capitals: {"RCSERVER.BIN", describeRCServer()}.
  std::map<std::string, ObjectDescription> catalog;

  /// Receives what the console prints, like the telnet listeners; may be null. Must outlive the machine.
  std::ostream* console = nullptr;

  /// Receives each line that is typed at the console, without its end, and returns the answer to print; none if it is
  /// no command. If empty, typed lines are ignored, as on the robot. Called by the thread that runs the machine; must
  /// not throw.
  std::function<std::optional<std::string>(const std::string& line)> on_console_line;

  /// How long the robot's handlers take; if empty, no time.
  HandlerTime handler_time;

  /// @name For measurements; may be empty. Called by the thread that runs the machine.
  /// @{
  std::function<void()> on_camera_image;                            ///< an image is about to be handed to the objects
  std::function<void(const void* data, std::size_t size)> on_send;  ///< an object is about to send these bytes
  /// @}
};

/// One robot: its objects, their messages, sockets and time, all on the thread that calls these functions. Each message
/// is handled completely before the next one. A thread may have several machines, but run only one at a time.
class Machine {
 public:
  /// @param clock, robot must outlive the machine
  Machine(MachineOptions options, Clock& clock, VirtualRobot& robot);

  /// Calls shutdown().
  ~Machine();

  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// Reads OBJECT.CFG and CONNECT.CFG, takes the ports, creates the objects, calls DoInit of all in the order of
  /// OBJECT.CFG, connects them, calls DoStart of all. After shutdown() a machine may boot again.
  /// @throw BootError; then nothing is left running
  void boot();

  /// Handles events until stop() is called or an object shuts the robot down (OPENR::Shutdown()). In the latter case,
  /// the machine says so on its console and is off, as after shutdown(); or, if the object asked for that, it boots
  /// again, on the same ports and with new objects. This holds for runPending() and runUntil(), too.
  /// @throw BootError if it cannot boot again; then it is off
  void run();

  /// True from boot() until the machine is shut down for any reason.
  bool isOn() const { return system_ != nullptr; }

  /// Makes run() return soon. The only function that may be called from any thread and from a signal handler.
  void stop() noexcept;

  /// Handles everything that is due now, without waiting: the clock's frame, messages, sockets. For tests.
  /// @throw std::logic_error if the machine is off
  void runPending();

  /// Handles events until `done` returns true. For tests that wait for a socket.
  /// @return false if the limit was reached or the machine went off first
  bool runUntil(const std::function<bool()>& done, std::chrono::milliseconds limit = std::chrono::seconds(20));

  /// Calls DoStop, then DoDestroy of all objects, and closes all sockets. Queued messages are dropped.
  void shutdown() noexcept;

  /// The port on this computer for a port of the robot, after boot().
  /// @throw std::out_of_range if MachineOptions::ports does not contain it
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

  MachineOptions options_;  ///< `ports` has the ports that were taken
  Clock& clock_;
  VirtualRobot& robot_;
  std::unique_ptr<System> system_;
  VirtualRobotComm* robot_comm_ = nullptr;
  std::optional<longword> last_frame_;
  FileDescriptor wake_;  ///< readable once stop() has been called
  PollSet poll_set_;
  std::atomic<bool> stop_requested_{false};
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H
