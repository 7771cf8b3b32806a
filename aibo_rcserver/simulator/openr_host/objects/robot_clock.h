/// @file robot_clock.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_ROBOT_CLOCK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_ROBOT_CLOCK_H

#include <OPENR/OTime.h>

namespace openr_host {

/// The time of day for OPENR::GetTime(): this computer's universal time until it is set.
class RobotClock {
 public:
  OTime time() const { return OTime(now() + correction_, time_difference_); }

  void set(const OTime& time) {
    correction_ = time.GetClock() - now();
    time_difference_ = time.GetTimeDif();
  }

 private:
  static time_t now() { return ::time(nullptr) - otimeSTART_CLOCK; }

  time_t correction_ = 0;  ///< seconds
  sbyte time_difference_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_ROBOT_CLOCK_H
