#ifndef AIBO_RCSERVER_RCSERVER_SYSTEM_MILLISECONDS_H
#define AIBO_RCSERVER_RCSERVER_SYSTEM_MILLISECONDS_H

#include <MCOOP.h>

/// The time of a clock that runs on while the robot's program stalls. Tekkotsu takes its time from the same call. The
/// result overflows after 49 days.
inline unsigned SystemMilliseconds() {
  SystemTime time;
  GetSystemTime(&time);
  return static_cast<unsigned>(time.seconds * 1000 + time.useconds / 1000);
}

#endif  // AIBO_RCSERVER_RCSERVER_SYSTEM_MILLISECONDS_H
