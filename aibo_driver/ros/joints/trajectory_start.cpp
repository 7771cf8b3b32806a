#include "ros/joints/trajectory_start.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

// A message takes its time from the sender to here, and the clocks of two machines differ a little.
constexpr double kLongestPast = 1.0;  // s

// A stamp that is farther away is of another clock, or no time at all.
constexpr double kLongestWait = 3600.0;  // s

}  // namespace

std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now) {
  if (stamp.isZero()) {
    return std::chrono::nanoseconds(0);
  }
  // ros::Time has no difference of times that lie more than 68 years apart: it throws.
  const double wait = stamp.toSec() - now.toSec();
  if (wait < -kLongestPast || wait > kLongestWait) {
    throw InvalidArgumentException("Trajectory refused: header.stamp, when it is to begin, is " +
                                   std::to_string(std::abs(wait)) + (wait < 0 ? " s ago" : " s ahead") +
                                   "; allowed is from 1 s ago to an hour ahead, and 0, which means at once.");
  }
  return std::chrono::nanoseconds(std::max<std::int64_t>(0, std::llround(wait * 1e9)));
}

}  // namespace aibo_driver::node
