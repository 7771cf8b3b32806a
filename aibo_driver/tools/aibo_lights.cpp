// Shows in rviz which LEDs shine and what touches the robot, as markers on the links of its model.

#include <aibo_driver/LedStates.h>
#include <aibo_driver/Touch.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <string>

#include "ros/node.h"
#include "tools/lights/light_markers.h"

namespace {

class Lights {
 public:
  Lights(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : markers_(parameters.param<std::string>("frame_prefix", "")) {
    constexpr bool kLatched = true;
    publisher_ = handle.advertise<visualization_msgs::MarkerArray>("lights", 1, kLatched);
    leds_ = handle.subscribe("led_states", 1, &Lights::receiveLeds, this);
    touch_ = handle.subscribe("touch", 1, &Lights::receiveTouch, this);
    publisher_.publish(markers_.markers());
  }

 private:
  void receiveLeds(const aibo_driver::LedStates::ConstPtr& leds) { publishIf(markers_.setLeds(*leds)); }
  void receiveTouch(const aibo_driver::Touch::ConstPtr& touch) { publishIf(markers_.setTouch(*touch)); }

  void publishIf(bool has_changed) {
    if (has_changed) {
      publisher_.publish(markers_.markers());
    }
  }

  lights::LightMarkers markers_;
  ros::Publisher publisher_;
  ros::Subscriber leds_;
  ros::Subscriber touch_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_lights");
  return aibo_driver::node::runNode("node aibo_lights", [] {
    return std::make_shared<Lights>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"),
                                    ros::NodeHandle("~"));
  });
}
