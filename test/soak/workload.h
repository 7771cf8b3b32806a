/// @file workload.h
#ifndef TEST_SOAK_WORKLOAD_H
#define TEST_SOAK_WORKLOAD_H

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "violations.h"

namespace soak {

using Random = std::mt19937;

/// What users do with the robot: move joints, light LEDs, call services, look at pictures for a while.
class Workload {
 public:
  /// @param name_space the driver's
  Workload(const std::string& name_space, Violations* violations);

  /// Does one thing. A service has to be answered in time.
  /// @param connected services have to succeed, too
  void doSomething(Random& random, bool connected);

  /// Sends joints somewhere, at once or by a trajectory of some seconds.
  void moveJoints(Random& random);
  void beginTrajectory(Random& random);

  /// Switches the stream off and on again.
  void toggleStream();

  /// Where the joints are, as measured last.
  std::map<std::string, double> jointPositions() const;

  /// Services called so far, and the longest time that one took.
  std::size_t calls() const { return calls_; }
  std::chrono::milliseconds longestCall() const { return longest_call_; }

 private:
  template <typename Service>
  void call(const std::string& name, Service service, bool connected);

  void light(Random& random);
  void flickEars(Random& random);
  void callService(Random& random, bool connected);
  void lookAtImages();
  void onJointState(const sensor_msgs::JointState& message);

  ros::NodeHandle node_;
  Violations* const violations_;
  ros::Publisher joint_command_;
  ros::Publisher trajectory_;
  ros::Publisher leds_;
  ros::Publisher ears_;
  ros::Subscriber joint_states_;
  ros::Subscriber images_;
  std::size_t calls_ = 0;
  std::chrono::milliseconds longest_call_{0};
  mutable std::mutex mutex_;  // guards what follows
  std::map<std::string, double> positions_;
  ros::Time last_stamp_;
};

}  // namespace soak

#endif  // TEST_SOAK_WORKLOAD_H
