/// @file processor.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace openr_host {

/// Why an object was called.
enum class Entry {
  kNotify,  ///< data has arrived at an observer
  kReady,   ///< an observer has become ready, or is no longer ready
  kExtra    ///< an `Extra` entry of stub.cfg
};

/// Called after a message was handled. Returns how long the message keeps its object busy, 0 or more.
/// @param object the object's name
/// @param taken the handler's processor time on this computer, without filling camera images
using HandlerTime =
    std::function<std::chrono::nanoseconds(const std::string& object, Entry entry, std::chrono::nanoseconds taken)>;

/// The robot's only processor: which object may run, and how long a handler keeps it busy. Without handler times no
/// object is ever busy. Times count from the creation of the clock.
///
/// An object handles one message at a time (Level2 Reference Guide, chapter 1). Objects of lower scheduling classes
/// wait while one of a higher class runs (Programmer's Guide, section 3.1). In the same class, the object that was
/// called first finishes first; on the robot, they take turns.
class Processor {
 public:
  using Time = std::chrono::nanoseconds;

  /// @param priority from the object's .ocf file, 0..255; its upper four bits are the scheduling class
  /// @param waits handlers wait for a device: they keep the object busy, but not the processor
  void add(OID object, int priority, bool waits = false);

  bool mayRun(OID object, Time now) const;

  /// The object is busy for `duration` from now. This delays busy objects of lower classes.
  void run(OID object, Time now, Time duration);

  /// In the past if the object is not busy.
  Time busyUntil(OID object) const { return taskOf(object).busy_until; }

  /// When the next busy object finishes; empty if none is busy.
  std::optional<Time> nextFinish(Time now) const;

 private:
  struct Task {
    OID object;
    int scheduling_class = 0;
    bool waits = false;
    Time busy_until{0};
  };

  const Task& taskOf(OID object) const;

  std::vector<Task> tasks_;  ///< so few that a search is faster than a tree
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H
