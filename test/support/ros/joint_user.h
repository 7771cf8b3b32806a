/// @file joint_user.h
#ifndef TEST_SUPPORT_ROS_JOINT_USER_H
#define TEST_SUPPORT_ROS_JOINT_USER_H

#include <aibo_driver/Connection.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/SetBool.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "support/proxy/recording_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/joint_listener.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/simulated_robot.h"

namespace test_support {

/// Parameters with which joints move as fast as they can and without a slow approach, for tests of something else.
inline const std::vector<std::string> kQuick{"_stream_on_start:=false", "_joint_speed_limit:=20",
                                             "_approach_speed:=20"};

/// Robot, proxy and driver, connected with each other, and a user who moves the joints.
class JointUser {
 public:
  explicit JointUser(const std::string& name_space, const std::vector<std::string>& parameters = kQuick,
                     const std::vector<std::string>& robot_options = {}, const std::string& program = AIBO_DRIVER_NODE)
      : robot(robot_options),
        proxy(robot.port()),
        joints(name_space),
        connection(name_space + "/connection"),
        driver(name_space, proxy.port(), patient(parameters), {}, program),
        name_space_(name_space),
        publishers_(name_space) {
    EXPECT_TRUE(waitForConnection(aibo_driver::Connection::CONNECTED));
    EXPECT_TRUE(joints.messages().waitForNext());
  }

  template <typename Message>
  void publish(const std::string& topic, const Message& message) {
    publishers_.publish(topic, message);
  }

  // Ready to be published on without delay.
  template <typename Message>
  ros::Publisher& publisherOf(const std::string& topic) {
    return publishers_.publisherOf<Message>(topic);
  }

  template <typename Service>
  typename Service::Response call(const std::string& name, typename Service::Request request = {}) {
    typename Service::Response response;
    EXPECT_TRUE(ros::service::call(name_space_ + "/" + name, request, response)) << "the call itself failed";
    return response;
  }

  std_srvs::SetBool::Response setMotors(bool on) {
    std_srvs::SetBool::Request request;
    request.data = on;
    return call<std_srvs::SetBool>("motors", request);
  }

  bool waitForConnection(std::uint8_t state) {
    return connection.waitFor([state](const aibo_driver::Connection& message) { return message.state == state; }) !=
           nullptr;
  }

  // Breaks the connection and waits for the next one.
  void reconnect() {
    connection.clear();
    proxy.cut();
    EXPECT_TRUE(waitForConnection(aibo_driver::Connection::CONNECTED));
    joints.messages().clear();
    EXPECT_TRUE(joints.messages().waitForNext());
  }

  bool waitForPanBeyond(double position) {
    const auto isBeyond = [position](const sensor_msgs::JointState& state) {
      return positionOf(state, "head_pan").value_or(position) > position;
    };
    return joints.messages().waitFor(isBeyond) != nullptr;
  }

  void waitForWarning(const std::string& pattern) { driver.waitForOutput("WARN.*" + pattern, kSafetyNet); }

  std::size_t jointRequests(std::size_t first_connection = 0) const {
    return proxy.requestsFromDriver("J", first_connection).size();
  }

  SimulatedRobot robot;
  RecordingProxy proxy;
  JointListener joints;
  TopicListener<aibo_driver::Connection> connection;
  DriverProcess driver;

 private:
  // A busy computer may be silent for longer than a robot.
  static std::vector<std::string> patient(std::vector<std::string> parameters) {
    parameters.insert(parameters.begin(), "_read_timeout:=20");
    return parameters;
  }

  const std::string name_space_;
  TopicPublishers publishers_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINT_USER_H
