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

/// What one process holds over time. A process that is started again goes on in the same log.
class ResourceLog {
 public:
  using Seconds = std::chrono::duration<double>;

  /// @param name for people
  /// @param warm_up what a process still takes so long after its start is no leak
  ResourceLog(const std::string& name, Seconds warm_up) : name_(name), warm_up_(warm_up) {}

  /// Looks at the process.
  /// @param time since the beginning
  const test_support::Resources& sample(pid_t process, Seconds time);

  /// How its resident memory grows once it is warm, by the straight line that fits best; within each process' life.
  /// @return kilobytes per hour; 0 as long as nothing can be told
  double kilobytesPerHour() const;

  /// Prints what came of it.
  void print() const;

  /// Complains of memory, descriptors or threads that became more.
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
