// Lets the robot walk as a joystick or gamepad is moved while its dead-man button is pressed. The joystick's messages
// have to come several times a second, even if nothing changes: if they stop, the robot stops 0.5 s later.

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "ros/node.h"
#include "tools/teleop/joy_steering.h"

namespace {

using teleop::JoyMapping;

int readPlace(const ros::NodeHandle& parameters, const std::string& name, int place) {
  parameters.getParam(name, place);
  if (place < 0) {
    throw std::runtime_error("Parameter " + parameters.resolveName(name) + " is " + std::to_string(place) +
                             "; allowed are the places in sensor_msgs/Joy, from 0 on.");
  }
  return place;
}

double readNumber(const ros::NodeHandle& parameters, const std::string& name, double number, double highest) {
  parameters.getParam(name, number);
  if (!(number >= 0 && number <= highest)) {
    throw std::runtime_error("Parameter " + parameters.resolveName(name) + " is " + std::to_string(number) +
                             "; allowed is 0.." + std::to_string(highest) + ".");
  }
  return number;
}

JoyMapping readMapping(const ros::NodeHandle& parameters) {
  JoyMapping mapping;
  mapping.dead_man_button = readPlace(parameters, "dead_man_button", mapping.dead_man_button);
  mapping.forward_axis = readPlace(parameters, "forward_axis", mapping.forward_axis);
  mapping.left_axis = readPlace(parameters, "left_axis", mapping.left_axis);
  mapping.turn_axis = readPlace(parameters, "turn_axis", mapping.turn_axis);
  mapping.speeds.forward = readNumber(parameters, "speed", mapping.speeds.forward, 1.0);
  mapping.speeds.left = readNumber(parameters, "side_speed", mapping.speeds.left, 1.0);
  mapping.speeds.turn = readNumber(parameters, "turn_speed", mapping.speeds.turn, 10.0);
  mapping.dead_zone = readNumber(parameters, "dead_zone", mapping.dead_zone, 0.9);
  return mapping;
}

class JoyTeleop {
 public:
  JoyTeleop(ros::NodeHandle handle, const ros::NodeHandle& parameters) : steering_(readMapping(parameters)) {
    publisher_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    joystick_ = handle.subscribe("/joy", 1, &JoyTeleop::receive, this);
  }

 private:
  void receive(const sensor_msgs::Joy::ConstPtr& joystick) {
    const std::string problem = steering_.problem(joystick->axes.size(), joystick->buttons.size());
    if (!problem.empty()) {
      ROS_WARN_STREAM_THROTTLE(10, problem);
    }
    if (const auto velocity = steering_.steer(joystick->axes, joystick->buttons)) {
      geometry_msgs::Twist twist;
      twist.linear.x = velocity->forward;
      twist.linear.y = velocity->left;
      twist.angular.z = velocity->turn;
      publisher_.publish(twist);
    }
  }

  teleop::JoySteering steering_;
  ros::Publisher publisher_;
  ros::Subscriber joystick_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_teleop_joy");
  return aibo_driver::node::runNode("joystick", [] {
    return std::make_shared<JoyTeleop>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"),
                                       ros::NodeHandle("~"));
  });
}
