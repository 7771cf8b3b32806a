// Steers the robot by a joystick or gamepad: one stick walks, the other turns the head, buttons stop, take pictures,
// play motions and take postures. The joystick's messages have to come several times a second, even if nothing changes:
// if they stop, the robot stops 0.5 s later.

#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <ctime>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "ros/node.h"
#include "text/plain_text.h"
#include "tools/teleop/head_steering.h"
#include "tools/teleop/joy_steering.h"

namespace {

using aibo_driver::PlayMotion;
using aibo_driver::TakePicture;
using std_srvs::Trigger;
using teleop::HeadPosition;
using teleop::JoyMapping;
using teleop::JoyOrders;

int checkPlace(const std::string& name, int place, int lowest) {
  if (place < lowest) {
    throw std::runtime_error("Parameter " + name + " is " + std::to_string(place) +
                             "; allowed are the places in sensor_msgs/Joy, from 0 on" +
                             (lowest == teleop::kNoPlace ? ", and -1 for none." : "."));
  }
  return place;
}

int readPlace(const ros::NodeHandle& parameters, const std::string& name, int place, int lowest = teleop::kNoPlace) {
  parameters.getParam(name, place);
  return checkPlace(parameters.resolveName(name), place, lowest);
}

std::map<std::string, int> readButtons(const ros::NodeHandle& parameters, const std::string& name) {
  std::map<std::string, int> buttons;
  if (parameters.hasParam(name) && !parameters.getParam(name, buttons)) {
    throw std::runtime_error("Parameter " + parameters.resolveName(name) +
                             " should have a button for each name, such as {NOD: 2}.");
  }
  for (const auto& [each, button] : buttons) {
    checkPlace(parameters.resolveName(name) + "/" + each, button, teleop::kNoPlace);
  }
  return buttons;
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
  mapping.dead_man_button = readPlace(parameters, "dead_man_button", mapping.dead_man_button, 0);
  mapping.forward_axis = readPlace(parameters, "forward_axis", mapping.forward_axis);
  mapping.turn_axis = readPlace(parameters, "turn_axis", mapping.turn_axis);
  mapping.left_axis = readPlace(parameters, "left_axis", mapping.left_axis);
  mapping.pan_axis = readPlace(parameters, "pan_axis", mapping.pan_axis);
  mapping.tilt_axis = readPlace(parameters, "tilt_axis", mapping.tilt_axis);
  mapping.stop_button = readPlace(parameters, "stop_button", mapping.stop_button);
  mapping.picture_button = readPlace(parameters, "picture_button", mapping.picture_button);
  mapping.motions = readButtons(parameters, "motions");
  mapping.postures = readButtons(parameters, "postures");
  mapping.speeds.forward = readNumber(parameters, "speed", mapping.speeds.forward, 1.0);
  mapping.speeds.left = readNumber(parameters, "side_speed", mapping.speeds.left, 1.0);
  mapping.speeds.turn = readNumber(parameters, "turn_speed", mapping.speeds.turn, 10.0);
  mapping.head_speed = readNumber(parameters, "head_speed", mapping.head_speed, 10.0);
  mapping.dead_zone = readNumber(parameters, "dead_zone", mapping.dead_zone, 0.9);
  for (const auto& posture : mapping.postures) {
    if (posture.first != "stand" && posture.first != "sit" && posture.first != "rest") {
      throw std::runtime_error("Parameter " + parameters.resolveName("postures") + " has '" + posture.first +
                               "'; the postures are stand, sit and rest.");
    }
  }
  return mapping;
}

std::string pictureName() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char name[40];
  std::strftime(name, sizeof(name), "aibo_%Y%m%d_%H%M%S.jpg", &local);
  return name;
}

// Calls one service at a time, in a thread of its own, so that steering goes on, and a stop waits for nothing.
class Caller {
 public:
  explicit Caller(const ros::NodeHandle& handle) : handle_(handle) {}

  template <typename Service>
  void call(const std::string& name, const typename Service::Request& request) {
    if (call_.valid() && call_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      ROS_WARN_STREAM("The call of " << name << " is left out: the one before it has not ended yet.");
      return;
    }
    call_ = std::async(std::launch::async, [service = handle_.resolveName(name), request] {
      typename Service::Response response;
      typename Service::Request copy = request;
      if (!ros::service::call(service, copy, response)) {
        ROS_WARN_STREAM("The service " << service << " cannot be called: does the driver run?");
      } else if (response.success) {
        ROS_INFO_STREAM(service << ": " << text::plainLine(response.message, 1000));
      } else {
        ROS_WARN_STREAM(service << ": " << text::plainLine(response.message, 1000));
      }
    });
  }

 private:
  const ros::NodeHandle handle_;
  std::future<void> call_;
};

class JoyTeleop {
 public:
  JoyTeleop(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : mapping_(readMapping(parameters)), steering_(mapping_), stop_(handle), pictures_(handle), movements_(handle) {
    velocities_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    head_positions_ = handle.advertise<sensor_msgs::JointState>("joint_command", 1);
    joints_ = handle.subscribe("joint_states", 1, &JoyTeleop::receiveJoints, this);
    joystick_ = handle.subscribe("/joy", 1, &JoyTeleop::receive, this);
  }

 private:
  void receive(const sensor_msgs::Joy::ConstPtr& joystick) {
    const std::string problem = steering_.problem(joystick->axes.size(), joystick->buttons.size());
    if (!problem.empty()) {
      ROS_WARN_STREAM_THROTTLE(10, problem);
    }
    const JoyOrders orders = steering_.read(joystick->axes, {joystick->buttons.begin(), joystick->buttons.end()});
    if (orders.stop) {
      stop_.call<Trigger>("stop", {});
    }
    if (orders.walk) {
      walk(*orders.walk);
    }
    if (const auto position = head_.steer(orders.head, std::chrono::steady_clock::now())) {
      turnHead(*position);
    }
    obey(orders);
  }

  void obey(const JoyOrders& orders) {
    if (orders.take_picture) {
      TakePicture::Request request;
      request.save_to = pictureName();
      pictures_.call<TakePicture>("take_picture", request);
    }
    if (!orders.motion.empty()) {
      PlayMotion::Request request;
      request.name = orders.motion;
      request.repetitions = 1;
      movements_.call<PlayMotion>("play_motion", request);
    }
    if (!orders.posture.empty()) {
      movements_.call<Trigger>(orders.posture, {});
    }
  }

  void walk(const aibo_driver::WalkVelocity& velocity) {
    geometry_msgs::Twist twist;
    twist.linear.x = velocity.forward;
    twist.linear.y = velocity.left;
    twist.angular.z = velocity.turn;
    velocities_.publish(twist);
  }

  void turnHead(const HeadPosition& position) {
    constexpr double kReserve = 1.5;  // so that the head keeps up with the positions
    const double speed = kReserve * mapping_.head_speed;
    sensor_msgs::JointState command;
    command.name = {"head_pan", "head_tilt"};
    command.position = {position.pan, position.tilt};
    command.velocity = {speed, speed};
    head_positions_.publish(command);
  }

  // A version 1 server measures one joint after the other.
  void receiveJoints(const sensor_msgs::JointState::ConstPtr& joints) {
    for (std::size_t i = 0; i < joints->name.size() && i < joints->position.size(); ++i) {
      if (joints->name[i] == "head_pan") {
        pan_ = joints->position[i];
      } else if (joints->name[i] == "head_tilt") {
        tilt_ = joints->position[i];
      }
    }
    if (pan_ && tilt_) {
      head_.measured({*pan_, *tilt_});
    }
  }

  const JoyMapping mapping_;
  teleop::JoySteering steering_;
  teleop::HeadSteering head_;
  std::optional<double> pan_;
  std::optional<double> tilt_;
  Caller stop_;
  Caller pictures_;
  Caller movements_;
  ros::Publisher velocities_;
  ros::Publisher head_positions_;
  ros::Subscriber joints_;
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
