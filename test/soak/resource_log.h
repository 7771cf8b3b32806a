/// @file resource_log.h
#ifndef TEST_SOAK_RESOURCE_LOG_H
#define TEST_SOAK_RESOURCE_LOG_H

#include <fstream>
#include <string>
#include <vector>

#include "support/resources.h"

namespace soak {

/// The resources of a process over time.
class ResourceLog {
 public:
  /// @param path of a table that is written for plots: seconds, KB, descriptors, threads
  explicit ResourceLog(const std::string& path) : table_(path) {}

  /// Takes a sample.
  /// @param seconds since the beginning
  void sample(int process, double seconds);

  /// @return what has grown from the first quarter to the last one, after a warm-up of 5 minutes; empty if nothing has
  ///   grown, or if less than 10 more minutes were measured, which is too short
  std::string growth() const;

 private:
  struct Sample {
    double seconds;
    test_support::Resources resources;
  };

  std::ofstream table_;
  std::vector<Sample> samples_;  // after the warm-up
};

}  // namespace soak

#endif  // TEST_SOAK_RESOURCE_LOG_H
