/// @file thread_processor_time.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_THREAD_PROCESSOR_TIME_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_THREAD_PROCESSOR_TIME_H

#include <time.h>

#include <chrono>

namespace openr_host {

/// Stands still while this thread waits for a processor.
inline std::chrono::nanoseconds threadProcessorTime() {
  timespec time = {};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_THREAD_PROCESSOR_TIME_H
