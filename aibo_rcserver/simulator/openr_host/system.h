/// @file system.h
/// What the SDK's classes and calls find behind them: one robot's objects and the messages between them.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_SYSTEM_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_SYSTEM_H

#include <OPENR/OObject.h>

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/openr_host/console.h"
#include "simulator/openr_host/ip_stack/ip_stack.h"
#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/object_memory.h"
#include "simulator/openr_host/objects/power_watch.h"
#include "simulator/openr_host/processor.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

enum class ShutdownRequest { kNone, kStayOff, kBootAgain };

/// Internal to openr_host; Machine is its outside.
class System {
 public:
  /// @param memory_stick as DesignData
  /// @param console_output, on_console_line as Console
  /// @param on_send as IpStack
  System(const std::string& bind_address, const std::string& memory_stick, std::ostream* console_output,
         Console::OnLine on_console_line, VirtualRobot& robot, IpStack::OnSend on_send);
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// The system whose object is being called on this thread.
  /// @throw std::logic_error if there is none
  static System& current();
  static System* currentOrNull();

  Console& console() { return console_; }
  IpStack& ipStack() { return ip_stack_; }
  VirtualRobot& robot() { return robot_; }
  VectorMemory& vectorMemory() { return vector_memory_; }
  DesignData& designData() { return design_data_; }

  /// From now on messages keep objects busy.
  /// @param now time since the machine's clock was made
  void modelTime(HandlerTime handler_time, std::function<Processor::Time()> now);

  PowerWatch& powerWatch() { return power_watch_; }

  /// Tells the objects that observe the power what has changed since this was called last.
  void watchPower();

  /// Name of the object that is being called.
  const std::string& runningObject() const;

  /// @name Life of the objects
  /// @{
  OObject& create(const ObjectDescription& description);
  const std::vector<std::string>& serviceNames() const { return service_names_; }
  /// @throw std::runtime_error if an object does not succeed; the text names it
  void initialize();
  /// @param subject, observer service names that serviceNames() holds
  /// @throw std::runtime_error if an object has not registered its services
  void connect(const std::string& subject, const std::string& observer);
  /// @throw std::runtime_error as initialize()
  void start();
  /// What an object asked for by OPENR::Shutdown().
  void requestShutdown(bool boot_again) {
    shutdown_requested_ = boot_again ? ShutdownRequest::kBootAgain : ShutdownRequest::kStayOff;
  }
  ShutdownRequest shutdownRequest() const { return shutdown_requested_; }
  /// Stops and destroys the objects that have come so far, drops what is queued, and switches the robot off.
  void shutdown() noexcept;
  /// Calls something as the object it belongs to.
  void runAs(OObject& object, const std::function<void()>& function);
  /// @}

  /// @name Messages
  /// @{
  void postReady(const ObserverID& observer, const SubjectID& subject, bool ready);
  void postNotification(const SubjectID& subject, const ObserverID& observer, const Regions& data);
  void postAnswer(const Envelope& answer);
  bool hasEntry(const OID& object, Selector entry) const;
  /// True if there is a message that can be handled now.
  bool hasMessages() const;
  /// Handles the messages that are queued now, each to its end, but not those that come meanwhile, nor those whose
  /// objects are busy.
  void handleMessages();
  /// When an object that is busy now has finished.
  std::optional<Processor::Time> nextFinish() const { return processor_.nextFinish(now_()); }
  /// @}

  /// @name For OSubject and OObserver
  /// @{
  void add(SubjectService& subject) { subjects_.push_back(&subject); }
  void add(ObserverService& observer) { observers_.push_back(&observer); }
  void forget(const SubjectService& subject);
  void forget(const ObserverService& observer);
  /// @}

 private:
  struct LoadedObject {
    ObjectDescription description;
    std::unique_ptr<OObject> object;
    bool initialized = false;
    bool started = false;
  };

  struct Message {
    OID receiver;
    Entry entry;
    std::function<void(LoadedObject&)> handle;
    OID held_by = {};  ///< the object that has posted it and has not finished yet
  };

  /// While one of these lives, it is this object that is being called.
  class Running;

  LoadedObject& loaded(const OID& oid);
  /// True while the object that has posted the message is busy.
  bool isHeld(const Message& message, Processor::Time now) const;
  void handle(Message message);
  SubjectService& subject(const SubjectID& id);
  ObserverService& observer(const ObserverID& id);

  VirtualRobot& robot_;
  Console console_;
  IpStack ip_stack_;
  VectorMemory vector_memory_;
  DesignData design_data_;
  std::deque<LoadedObject> objects_;  ///< in the order of their making
  std::vector<std::string> service_names_;
  std::vector<SubjectService*> subjects_;
  std::vector<ObserverService*> observers_;
  std::deque<Message> messages_;
  std::vector<Message> unfinished_;  ///< whose objects are busy with them
  PowerWatch power_watch_;
  Processor processor_;
  HandlerTime handler_time_;  ///< empty: handlers take no time
  std::function<Processor::Time()> now_ = [] { return Processor::Time(0); };
  const LoadedObject* running_ = nullptr;
  ShutdownRequest shutdown_requested_ = ShutdownRequest::kNone;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_SYSTEM_H
