/// @file system.h
/// Behind the SDK's classes and calls: a robot's objects and their messages.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_SYSTEM_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_SYSTEM_H

#include <OPENR/OObject.h>

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/console.h"
#include "simulator/openr_host/ip_stack/ip_stack.h"
#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/object_memory.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

enum class ShutdownRequest { kNone, kStayOff, kBootAgain };

/// The system's inside, for openr_host only. Machine is the public interface.
class System {
 public:
  /// @param memory_stick see DesignData
  /// @param console_output, on_console_line see Console
  System(const std::string& bind_address, const std::string& memory_stick, std::ostream* console_output,
         Console::OnLine on_console_line, VirtualRobot& robot);
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// The system of the object that is running on this thread.
  /// @throw std::logic_error no object is running
  static System& current();
  /// The same; null if no object is running.
  static System* currentOrNull();

  Console& console() { return console_; }
  IpStack& ipStack() { return ip_stack_; }
  VirtualRobot& robot() { return robot_; }
  VectorMemory& vectorMemory() { return vector_memory_; }
  DesignData& designData() { return design_data_; }
  /// The folder of the memory stick.
  const std::string& memoryStick() const { return memory_stick_; }

  /// Makes handling take time from now on.
  /// @param now returns the time since the creation of the machine's clock
  void modelTime(HandlerTime handler_time, std::function<std::chrono::nanoseconds()> now);

  /// Carries out OPENR::ObservePowerStatus() (Level2 Reference Guide, page 79). Only robotStatus and batteryStatus are
  /// watched, because nobody asks for the rest.
  OStatus observePower(const OPowerStatus& wanted, const OServiceEntry& entry);
  OStatus unobservePower(const OServiceEntry& entry);

  /// Tells observers what has changed in the power status since the last call.
  void watchPower();

  const std::string& runningObject() const;

  /// Life of the objects.
  OObject& create(const ObjectDescription& description);
  /// All objects' services.
  const std::vector<std::string>& serviceNames() const { return service_names_; }
  /// Calls DoInit() of all objects.
  /// @throw std::runtime_error an object fails; the text names it
  void initialize();
  /// Connects two gates, and calls their functions in stub.cfg.
  /// @param subject, observer from serviceNames()
  /// @throw std::runtime_error an object has not registered its services
  void connect(const std::string& subject, const std::string& observer);
  /// Calls DoStart() of all objects. First it handles the messages that the objects were sent when they were connected.
  /// So the effectors and the speaker are ready in DoStart(), from which Sony's samples send data.
  /// @throw std::runtime_error an object fails; the text names it
  void start();
  /// Carries out OPENR::Shutdown(). It has no effect until the machine reads shutdownRequest().
  void requestShutdown(bool boot_again) {
    shutdown_requested_ = boot_again ? ShutdownRequest::kBootAgain : ShutdownRequest::kStayOff;
  }
  ShutdownRequest shutdownRequest() const { return shutdown_requested_; }
  /// Stops the started objects, destroys the initialised ones, drops all messages, and switches the robot off.
  void shutdown() noexcept;
  /// Calls a function as if the object were running it.
  void runAs(OObject& object, const std::function<void()>& function);

  /// Messages.
  /// Queues the message that an observer is ready, or no longer ready.
  void postReady(const ObserverID& observer, const SubjectID& subject, bool ready);
  void postNotification(const SubjectID& subject, const ObserverID& observer, Regions data);
  /// Queues the IPStack's answer for the object that asked.
  void postAnswer(const Envelope& answer);
  /// True if the object has this `Extra` entry.
  bool hasEntry(const OID& object, Selector entry) const;
  bool hasMessages() const;
  /// Handles the messages in the queue. Later messages and those of busy objects wait.
  /// @return false if there was no message to handle
  bool handleMessages();
  std::chrono::nanoseconds now() const { return now_(); }
  /// When the next busy object finishes.
  std::optional<std::chrono::nanoseconds> nextFinish() const;

  /// Registers a gate, an OSubject or OObserver, until its destructor calls forget().
  void add(SubjectService& subject) { subjects_.push_back(&subject); }
  void add(ObserverService& observer) { observers_.push_back(&observer); }
  void forget(const SubjectService& subject);
  void forget(const ObserverService& observer);

 private:
  /// The contents of messages.
  struct Readying {
    SubjectID subject;
    ObserverID observer;
    bool ready;
  };
  struct Notification {
    ObserverID observer;
    SubjectID subject;
    Regions data;
  };
  struct PowerChange {
    Selector entry;
    OPowerStatus status;
  };

  struct PowerWatcher {
    OServiceEntry entry;
    OPowerStatus wanted;
    OPowerStatus seen;
  };

  struct Message {
    OID receiver;
    std::variant<Readying, Notification, Envelope, PowerChange> content;
  };

  struct LoadedObject {
    ObjectDescription description;
    std::unique_ptr<OObject> object;
    bool initialized = false;
    bool started = false;
    std::chrono::nanoseconds busy_until{0};
    std::optional<Message> handled{};  ///< the message that keeps the object busy, whose data it still has
    std::vector<Message> posted{};     ///< the messages that the object has posted meanwhile
  };

  /// Marks an object as running while this marker exists.
  class Running;

  LoadedObject& loaded(const OID& oid);
  bool isBusy(const OID& object, std::chrono::nanoseconds now) const;
  void finish(LoadedObject& object);
  void handle(Message message);
  void deliver(const Readying& message, LoadedObject& receiver);
  void deliver(const Notification& message, LoadedObject& receiver);
  void deliver(const Envelope& answer, LoadedObject& receiver);
  void deliver(const PowerChange& change, LoadedObject& receiver);
  SubjectService& subject(const SubjectID& id);
  ObserverService& observer(const ObserverID& id);

  const std::string memory_stick_;
  VirtualRobot& robot_;
  Console console_;
  IpStack ip_stack_;
  VectorMemory vector_memory_;
  DesignData design_data_;
  std::deque<LoadedObject> objects_;  ///< in the order of creation
  std::vector<std::string> service_names_;
  std::vector<SubjectService*> subjects_;
  std::vector<ObserverService*> observers_;
  std::vector<Message> messages_;
  std::vector<Message> spare_;  ///< always empty; keeps memory for messages_
  std::vector<PowerWatcher> power_watchers_;
  HandlerTime handler_time_;  ///< if empty, handlers take no time
  std::function<std::chrono::nanoseconds()> now_ = [] { return std::chrono::nanoseconds(0); };
  const LoadedObject* running_ = nullptr;
  ShutdownRequest shutdown_requested_ = ShutdownRequest::kNone;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_SYSTEM_H
