/// @file driver_user.h
#ifndef TEST_ROS_DRIVER_USER_H
#define TEST_ROS_DRIVER_USER_H

#include <aibo_driver/Connection.h>
#include <aibo_driver/MotionState.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <ros/service.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "ros/recording_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/simulated_robot.h"

namespace test_support {

/// The movement that has ended last; its kind is NONE if nothing has ended yet.
inline aibo_driver::EndedMovement lastEnd(const aibo_driver::MotionState& state) {
  return state.ended.empty() ? aibo_driver::EndedMovement() : state.ended.back();
}

/// Robot, proxy and driver, connected with each other, and a user. Unless a test says otherwise, frames have the prefix
/// "rex", and pictures the quality 83.
class DriverUser : public TopicPublishers {
 public:
  explicit DriverUser(const std::string& name_space, std::vector<std::string> parameters = {},
                      const std::vector<std::string>& robot_options = {}, const std::string& program = AIBO_DRIVER_NODE)
      : TopicPublishers(name_space),
        robot(robot_options),
        proxy(robot.port()),
        connection(name_space + "/connection"),
        driver(name_space, proxy.port(), unusual(&parameters), {}, program) {
    EXPECT_TRUE(waitForConnection(aibo_driver::Connection::CONNECTED));
  }

  ~DriverUser() { letGo(); }

  template <typename Service>
  typename Service::Response call(const std::string& name, typename Service::Request request = {}) {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::call(name_space_ + "/" + name, request, response)) << "the call itself failed";
    return response;
  }

  /// Tries again and again, because a driver that stalls for long drops orders.
  static bool becomesTrue(const std::function<bool()>& attempt) {
    return eventually(attempt, std::chrono::milliseconds(10));
  }

  /// A velocity ahead. The robot cannot do what is in the fields that are not for it.
  static geometry_msgs::Twist twist(double forward, double turn = 0) {
    geometry_msgs::Twist twist;
    twist.linear.x = forward;
    twist.linear.z = 0.03;
    twist.angular.x = -0.5;
    twist.angular.y = 0.7;
    twist.angular.z = turn;
    return twist;
  }

  /// Sends a velocity ten times a second from now on.
  void steer(double forward, double turn = 0) {
    letGo();
    ros::Publisher& publisher = publisherOf<geometry_msgs::Twist>("cmd_vel");
    steering_ = true;
    steerer_ = std::thread([this, &publisher, twist = twist(forward, turn)] {
      while (steering_) {
        publisher.publish(twist);
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
    });
  }

  void letGo() {
    steering_ = false;
    if (steerer_.joinable()) {
      steerer_.join();
    }
  }

  bool waitForConnection(std::uint8_t state) {
    return connection.waitFor([state](const aibo_driver::Connection& message) { return message.state == state; }) !=
           nullptr;
  }

  SimulatedRobot robot;
  RecordingProxy proxy;
  TopicListener<aibo_driver::Connection> connection;
  DriverProcess driver;

 private:
  /// A busy computer may be silent for longer than a robot.
  static std::vector<std::string>& unusual(std::vector<std::string>* parameters) {
    parameters->insert(parameters->begin(), {"_read_timeout:=20", "_frame_prefix:=rex", "_jpeg_quality:=83"});
    return *parameters;
  }

  std::atomic<bool> steering_{false};
  std::thread steerer_;
};

}  // namespace test_support

#endif  // TEST_ROS_DRIVER_USER_H
