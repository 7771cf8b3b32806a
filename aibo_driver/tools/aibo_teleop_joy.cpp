// Steers the robot by a joystick or gamepad. One stick walks, the other turns the head. Buttons stop the robot, take
// pictures, play motions and take postures. The joystick's messages have to come several times a second, even if
// nothing changes. If they stop, the robot stops 0.5 s later.

#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "files/files.h"
#include "node/node.h"
#include "tools/program.h"
#include "tools/teleop/joy_steering.h"
#include "tools/teleop/teleop_node.h"

namespace {

using aibo_driver::PlayMotion;
using aibo_driver::TakePicture;
using std_srvs::Trigger;
using teleop::JoyMapping;
using teleop::JoyOrders;
using teleop::PanTilt;

int checkPlace(const std::string& name, int place, int lowest) {
  if (place < lowest) {
    throw std::runtime_error("Parameter " + name + " is " + std::to_string(place) +
                             "; it must be a place in sensor_msgs/Joy, from 0 on" +
                             (lowest == teleop::kNoPlace ? ", or -1 for none." : "."));
  }
  return place;
}

int readPlace(const ros::NodeHandle& parameters, const std::string& name, int place, int lowest = teleop::kNoPlace) {
  XmlRpc::XmlRpcValue value;
  if (parameters.getParam(name, value) && !parameters.getParam(name, place)) {
    throw std::runtime_error(aibo_driver::node::describeRefusal(parameters.resolveName(name), value,
                                                                "a place in sensor_msgs/Joy, a whole number"));
  }
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

JoyMapping readMapping(const ros::NodeHandle& parameters) {
  JoyMapping mapping;
  mapping.dead_man_button = readPlace(parameters, "dead_man_button", mapping.dead_man_button, 0);
  mapping.forward_axis = readPlace(parameters, "forward_axis", mapping.forward_axis);
  mapping.turn_axis = readPlace(parameters, "turn_axis", mapping.turn_axis);
  mapping.left_axis = readPlace(parameters, "left_axis", mapping.left_axis);
  mapping.pan_axis = readPlace(parameters, "pan_axis", mapping.pan_axis);
  mapping.tilt_axis = readPlace(parameters, "tilt_axis", mapping.tilt_axis);
  mapping.stop_button = readPlace(parameters, "stop_button", mapping.stop_button);
  mapping.release_button = readPlace(parameters, "release_button", mapping.release_button);
  mapping.picture_button = readPlace(parameters, "picture_button", mapping.picture_button);
  mapping.motions = readButtons(parameters, "motions");
  mapping.postures = readButtons(parameters, "postures");
  mapping.speeds = teleop::readSpeeds(parameters);
  mapping.head_speed = aibo_driver::node::readNumber(parameters, "head_speed", mapping.head_speed, 10.0);
  mapping.dead_zone = aibo_driver::node::readNumber(parameters, "dead_zone", mapping.dead_zone, 0.9);
  for (const auto& posture : mapping.postures) {
    if (posture.first != "stand" && posture.first != "sit" && posture.first != "rest") {
      throw std::runtime_error("Parameter " + parameters.resolveName("postures") + " has '" + posture.first +
                               "'; the postures are stand, sit and rest.");
    }
  }
  if (const std::string problem = problemOf(mapping); !problem.empty()) {
    throw std::runtime_error("The parameters of " + parameters.getNamespace() + " are wrong. " + problem);
  }
  return mapping;
}

// A short press of a button is only one of many messages. Messages that come while this program stalls have to be kept,
// or a stop would be lost. The queue holds some seconds of messages, which is our choice.
constexpr int kJoyQueueSize = 100;

std::string howToRelease(const JoyMapping& mapping) {
  return mapping.release_button == teleop::kNoPlace
             ? "Call the service release to let it move."
             : "To let it move, press the release button together with the dead-man button, then release both.";
}

class JoyTeleop {
 public:
  JoyTeleop(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : mapping_(readMapping(parameters)),
        steering_(mapping_),
        handle_(handle),
        robot_(handle, howToRelease(mapping_), [](const std::string& text) { ROS_WARN_STREAM(text); }) {
    velocities_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    head_positions_ = handle.advertise<sensor_msgs::JointState>("joint_command", 1);
    joints_ = handle.subscribe("joint_states", 1, &JoyTeleop::receiveJoints, this);
    joystick_ = handle.subscribe("/joy", kJoyQueueSize, &JoyTeleop::receive, this);
  }

 private:
  void receive(const sensor_msgs::Joy::ConstPtr& joystick) {
    const std::string problem = steering_.problem(joystick->axes.size(), joystick->buttons.size());
    if (!problem.empty()) {
      ROS_WARN_STREAM_THROTTLE(10, problem);
    }
    const JoyOrders orders = steering_.read(joystick->axes, {joystick->buttons.begin(), joystick->buttons.end()});
    if (orders.stop) {
      robot_.stop();
    }
    if (orders.walk) {
      velocities_.publish(teleop::toTwist(*orders.walk));
    }
    if (const auto position = head_.steer(orders.head, std::chrono::steady_clock::now())) {
      turnHead(*position);
    }
    obey(orders);
  }

  void obey(const JoyOrders& orders) {
    if (orders.release) {
      robot_.release();
    }
    if (orders.take_picture) {
      TakePicture::Request request;
      request.save_to = aibo_driver::files::nameForPicture();
      call<TakePicture>("take_picture", request);
    }
    if (!orders.motion.empty()) {
      PlayMotion::Request request;
      request.name = orders.motion;
      request.repetitions = 1;
      call<PlayMotion>("play_motion", request);
    }
    if (!orders.posture.empty()) {
      call<Trigger>(orders.posture, {});
    }
  }

  template <typename Service>
  void call(const std::string& service, const typename Service::Request& request) {
    teleop::call<Service>(calls_, handle_.resolveName(service), request);
  }

  void turnHead(const PanTilt& position) {
    constexpr double kReserve = 1.5;  // lets the head keep up with the positions
    const double speed = kReserve * mapping_.head_speed;
    sensor_msgs::JointState command;
    command.name = {"head_pan", "head_tilt"};
    command.position = {position.pan, position.tilt};
    command.velocity = {speed, speed};
    head_positions_.publish(command);
  }

  // Notes the joints in a message. A version 1 server measures one joint after the other.
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
  const ros::NodeHandle handle_;
  teleop::StopAndRelease robot_;
  aibo_driver::node::ServiceCalls calls_;
  ros::Publisher velocities_;
  ros::Publisher head_positions_;
  ros::Subscriber joints_;
  ros::Subscriber joystick_;
};

constexpr char kHelp[] = R"(  roslaunch aibo_driver teleop.launch joy:=true

Steers the robot by a joystick or gamepad (sensor_msgs/Joy on /joy). config/joy.yaml has its parameters.
)";

}  // namespace

int main(int argc, char** argv) {
  return aibo_driver::tools::run<JoyTeleop>(argc, argv, "aibo_teleop_joy", kHelp);
}
