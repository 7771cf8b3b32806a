#include "node/joints/trajectory_messages.h"

#include <cmath>
#include <string>

#include "aibo_client/exceptions.h"

namespace aibo_driver::node {
namespace {

// How far a stamp may be in the past: a message takes time to arrive, and the clocks of two machines differ a little.
constexpr double kLongestPast = 1.0;  // s

// A stamp that is further ahead comes from another clock, or it is garbage.
constexpr double kLongestWait = 3600.0;  // s

}  // namespace

std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now) {
  if (stamp.isZero()) {
    return std::chrono::nanoseconds(0);
  }
  // Seconds are subtracted, because a difference of two ros::Time more than 68 years apart throws.
  const double wait = stamp.toSec() - now.toSec();
  if (wait < -kLongestPast || wait > kLongestWait) {
    throw aibo_client::InvalidArgumentException(
        "header.stamp, when it should begin, is " + std::to_string(std::abs(wait)) +
        (wait < 0 ? " s ago" : " s ahead") + "; it must be from 1 s ago to an hour ahead, or 0, which means at once.");
  }
  return std::chrono::nanoseconds(std::llround(wait * 1e9));
}

movement::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message) {
  movement::TrajectoryRequest request;
  request.joints = message.joint_names;
  for (const trajectory_msgs::JointTrajectoryPoint& point : message.points) {
    request.points.push_back({point.time_from_start.toSec(), point.positions, point.velocities});
  }
  return request;
}

}  // namespace aibo_driver::node
