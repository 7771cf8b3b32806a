/// @file processor.h
/// The robot's one processor: who may run, and how long a handler keeps its object busy.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PROCESSOR_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PROCESSOR_H

#include <OPENR/OPENR.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace openr_host {

/// What an object was called for.
enum class Entry {
  kNotify,  ///< data has come to an observer
  kReady,   ///< an observer has spoken to a subject
  kExtra    ///< an `Extra` entry of stub.cfg
};

/// Says for how long a message keeps its object busy: called when it has been handled.
/// @param object name of the object
/// @param taken what this computer needed
/// @return 0 or more
using HandlerTime =
    std::function<std::chrono::nanoseconds(const std::string& object, Entry entry, std::chrono::nanoseconds taken)>;

/// One object handles one message at a time (Level2 Reference Guide, chapter 1). An object of a lower scheduling class
/// never runs while one of a higher class is running (Programmer's Guide, section 3.1): it goes on afterwards. Objects
/// of one class take turns on the robot; here the one that was called first finishes first.
///
/// Without handler times nobody is ever busy. Times count from when the clock was made.
class Processor {
 public:
  using Time = std::chrono::nanoseconds;

  /// @param priority as in the object's .ocf file, 0..255; its upper four bits are the scheduling class
  void add(OID object, int priority);

  /// True if the object may be called.
  bool mayRun(OID object, Time now) const;

  /// The object was called now and is busy for a time. Objects of lower classes that are busy are held up by it.
  void run(OID object, Time now, Time duration);

  /// Until when the object is busy; in the past if it is not.
  Time busyUntil(OID object) const { return tasks_.at(object).busy_until; }

  /// When the next object that is busy now has finished.
  std::optional<Time> nextFinish(Time now) const;

 private:
  struct Task {
    int scheduling_class = 0;
    Time busy_until{0};
  };

  std::map<OID, Task> tasks_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_PROCESSOR_H
