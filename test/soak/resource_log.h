/// @file resource_log.h
#ifndef TEST_SOAK_RESOURCE_LOG_H
#define TEST_SOAK_RESOURCE_LOG_H

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "support/resources.h"
#include "violations.h"

namespace soak {

/// The resources of one process over time. If it is started again, the new process goes on in the same log.
class ResourceLog {
 public:
  using Seconds = std::chrono::duration<double>;

  /// @param name for reports
  /// @param warm_up time after the start of a process in which growth is not a leak
  ResourceLog(const std::string& name, Seconds warm_up) : name_(name), warm_up_(warm_up) {}

  /// Takes a sample.
  /// @param time since the beginning
  const test_support::Resources& sample(pid_t process, Seconds time);

  /// Growth of the resident memory after the warm-up: the slope of the line that fits best to the life of each process.
  /// @return kilobytes per hour; 0 if there are too few samples
  double kilobytesPerHour() const;

  /// Prints a summary.
  void print() const;

  /// Adds a violation if memory, descriptors or threads became more.
  void judge(Violations* violations) const;

 private:
  struct Sample {
    pid_t process;
    Seconds time;
    test_support::Resources resources;
  };

  std::vector<Sample> warmSamples() const;
  std::size_t least(std::size_t test_support::Resources::*resource, double begin, double end) const;
  Seconds warmTime() const;

  const std::string name_;
  const Seconds warm_up_;
  std::vector<Sample> samples_;
};

}  // namespace soak

#endif  // TEST_SOAK_RESOURCE_LOG_H
