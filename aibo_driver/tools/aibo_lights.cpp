#include <aibo_driver/LedStates.h>
#include <aibo_driver/Touch.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "node/node.h"
#include "tools/light_markers.h"
#include "tools/program.h"

namespace {

class Lights {
 public:
  Lights(const ros::NodeHandle& handle, const ros::NodeHandle& parameters)
      : handle_(handle), markers_(parameters.param<std::string>("frame_prefix", "")) {
    constexpr bool kLatched = true;
    const ros::SubscriberStatusCallback changed = [this](const ros::SingleSubscriberPublisher&) {
      subscribersChanged();
    };
    publisher_ = handle_.advertise<visualization_msgs::MarkerArray>("lights", 1, changed, changed, nullptr, kLatched);
    publisher_.publish(markers_.markers());
  }

 private:
  void subscribersChanged() {
    if (publisher_.getNumSubscribers() == 0) {
      leds_.shutdown();
      touch_.shutdown();
    } else if (!leds_) {
      leds_ = handle_.subscribe("led_states", 1, &Lights::receiveLeds, this);
      touch_ = handle_.subscribe("touch", 1, &Lights::receiveTouch, this);
    }
  }

  void receiveLeds(const aibo_driver::LedStates::ConstPtr& leds) { publishIf(markers_.setLeds(*leds)); }
  void receiveTouch(const aibo_driver::Touch::ConstPtr& touch) { publishIf(markers_.setTouch(*touch)); }

  void publishIf(bool has_changed) {
    if (has_changed) {
      publisher_.publish(markers_.markers());
    }
  }

  ros::NodeHandle handle_;
  lights::LightMarkers markers_;
  ros::Publisher publisher_;
  ros::Subscriber leds_;
  ros::Subscriber touch_;
};

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_lights [__ns:=aibo] [_frame_prefix:=PREFIX]

Shows in rviz which LEDs shine and what touches the robot: topic lights.
)";

}  // namespace

int main(int argc, char** argv) {
  return aibo_driver::tools::run<Lights>(argc, argv, "aibo_lights", kHelp);
}
