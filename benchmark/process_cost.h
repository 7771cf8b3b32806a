/// @file process_cost.h
#ifndef BENCHMARK_PROCESS_COST_H
#define BENCHMARK_PROCESS_COST_H

#include <sys/types.h>
#include <time.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace benchmark_figures {

/// The processor time that a process has used so far, in s: all its threads, user and system.
inline double processorSeconds(pid_t process) {
  clockid_t clock = 0;
  timespec time{};
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) {
    throw std::runtime_error("process " + std::to_string(process) + " has ended");
  }
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The memory that a process uses, in MB. Memory that it shares with others counts in part.
inline double memoryMegabytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
  std::string key;
  while (file >> key) {
    double kilobytes = 0;
    if (key == "Pss:" && file >> kilobytes) {
      return kilobytes / 1024;
    }
  }
  throw std::runtime_error("the memory of process " + std::to_string(process) + " cannot be read");
}

}  // namespace benchmark_figures

#endif  // BENCHMARK_PROCESS_COST_H
