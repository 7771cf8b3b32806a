#include "simulator/openr_host/objects/system.h"

#include <OPENR/OPENRMessages.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "simulator/openr_host/object_description.h"

namespace openr_host {
namespace {

thread_local System* current_system = nullptr;

void requireSuccess(OStatus status, const std::string& object, const char* function) {
  if (status != oSUCCESS) {
    throw std::runtime_error("object " + object + ": " + function + "() returned " + std::to_string(status) +
                             " instead of oSUCCESS");
  }
}

template <typename Service, typename Id>
Service& findService(const std::vector<Service*>& services, const Id& id, const std::string& object) {
  const auto found =
      std::find_if(services.begin(), services.end(), [&](const Service* service) { return service->id() == id; });
  if (found == services.end()) {
    throw std::runtime_error("object " + object +
                             " has not registered its services: its DoInit() needs NEW_ALL_SUBJECT_AND_OBSERVER and "
                             "REGISTER_ALL_ENTRY");
  }
  return **found;
}

int indexOf(const OServiceEntry& service) {
  return static_cast<int>(service.selector);
}

template <typename Description>
int indexOf(const std::vector<Description>& services, const std::string& name) {
  const auto found = std::find_if(services.begin(), services.end(),
                                  [&](const Description& description) { return description.service == name; });
  return found == services.end() ? -1 : static_cast<int>(found - services.begin());
}

}  // namespace

class System::Running {
 public:
  Running(System& system, const LoadedObject& object)
      : system_(system),
        previous_system_(std::exchange(current_system, &system)),
        previous_object_(std::exchange(system.running_, &object)) {}
  ~Running() {
    system_.running_ = previous_object_;
    current_system = previous_system_;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  System& system_;
  System* previous_system_;
  const LoadedObject* previous_object_;
};

System::System(const std::string& bind_address, const std::string& memory_stick, std::ostream* console_output,
               Console::OnLine on_console_line, VirtualRobot& robot)
    : memory_stick_(memory_stick),
      robot_(robot),
      console_(console_output, std::move(on_console_line)),
      ip_stack_(
          bind_address, [this](const Envelope& answer) { postAnswer(answer); }, [this] { return hasMessages(); }),
      design_data_(memory_stick, robot.design()) {}

System::~System() {
  shutdown();
}

System& System::current() {
  if (current_system == nullptr) {
    throw std::logic_error("this OPEN-R call needs a machine: call it from an object's entry point");
  }
  return *current_system;
}

System* System::currentOrNull() {
  return current_system;
}

const std::string& System::runningObject() const {
  return running_->description.name;
}

OObject& System::create(const ObjectDescription& description) {
  objects_.push_back({description, nullptr});
  LoadedObject& object = objects_.back();
  const Running running(*this, object);
  object.object = description.create();
  object.object->myOID_ = oidOf(objects_.size());
  for (const auto& subject : description.subjects) {
    service_names_.push_back(subject.service);
  }
  for (const auto& observer : description.observers) {
    service_names_.push_back(observer.service);
  }
  return *object.object;
}

void System::initialize() {
  for (auto& object : objects_) {
    const Running running(*this, object);
    requireSuccess(object.object->DoInit(OSystemEvent()), object.description.name, "DoInit");
    object.initialized = true;
  }
}

void System::connect(const std::string& subject_name, const std::string& observer_name) {
  SubjectID subject_id;
  ObserverID observer_id;
  for (std::size_t number = 1; number <= objects_.size(); ++number) {
    const ObjectDescription& description = loaded(oidOf(number)).description;
    const int subject_index = indexOf(description.subjects, subject_name);
    const int observer_index = indexOf(description.observers, observer_name);
    subject_id = subject_index < 0 ? subject_id : SubjectID(oidOf(number), static_cast<Selector>(subject_index));
    observer_id = observer_index < 0 ? observer_id : ObserverID(oidOf(number), static_cast<Selector>(observer_index));
  }
  subject(subject_id).connect(observer_id);
  observer(observer_id).connect(subject_id);

  LoadedObject& sender = loaded(subject_id.oid);
  const auto& control = sender.description.subjects[subject_id.selector].control;
  if (control) {
    const Running running(*this, sender);
    control(*sender.object, OControlEvent(indexOf(subject_id), observer_id));
  }
  LoadedObject& receiver = loaded(observer_id.oid);
  const auto& connected = receiver.description.observers[observer_id.selector].connect;
  if (connected) {
    const Running running(*this, receiver);
    connected(*receiver.object, OConnectEvent(indexOf(observer_id), subject_id));
  }
}

void System::start() {
  handleMessages();
  for (auto& object : objects_) {
    const Running running(*this, object);
    requireSuccess(object.object->DoStart(OSystemEvent()), object.description.name, "DoStart");
    object.started = true;
  }
}

void System::shutdown() noexcept {
  for (auto& object : objects_) {
    if (std::exchange(object.started, false)) {
      const Running running(*this, object);
      object.object->DoStop(OSystemEvent());
    }
    finish(object);
  }
  messages_.clear();
  for (auto& object : objects_) {
    if (std::exchange(object.initialized, false)) {
      const Running running(*this, object);
      object.object->DoDestroy(OSystemEvent());
    }
  }
  messages_.clear();
  objects_.clear();
  robot_.switchOff();
}

void System::runAs(OObject& object, const std::function<void()>& function) {
  const Running running(*this, loaded(object.myOID_));
  function();
}

void System::postReady(const ObserverID& observer, const SubjectID& subject, bool ready) {
  messages_.push_back({subject.oid, Readying{subject, observer, ready}});
}

void System::postNotification(const SubjectID& subject, const ObserverID& observer, Regions data) {
  messages_.push_back({observer.oid, Notification{observer, subject, std::move(data)}});
}

void System::postAnswer(const Envelope& answer) {
  messages_.push_back({answer.object(), answer});
}

void System::deliver(const Readying& message, LoadedObject& receiver) {
  if (message.ready) {
    subject(message.subject).assertReady(message.observer);
  } else {
    subject(message.subject).deassertReady(message.observer);
  }
  if (const auto& function = receiver.description.subjects[message.subject.selector].ready) {
    function(*receiver.object, OReadyEvent(indexOf(message.subject), message.observer, message.ready));
  }
}

void System::deliver(const Notification& message, LoadedObject& receiver) {
  const auto& function = receiver.description.observers[message.observer.selector].notify;
  if (!function) {
    return;
  }
  std::vector<RCRegion*> regions;
  regions.reserve(message.data.size());
  for (const auto& region : message.data) {
    regions.push_back(region.get());
  }
  function(*receiver.object,
           ONotifyEvent(indexOf(message.observer), message.subject, regions.data(), static_cast<int>(regions.size())));
}

void System::deliver(const Envelope& answer, LoadedObject& receiver) {
  receiver.description.extra_entries[answer.entry()](*receiver.object, answer.content());
}

void System::deliver(const PowerChange& change, LoadedObject& receiver) {
  OPowerStatusMessage message(change.status);
  receiver.description.extra_entries[change.entry](*receiver.object, &message);
}

bool System::hasEntry(const OID& object, Selector entry) const {
  const std::size_t number = numberOf(object);
  if (number < 1 || number > objects_.size()) {
    return false;
  }
  const auto& entries = objects_[number - 1].description.extra_entries;
  return entry < entries.size() && entries[entry] != nullptr;
}

bool System::isBusy(const OID& object, std::chrono::nanoseconds now) const {
  return objects_[numberOf(object) - 1].busy_until > now;
}

bool System::hasMessages() const {
  const std::chrono::nanoseconds now = now_();
  return std::any_of(messages_.begin(), messages_.end(),
                     [&](const Message& message) { return !isBusy(message.receiver, now); }) ||
         std::any_of(objects_.begin(), objects_.end(),
                     [&](const LoadedObject& object) { return object.handled && object.busy_until <= now; });
}

bool System::handleMessages() {
  const std::chrono::nanoseconds now = now_();
  for (LoadedObject& object : objects_) {
    if (object.handled && object.busy_until <= now) {
      finish(object);
    }
  }
  if (messages_.empty()) {
    return false;
  }
  std::vector<Message> queued = std::exchange(messages_, std::move(spare_));
  std::vector<Message> left;
  for (auto& message : queued) {
    if (isBusy(message.receiver, now)) {
      left.push_back(std::move(message));
    } else {
      handle(std::move(message));
    }
  }
  const bool has_handled = left.size() < queued.size();
  messages_.insert(messages_.begin(), std::make_move_iterator(left.begin()), std::make_move_iterator(left.end()));
  queued.clear();
  spare_ = std::move(queued);
  return has_handled;
}

void System::handle(Message message) {
  LoadedObject& receiver = loaded(message.receiver);
  const auto first_posted = static_cast<std::ptrdiff_t>(messages_.size());
  {
    const Running running(*this, receiver);
    std::visit([&](const auto& content) { deliver(content, receiver); }, message.content);
  }
  if (!handler_time_ || !std::holds_alternative<Notification>(message.content)) {
    return;
  }
  const std::chrono::nanoseconds duration = handler_time_(receiver.description.name);
  if (duration > std::chrono::nanoseconds(0)) {
    receiver.busy_until = now_() + duration;
    receiver.handled = std::move(message);
    receiver.posted.assign(std::make_move_iterator(messages_.begin() + first_posted),
                           std::make_move_iterator(messages_.end()));
    messages_.erase(messages_.begin() + first_posted, messages_.end());
  }
}

/// Finishes an object's work: what it has posted leaves it, and it gives back the data that it received.
void System::finish(LoadedObject& object) {
  messages_.insert(messages_.end(), std::make_move_iterator(object.posted.begin()),
                   std::make_move_iterator(object.posted.end()));
  object.posted.clear();
  object.handled.reset();
}

std::optional<std::chrono::nanoseconds> System::nextFinish() const {
  std::optional<std::chrono::nanoseconds> next;
  for (const LoadedObject& object : objects_) {
    if (object.handled && (!next || object.busy_until < *next)) {
      next = object.busy_until;
    }
  }
  return next;
}

void System::modelTime(HandlerTime handler_time, std::function<std::chrono::nanoseconds()> now) {
  handler_time_ = std::move(handler_time);
  now_ = std::move(now);
}

OStatus System::observePower(const OPowerStatus& wanted, const OServiceEntry& entry) {
  OPowerStatus present;
  if (!hasEntry(entry.GetOID(), entry.GetSelector())) {
    return oINVALID_ARG;
  }
  const OStatus status = robot_.getPowerStatus(&present);
  if (status == oSUCCESS) {
    unobservePower(entry);
    power_watchers_.push_back({entry, wanted, present});
  }
  return status;
}

OStatus System::unobservePower(const OServiceEntry& entry) {
  const auto end = std::remove_if(power_watchers_.begin(), power_watchers_.end(),
                                  [&](const PowerWatcher& watcher) { return watcher.entry == entry; });
  const bool found = end != power_watchers_.end();
  power_watchers_.erase(end, power_watchers_.end());
  return found ? oSUCCESS : oINVALID_ARG;
}

void System::watchPower() {
  OPowerStatus now;
  if (power_watchers_.empty() || robot_.getPowerStatus(&now) != oSUCCESS) {
    return;
  }
  for (PowerWatcher& watcher : power_watchers_) {
    if (((watcher.seen.robotStatus ^ now.robotStatus) & watcher.wanted.robotStatus) != 0 ||
        ((watcher.seen.batteryStatus ^ now.batteryStatus) & watcher.wanted.batteryStatus) != 0) {
      messages_.push_back({watcher.entry.GetOID(), PowerChange{watcher.entry.GetSelector(), now}});
    }
    watcher.seen = now;
  }
}

System::LoadedObject& System::loaded(const OID& oid) {
  return objects_[numberOf(oid) - 1];
}

void System::forget(const SubjectService& subject) {
  subjects_.erase(std::remove(subjects_.begin(), subjects_.end(), &subject), subjects_.end());
}

void System::forget(const ObserverService& observer) {
  observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end());
}

SubjectService& System::subject(const SubjectID& id) {
  return findService(subjects_, id, loaded(id.oid).description.name);
}

ObserverService& System::observer(const ObserverID& id) {
  return findService(observers_, id, loaded(id.oid).description.name);
}

}  // namespace openr_host
