// Shows in rviz where the robot sees its pink ball: publishes a marker (ball_marker), from the colours that the robot's
// camera detects. It listens to the robot only while somebody wants the marker.

#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/Marker.h>

#include <cmath>
#include <optional>

#include "ros/node.h"
#include "tools/ball/ball_finder.h"

namespace {

using aibo_driver::ball::Ball;
using visualization_msgs::Marker;

constexpr double kShownFor = 0.5;  // s after the ball was last seen

// The frame of the camera has x to the right, y down and z forward.
Marker markerAt(const Ball& ball, const std_msgs::Header& header) {
  const double forward = ball.distance / std::sqrt(1 + ball.left * ball.left + ball.up * ball.up);
  Marker marker;
  marker.header = header;
  marker.ns = "ball";
  marker.type = Marker::SPHERE;
  marker.action = Marker::ADD;
  marker.pose.position.x = -ball.left * forward;
  marker.pose.position.y = -ball.up * forward;
  marker.pose.position.z = forward;
  marker.pose.orientation.w = 1;
  marker.scale.x = marker.scale.y = marker.scale.z = 2 * aibo_driver::ball::kBallRadius;
  marker.color.r = 1;
  marker.color.g = 0.3F;
  marker.color.b = 0.6F;
  marker.color.a = 1;
  marker.lifetime = ros::Duration(kShownFor);
  return marker;
}

class BallMarker {
 public:
  explicit BallMarker(const ros::NodeHandle& handle) : handle_(handle) {
    const ros::SubscriberStatusCallback on_change = [this](const ros::SingleSubscriberPublisher&) {
      subscribersChanged();
    };
    publisher_ = handle_.advertise<Marker>("ball_marker", 5, on_change, on_change);
  }

 private:
  void subscribersChanged() {
    if (publisher_.getNumSubscribers() == 0) {
      mask_.shutdown();
    } else if (!mask_) {
      mask_ = handle_.subscribe("color_mask", 1, &BallMarker::receive, this);
    }
  }

  void receive(const sensor_msgs::Image::ConstPtr& mask) {
    if (const std::optional<Ball> ball = aibo_driver::ball::findBall(*mask)) {
      publisher_.publish(markerAt(*ball, mask->header));
    }
  }

  ros::NodeHandle handle_;
  ros::Publisher publisher_;
  ros::Subscriber mask_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_ball_marker");
  const BallMarker ball_marker(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"));
  ros::spin();
}
