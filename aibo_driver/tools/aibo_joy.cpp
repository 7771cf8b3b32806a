// Reads a joystick or gamepad and publishes it as sensor_msgs/Joy. It replaces joy_node, which Debian does not have.

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "node/node.h"
#include "tools/joystick/joystick_state.h"
#include "tools/joystick/sdl_joystick.h"

namespace {

// The joystick is read more often than a hand moves.
constexpr double kReadPeriod = 0.01;  // s

// @return the number N of /dev/input/jsN, such as 0
int readDevice(const ros::NodeHandle& parameters) {
  const auto device = parameters.param<std::string>("dev", "/dev/input/js0");
  const std::size_t digits = device.find_last_not_of("0123456789") + 1;
  if (device.size() == digits || device.size() > digits + 2) {
    throw std::runtime_error("Parameter " + parameters.resolveName("dev") + " is '" + device +
                             "'; it should be /dev/input/js0 for the first joystick, /dev/input/js1 for the second.");
  }
  return std::stoi(device.substr(digits));
}

joystick::Reporter makeReporter(const ros::NodeHandle& parameters) {
  const double dead_zone = aibo_driver::node::readNumber(parameters, "deadzone", 0.05, 0.9);
  const double rate = aibo_driver::node::readNumber(parameters, "autorepeat_rate", 20.0, 100);
  return {dead_zone, std::chrono::nanoseconds(rate > 0 ? std::llround(1e9 / rate) : 0)};
}

class Joy {
 public:
  Joy(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : reporter_(makeReporter(parameters)),
        joystick_(readDevice(parameters), parameters.param<std::string>("dev_name", "")) {
    publisher_ = handle.advertise<sensor_msgs::Joy>("joy", 1);
    timer_ = handle.createSteadyTimer(ros::WallDuration(kReadPeriod), [this](const ros::SteadyTimerEvent&) { read(); });
    ROS_INFO(
        "Waiting for a joystick or gamepad. If it is plugged in and nothing comes: may this user read "
        "/dev/input/event*? It may have to be in the group input.");
  }

 private:
  void read() {
    const auto state = joystick_.read();
    if (state && !is_there_) {
      ROS_INFO_STREAM("The joystick is there: " << joystick_.describe() << ".");
    } else if (!state && is_there_) {
      ROS_WARN("The joystick is gone. It is used again as soon as it is back.");
    }
    is_there_ = state.has_value();
    if (const auto report = reporter_.report(state, std::chrono::steady_clock::now())) {
      sensor_msgs::Joy message;
      message.header.stamp = ros::Time::now();
      message.axes = report->axes;
      message.buttons.assign(report->buttons.begin(), report->buttons.end());
      publisher_.publish(message);
    }
  }

  joystick::Reporter reporter_;
  joystick::SdlJoystick joystick_;
  bool is_there_ = false;
  ros::Publisher publisher_;
  ros::SteadyTimer timer_;
};

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_joy");
  return aibo_driver::node::runNode("node aibo_joy",
                                    [] { return std::make_shared<Joy>(ros::NodeHandle(), ros::NodeHandle("~")); });
}
