/// @file workload.h
#ifndef TEST_SOAK_WORKLOAD_H
#define TEST_SOAK_WORKLOAD_H

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <future>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "violations.h"

namespace soak {

using Random = std::mt19937;

/// A service call was not answered within a minute.
class Unanswered : public std::exception {
 public:
  explicit Unanswered(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// Does what users do with the robot: moves joints, lights LEDs, calls services, looks at pictures for a while. Every
/// service has to answer in time. After Unanswered, the object can be destroyed only when the driver has ended.
class Workload {
 public:
  /// @param name_space the driver's
  /// @param motion path of a motion file to upload
  Workload(const std::string& name_space, const std::string& motion, Violations* violations);

  /// Does one thing in a calm period: services have to succeed.
  /// @throw Unanswered
  void doSomething(Random& random);

  /// Calls each service once in a calm period: those that the robot allows have to succeed.
  /// @throw Unanswered
  void callEveryService(Random& random);

  /// Calls a service that does not move joints. It has to be answered, but need not succeed. Any thread.
  /// @throw Unanswered
  void callAnyService(Random& random);

  /// Moves joints, at once or by a trajectory of some seconds.
  void moveJoints(Random& random);
  void beginTrajectory(Random& random);

  /// Switches the stream off and on again.
  /// @throw Unanswered
  void toggleStream();

  /// The positions of the joints, measured after this call. Adds a violation if they do not come, or if decoded
  /// pictures are subscribed and none comes that was taken after this call.
  std::map<std::string, double> measure();

  /// Number of service calls so far, and the longest time that one took.
  std::size_t calls() const;
  std::chrono::milliseconds longestCall() const;

 private:
  enum class Expected { kAnswer, kSuccess };
  using ServiceCall = void (Workload::*)(Random& random, Expected expected);

  static const std::vector<ServiceCall> kServiceCalls;
  static ServiceCall anyOf(std::size_t first, Random& random);

  template <typename Service>
  void call(const std::string& name, const Service& service, std::chrono::seconds longest, Expected expected);

  void light(Random& random);
  void flickEars(Random& random);
  void lookAtImages();
  void takePicture(Random& random, Expected expected);
  void switchStreamOn(Random& random, Expected expected);
  void setStreaming(bool on, Expected expected);
  void switchMotorsOn(Random& random, Expected expected);
  void listMotions(Random& random, Expected expected);
  void changeMotions(Random& random, Expected expected);
  void askForPower(Random& random, Expected expected);
  void stopMotion(Random& random, Expected expected);
  void playMotion(Random& random, Expected expected);
  void onJointState(const sensor_msgs::JointState& message);
  void onImage(const sensor_msgs::Image& image);

  ros::NodeHandle node_;
  const std::string motion_;
  Violations* const violations_;
  ros::Publisher joint_command_;
  ros::Publisher trajectory_;
  ros::Publisher leds_;
  ros::Publisher ears_;
  ros::Subscriber joint_states_;
  ros::Subscriber images_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::map<std::string, double> positions_;
  ros::Time measured_;
  ros::Time seen_;
  std::size_t calls_ = 0;
  std::chrono::milliseconds longest_call_{0};
  std::vector<std::future<bool>> given_up_;  // unanswered calls
};

/// Calls services, one after the other, from its construction to end().
class ServiceCalls {
 public:
  ServiceCalls(Workload* workload, Random::result_type seed);
  ~ServiceCalls();

  ServiceCalls(const ServiceCalls&) = delete;
  ServiceCalls& operator=(const ServiceCalls&) = delete;

  /// Waits for the answer to the present call, and makes no further one.
  /// @throw Unanswered
  void end();

 private:
  std::atomic<bool> ending_{false};
  std::future<void> calls_;
};

}  // namespace soak

#endif  // TEST_SOAK_WORKLOAD_H
