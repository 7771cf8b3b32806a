/// @file machine.h
/// OPEN-R on Linux: boots the objects of a memory stick and runs them.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/processor.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// The wireless console's port on the robot (report, section 2.2).
constexpr std::uint16_t kConsolePort = 59000;

/// The memory stick cannot be booted. The text names the file and line, or the port, and says what to do.
class BootError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct MachineOptions {
  /// Address of this computer that clients may connect to; "0.0.0.0" is all of them.
  std::string bind_address = "127.0.0.1";

  /// From a port of the robot to the port it has on this computer; 0 is any free one, see Machine::hostPort(). These
  /// are taken by boot(), the same ones each time. A port that does not stand here is the same on both, and taken when
  /// an object listens on it.
  std::map<std::uint16_t, std::uint16_t> ports = {{kConsolePort, kConsolePort}};

  /// Folder that holds what the robot has on its memory stick: OPEN-R/MW/CONF/OBJECT.CFG, whatever the case of
  /// these names; CONNECT.CFG beside it, if objects are connected; DESIGNDB.CFG, if one calls FindDesignData().
  std::string memory_stick;

  /// What each file named in OBJECT.CFG is on Linux, by its name in capitals: {"RCSERVER.BIN", describeRCServer()}.
  std::map<std::string, ObjectDescription> catalog;

  /// Gets what the console prints, besides the telnet listeners; null is nowhere. Must outlive the machine.
  std::ostream* console = nullptr;

  /// Gets each line that is typed at the console, without its end, and returns the answer for who typed it. Empty: what
  /// is typed is ignored, as by the robot. Called by the thread that runs the machine; must not throw.
  std::function<std::string(const std::string& line)> on_console_line;

  /// How long the robot needs for what this computer does in no time; empty: no time.
  HandlerTime handler_time;

  /// @name For who measures; may be empty. Called by the thread that runs the machine.
  /// @{
  std::function<void()> on_camera_image;                            ///< an image is handed to the objects now
  std::function<void(const void* data, std::size_t size)> on_send;  ///< an object sends these bytes; none has left yet
  /// @}
};

/// One robot: its objects, their messages, sockets and time, all on the one thread that calls these functions. Each
/// message is handled to its end before the next one. One thread may have several machines, one at a time running.
class Machine {
 public:
  /// @param clock, robot must outlive the machine
  Machine(MachineOptions options, Clock& clock, VirtualRobot& robot);

  /// Calls shutdown().
  ~Machine();

  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// Reads OBJECT.CFG and CONNECT.CFG, takes the ports, makes the objects, calls DoInit of all in the order of
  /// OBJECT.CFG, connects them, calls DoStart of all. After shutdown() a machine may boot again.
  /// @throw BootError; nothing is left running then
  void boot();

  /// Handles what comes until stop() is called or an object shuts the robot down (OPENR::Shutdown()). The machine is
  /// off then, as after shutdown(), and its console has said so. If the object asked for it, the machine boots again
  /// instead: on the same ports, with new objects. The same holds for the two functions for tests below.
  /// @throw BootError if it cannot boot again; it is off then
  void run();

  /// From boot() on, until whatever ends it.
  bool isOn() const;

  /// Makes run() return soon. The one function that may be called from any thread and from a signal handler.
  void stop() noexcept;

  /// Handles everything that is to be done now, without waiting: the clock's frame, messages, sockets. For tests.
  /// @throw std::logic_error if the machine is off
  void runPending();

  /// Handles what comes until `done` says so. For tests that wait for a socket.
  /// @param limit safety net
  /// @return false if the limit was reached or the machine went off before
  bool runUntil(const std::function<bool()>& done, std::chrono::milliseconds limit = std::chrono::seconds(20));

  /// DoStop of all objects, DoDestroy of all, all sockets closed. What is still queued is dropped.
  void shutdown() noexcept;

  /// The port on this computer that stands for a port of the robot, after boot().
  /// @throw std::out_of_range if MachineOptions::ports does not name it
  std::uint16_t hostPort(std::uint16_t robot_port) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MACHINE_H
