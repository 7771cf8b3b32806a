/// @file joint_user.h
#ifndef TEST_ROS_JOINT_USER_H
#define TEST_ROS_JOINT_USER_H

#include <aibo_driver/Connection.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/SetBool.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "ros/driver_user.h"
#include "support/ros/joints.h"

namespace test_support {

/// Parameters with which joints move as fast as they can and without a slow approach, for tests of something else.
inline const std::vector<std::string> kQuick{"_stream_on_start:=false", "_joint_speed_limit:=20",
                                             "_approach_speed:=17"};

/// A user who moves the joints.
class JointUser : public DriverUser {
 public:
  explicit JointUser(const std::string& name_space, const std::vector<std::string>& parameters = kQuick,
                     const std::vector<std::string>& robot_options = {}, const std::string& program = AIBO_DRIVER_NODE)
      : DriverUser(name_space, parameters, robot_options, program), joints(name_space) {
    EXPECT_TRUE(joints.messages().waitForNext());
  }

  std_srvs::SetBool::Response setMotors(bool on) {
    std_srvs::SetBool::Request request;
    request.data = on;
    return call<std_srvs::SetBool>("motors", request);
  }

  // Gives an order again and again, until the joints are there: a driver that stalls for long drops orders.
  bool reaches(const Posture& posture, const std::function<void()>& order) {
    Posture elsewhere = posture;
    for (int attempt = 1; attempt <= 6 && !elsewhere.empty(); ++attempt) {
      order();
      elsewhere = joints.waitForPositions(posture, std::chrono::seconds(3 * attempt));
    }
    EXPECT_THAT(elsewhere, ::testing::IsEmpty());
    return elsewhere.empty();
  }

  template <typename Message>
  bool reaches(const Posture& posture, const std::string& topic, const Message& message) {
    return reaches(posture, [&] { publish(topic, message); });
  }

  JointListener joints;
};

}  // namespace test_support

#endif  // TEST_ROS_JOINT_USER_H
