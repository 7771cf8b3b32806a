/// @file test_system.h
#ifndef TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_SYSTEM_H
#define TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_SYSTEM_H

#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <gtest/gtest.h>

#include <chrono>

#include "fake_robot.h"
#include "simulator/openr_host/objects/system.h"
#include "support/safety_net.h"

namespace openr_host {

/// An object with the subject "NAME.Out.Data.S", the observer "NAME.In.Data.O" and an entry for answers. Tests set what
/// it does.
class TestObject : public OObject {
 public:
  static constexpr Selector kEntry = 0;

  static ObjectDescription describe(const std::string& name) {
    ObjectDescription description;
    description.name = name;
    description.subjects.push_back({name + ".Out.Data.S", nullptr, [](OObject& object, const OReadyEvent& event) {
                                      static_cast<TestObject&>(object).on_ready(event);
                                    }});
    description.observers.push_back({name + ".In.Data.O", nullptr, [](OObject& object, const ONotifyEvent& event) {
                                       static_cast<TestObject&>(object).on_notify(event);
                                     }});
    description.extra_entries.push_back(
        [](OObject& object, ANTENVMSG message) { static_cast<TestObject&>(object).on_answer(message); });
    description.create = [] { return std::make_unique<TestObject>(); };
    return description;
  }

  std::function<void(const OReadyEvent&)> on_ready = [](const OReadyEvent&) {};
  std::function<void(const ONotifyEvent&)> on_notify = [](const ONotifyEvent&) {};
  std::function<void(ANTENVMSG)> on_answer = [](ANTENVMSG) {};

  OSubject& subject() { return *subject_; }
  OObserver& observer() { return *observer_; }
  OID id() const { return myOID_; }
  ObserverID observerId() const { return {myOID_, kEntry}; }

  OStatus DoInit(const OSystemEvent& /*event*/) override {
    subject_ = std::make_unique<OSubject>();
    subject_->Register(myOID_, kEntry);
    observer_ = std::make_unique<OObserver>();
    observer_->Register(myOID_, kEntry);
    return oSUCCESS;
  }

  OStatus DoDestroy(const OSystemEvent& /*event*/) override {
    subject_.reset();
    observer_.reset();
    return oSUCCESS;
  }

 private:
  std::unique_ptr<OSubject> subject_;
  std::unique_ptr<OObserver> observer_;
};

/// A system of test objects, which the test runs.
class TestSystem {
 public:
  /// @param stick_folder the memory stick; empty means none
  explicit TestSystem(std::string stick_folder = "") : memory_stick(std::move(stick_folder)) {}

  TestObject& add(const std::string& name) {
    return static_cast<TestObject&>(system.create(TestObject::describe(name)));
  }

  void boot(const std::vector<std::pair<std::string, std::string>>& connections = {}) {
    system.initialize();
    for (const auto& connection : connections) {
      system.connect(connection.first + ".Out.Data.S", connection.second + ".In.Data.O");
    }
    system.start();
  }

  /// Calls a function as if an object were running it, for calls that only objects may make.
  void as(OObject& object, const std::function<void()>& function) { system.runAs(object, function); }

  /// Handles messages until there are none. No sockets.
  void run() {
    while (system.hasMessages()) {
      system.handleMessages();
    }
  }

  /// Sends regions in one notification.
  void send(TestObject& sender, const std::vector<RegionReference>& regions) {
    as(sender, [&] {
      for (const RegionReference& region : regions) {
        sender.subject().SetData(region.get());
      }
      sender.subject().NotifyObservers();
    });
    run();
  }

  /// Handles messages and sockets until `done` returns true.
  /// @param limit in case of an error
  /// @return false if the limit was reached
  bool runUntil(const std::function<bool()>& done, std::chrono::seconds limit = test_support::kSafetyNet) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) {
        return false;
      }
      round(std::chrono::milliseconds(1));
    }
    return true;
  }

  /// Handles messages and sockets until there is nothing left to do.
  void runPending() {
    while (round(std::chrono::milliseconds(0))) {
    }
  }

  FakeRobot robot;
  std::ostringstream output;
  std::function<std::optional<std::string>(const std::string&)> on_console_line;  ///< answers typed lines
  const std::string memory_stick;
  System system{"127.0.0.1", memory_stick, &output, [this](const std::string& line) { return onConsoleLine(line); },
                robot};

 private:
  std::optional<std::string> onConsoleLine(const std::string& line) const {
    return on_console_line ? on_console_line(line) : "";
  }

  bool round(std::chrono::milliseconds patience) {
    const bool had_messages = system.hasMessages();
    system.handleMessages();
    PollSet poll_set;
    system.console().addTo(poll_set);
    system.ipStack().addTo(poll_set);
    const auto wait = system.hasMessages() ? std::chrono::milliseconds(0) : patience;
    return poll_set.wait(std::chrono::steady_clock::now() + wait) || had_messages;
  }
};

/// A system with a gate to the robot. A test lets frames pass.
template <typename Gate>
class GateTest : public testing::Test {
 protected:
  void pass(longword frames) {
    for (longword i = 0; i < frames; ++i) {
      ++frame_;
      test_.as(gate_, [&] { gate_.beginFrame(frame_); });
      test_.run();
    }
  }

  /// The region of a new vector.
  template <typename Vector>
  static RegionReference regionOf(MemoryRegionID id, Vector* vector) {
    auto* const region = new RCRegion(id, vector->vectorInfo.offset, vector, vector->vectorInfo.totalSize);
    RegionReference result = reference(region);
    region->RemoveReference();
    return result;
  }

  TestSystem test_;
  Gate& gate_ = static_cast<Gate&>(test_.system.create(Gate::describe(test_.robot)));
  longword frame_ = 99;  ///< the last one that has passed
};

}  // namespace openr_host

#endif  // TEST_UNIT_SIMULATOR_OPENR_HOST_TEST_SYSTEM_H
