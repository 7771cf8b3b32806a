#include "simulator/openr_host/machine.h"

#include <dlfcn.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "simulator/openr_host/memory_stick.h"
#include "simulator/openr_host/objects/system.h"
#include "simulator/openr_host/objects/virtual_robot_audio_comm.h"
#include "simulator/openr_host/objects/virtual_robot_comm.h"

namespace openr_host {
namespace {

std::string namesOf(const std::map<std::string, ObjectDescription>& catalog) {
  std::string names;
  for (const auto& entry : catalog) {
    names += (names.empty() ? "" : ", ") + entry.first;
  }
  return names;
}

std::string portProblem(const std::string& bind_address, std::uint16_t robot_port, std::uint16_t host_port, int error) {
  const std::string where = "port " + std::to_string(host_port) + " on " + bind_address;
  const std::string option = robot_port == kConsolePort ? "--console-port" : "--port";
  if (error == EADDRINUSE) {
    return where +
           " is in use by another program, perhaps a second aibo_rcserver: stop that, or choose another port (" +
           option + " NUMBER; 0 = any free one)";
  }
  return where + " cannot be used: " + std::generic_category().message(error) + " (" + option + ", --bind)";
}

/// Loads an object that scripts/openr_object has built: a shared library with the function describeLoadedObject(). The
/// library is unloaded with the last copy of the description, so that the object's static data begins anew at each
/// boot, as on the robot.
/// @throw std::runtime_error the file is no such library; the text names the file and a remedy
ObjectDescription loadObject(const std::string& file) {
  const std::shared_ptr<void> library(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL),
                                      [](void* handle) { handle != nullptr ? dlclose(handle) : 0; });
  void* const symbol = library != nullptr ? dlsym(library.get(), "describeLoadedObject") : nullptr;
  if (symbol == nullptr) {
    throw std::runtime_error(file + ": cannot be loaded (" + dlerror() +
                             "); build it for this computer with scripts/openr_object");
  }
  void (*describe)(ObjectDescription*) = nullptr;
  static_assert(sizeof(describe) == sizeof(symbol), "POSIX requires it");
  std::memcpy(&describe, &symbol, sizeof(describe));
  ObjectDescription description;
  describe(&description);
  description.library = library;
  return description;
}

}  // namespace

Machine::Machine(MachineOptions options, Clock& clock, VirtualRobot& robot)
    : options_(std::move(options)), clock_(clock), robot_(robot), wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!wake_.isOpen()) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

Machine::~Machine() = default;

void Machine::boot() {
  if (system_) {
    throw std::logic_error("this machine has been booted already");
  }
  try {
    load();
  } catch (const std::runtime_error& error) {
    shutdown();
    throw BootError(error.what());
  } catch (...) {
    shutdown();
    throw;
  }
}

void Machine::load() {
  system_ = std::make_unique<System>(options_.bind_address, options_.memory_stick, options_.console, consoleListener(),
                                     robot_);
  system_->modelTime(options_.handler_time, [this] { return clock_.now(); });
  createObjects();
  const auto connections = readConnections();
  takePorts();
  system_->initialize();
  for (const auto& connection : connections) {
    system_->connect(connection.subject.text(), connection.observer.text());
  }
  system_->start();
}

/// Handles the frames that have passed before a typed line, which acts on the present robot.
std::function<std::optional<std::string>(const std::string& line)> Machine::consoleListener() {
  if (!options_.on_console_line) {
    return nullptr;
  }
  return [this](const std::string& line) {
    beginFrame();
    return options_.on_console_line(line);
  };
}

System& Machine::running() const {
  if (!system_) {
    throw std::logic_error("this machine has not been booted");
  }
  return *system_;
}

void Machine::createObjects() {
  robot_comm_ = static_cast<VirtualRobotComm*>(&system_->create(VirtualRobotComm::describe(robot_)));
  audio_comm_ = static_cast<VirtualRobotAudioComm*>(&system_->create(VirtualRobotAudioComm::describe(robot_)));

  const std::string path = findOnMemoryStick(options_.memory_stick, "OPEN-R/MW/CONF/OBJECT.CFG");
  std::istringstream file = openConfiguration(path);
  const auto object_files = readObjectConfiguration(file, path, robot_.design());
  if (object_files.empty()) {
    throw BootError(path + ": there is no object for " + robot_.design());
  }
  for (const auto& object_file : object_files) {
    const auto found = options_.catalog.find(object_file.name);
    if (found != options_.catalog.end()) {
      system_->create(found->second);
      continue;
    }
    const std::string library = "OPEN-R/MW/OBJS/" + object_file.name;
    if (!isOnMemoryStick(options_.memory_stick, library)) {
      throw ConfigurationError(path, object_file.line,
                               object_file.name + " is neither on the memory stick nor an object of this program, " +
                                   "which has " + namesOf(options_.catalog));
    }
    system_->create(loadObject(findOnMemoryStick(options_.memory_stick, library).string()));
  }
}

void Machine::takePorts() {
  for (auto& [robot_port, host_port] : options_.ports) {
    try {
      host_port = robot_port == kConsolePort ? system_->console().takePort(options_.bind_address, host_port)
                                             : system_->ipStack().takePort(robot_port, host_port);
    } catch (const std::system_error& error) {
      throw BootError(portProblem(options_.bind_address, robot_port, host_port, error.code().value()));
    } catch (const std::invalid_argument& error) {
      throw BootError(std::string(error.what()) + " (--bind)");
    }
  }
}

std::vector<ServiceConnection> Machine::readConnections() const {
  const std::string name = "OPEN-R/MW/CONF/CONNECT.CFG";
  if (!isOnMemoryStick(options_.memory_stick, name)) {
    system_->console().print("There is no " + name + ", so no objects are connected\n");
    return {};
  }
  const std::string path = findOnMemoryStick(options_.memory_stick, name);
  std::istringstream file = openConfiguration(path);
  return readConnectionConfiguration(file, path, robot_.design(), system_->serviceNames());
}

void Machine::run() {
  while (!stop_requested_ && isOn()) {
    handle(nextEvent());
  }
}

void Machine::stop() noexcept {
  stop_requested_ = true;
  const int saved_errno = errno;  // the signal may have interrupted any code
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(wake_.get(), &one, sizeof(one));
  errno = saved_errno;
}

void Machine::clearWake() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto size = read(wake_.get(), &count, sizeof(count));
}

void Machine::runPending() {
  while (handle(std::chrono::steady_clock::now()) && isOn()) {
  }
}

bool Machine::runUntil(const std::function<bool()>& done, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!done()) {
    if (std::chrono::steady_clock::now() >= end || !isOn()) {
      return false;
    }
    handle(std::min(end, nextEvent().value_or(end)));
  }
  return true;
}

/// Handles the frame, the messages, then the sockets. If there was nothing else, waits for sockets until `latest`.
/// After messages it does not wait, because the caller of runUntil() may be waiting for them.
/// @return false if there was nothing to handle
bool Machine::handle(const Deadline& latest) {
  const bool had_messages = handleMessages();
  const bool had_sockets = handleSockets(had_messages ? std::chrono::steady_clock::time_point() : latest);
  return had_messages || had_sockets;
}

/// Handles the frame and the messages in the queue.
/// @return false if there was nothing to handle
bool Machine::handleMessages() {
  System& system = running();
  const bool began_frame = beginFrame();
  const bool had_messages = system.handleMessages();
  return began_frame || had_messages || system.hasMessages();
}

/// Waits for sockets until `latest`, then shuts down if an object has asked for it.
/// @return false if no socket was ready
bool Machine::handleSockets(const Deadline& latest) {
  System& system = running();
  poll_set_.clear();
  poll_set_.add(wake_.get(), POLLIN, [this] { clearWake(); });
  system.console().addTo(poll_set_);
  system.ipStack().addTo(poll_set_);
  const bool had_sockets = poll_set_.wait(latest);
  obeyShutdownRequest();
  return had_sockets;
}

void Machine::obeyShutdownRequest() {
  const ShutdownRequest request = system_->shutdownRequest();
  if (request == ShutdownRequest::kNone) {
    return;
  }
  const bool boots_again = request == ShutdownRequest::kBootAgain;
  system_->console().print(boots_again ? "The robot boots again\n" : "The robot shuts down\n");
  shutdown();
  if (boots_again) {
    boot();
  }
}

bool Machine::beginFrame() {
  const longword frame = clock_.frame();
  if (last_frame_ == frame) {
    return false;
  }
  last_frame_ = frame;
  system_->runAs(*robot_comm_, [&] { robot_comm_->beginFrame(frame); });
  system_->runAs(*audio_comm_, [&] { audio_comm_->beginFrame(frame); });
  system_->watchPower();
  return true;
}

/// The next event that comes from no socket. Frames without effect on objects pass later, all at once: waking this
/// thread costs more than a frame of the robot.
Machine::Deadline Machine::nextEvent() const {
  const longword next = last_frame_ && audio_comm_->isActive() ? *last_frame_ + 1 : robot_comm_->nextEvent();
  const Deadline next_frame = clock_.beginOf(last_frame_ ? next : 0);
  const auto next_finish = system_->nextFinish();
  const Deadline end = next_finish ? clock_.timeOf(*next_finish) : next_frame;
  return end && next_frame ? std::min(end, next_frame) : next_frame;
}

void Machine::shutdown() noexcept {
  system_.reset();
}

}  // namespace openr_host
