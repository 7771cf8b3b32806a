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

/// A service was not answered for so long that nobody waits for it any more.
class Unanswered : public std::exception {
 public:
  explicit Unanswered(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// What users do with the robot: move joints, light LEDs, call services, look at pictures for a while. Every service
/// has to be answered in time. An object that has thrown Unanswered can go only when the driver has ended.
class Workload {
 public:
  /// @param name_space the driver's
  /// @param motion file of a motion, for uploading
  Workload(const std::string& name_space, const std::string& motion, Violations* violations);

  /// Does one thing, while all is well: services have to succeed.
  /// @throw Unanswered
  void doSomething(Random& random);

  /// Calls each service once, while all is well: those that the robot allows have to succeed.
  /// @throw Unanswered
  void callEveryService(Random& random);

  /// Calls a service that moves no joint. Whether or not it succeeds, it has to be answered. Any thread.
  /// @throw Unanswered
  void callAnyService(Random& random);

  /// Sends joints somewhere, at once or by a trajectory of some seconds.
  void moveJoints(Random& random);
  void beginTrajectory(Random& random);

  /// Switches the stream off and on again.
  /// @throw Unanswered
  void toggleStream();

  /// Where the joints are, measured after this call. Complains if the driver does not tell, or if decoded pictures are
  /// wanted and none comes that was taken after this call.
  std::map<std::string, double> measure();

  /// Services called so far, and the longest time that one took.
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
  std::vector<std::future<bool>> given_up_;  // calls that nobody waits for any more
};

/// Calls services, one after the other, as long as it lives.
class ServiceCalls {
 public:
  ServiceCalls(Workload* workload, Random::result_type seed);
  ~ServiceCalls();

  ServiceCalls(const ServiceCalls&) = delete;
  ServiceCalls& operator=(const ServiceCalls&) = delete;

  /// Lets the one that is under way be the last one, and waits for its answer.
  /// @throw Unanswered
  void end();

 private:
  std::atomic<bool> ending_{false};
  std::future<void> calls_;
};

}  // namespace soak

#endif  // TEST_SOAK_WORKLOAD_H
