/// @file processor.h
/// The robot's only processor: which object may run, and how long a handler keeps its object busy.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace openr_host {

/// The reason for which an object was called.
enum class Entry {
  kNotify,  ///< data has arrived at an observer
  kReady,   ///< an observer has told a subject whether it is ready
  kExtra    ///< an `Extra` entry of stub.cfg
};

/// Called after a message has been handled. Returns how long the message keeps its object busy, 0 or more.
/// @param object name of the object
/// @param taken processor time that this computer needed for the handler, without the filling of camera images
using HandlerTime =
    std::function<std::chrono::nanoseconds(const std::string& object, Entry entry, std::chrono::nanoseconds taken)>;

/// An object handles one message at a time (Level2 Reference Guide, chapter 1). An object of a lower scheduling class
/// never runs while one of a higher class runs (Programmer's Guide, section 3.1); it continues afterwards. On the
/// robot, objects of the same class take turns; here the one that was called first finishes first.
///
/// Without handler times no object is ever busy. Times count from the creation of the clock.
class Processor {
 public:
  using Time = std::chrono::nanoseconds;

  /// @param priority as in the object's .ocf file, 0..255; its upper four bits are the scheduling class
  /// @param waits its handlers wait for a device: they keep the object busy, but not the processor
  void add(OID object, int priority, bool waits = false);

  /// True if the object may be called.
  bool mayRun(OID object, Time now) const;

  /// The object is called now and is busy for `duration`. This delays busy objects of lower classes.
  void run(OID object, Time now, Time duration);

  /// The end of the object's busy time; in the past if it is not busy.
  Time busyUntil(OID object) const { return taskOf(object).busy_until; }

  /// The time when the next busy object finishes; empty if none is busy.
  std::optional<Time> nextFinish(Time now) const;

 private:
  struct Task {
    OID object;
    int scheduling_class = 0;
    bool waits = false;
    Time busy_until{0};
  };

  const Task& taskOf(OID object) const;

  std::vector<Task> tasks_;  ///< few: looking at each is faster than a tree
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_PROCESSOR_H
