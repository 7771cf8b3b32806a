// Keeps the pink ball in the middle of the camera's picture. The robot itself finds the ball by its colour (topic
// color_regions). aibo_look_at turns the head (topic look_at). So this program only says where in space the ball is.
//
//     rosrun aibo_driver ball_follower
//
// While no ball is seen it sends nothing, and the head stays where it is. Parameters: ~name is the name of the colour's
// table (pink_ball); ~fewest_pixels is the smallest number of pixels that count as a ball (20).

#include <aibo_driver/ColorRegions.h>
#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "node/node.h"

namespace {

using aibo_driver::ColorRegion;
using aibo_driver::ColorRegions;
using geometry_msgs::PointStamped;

constexpr double kBallRadius = 0.0425;          // m
constexpr double kFocalLength = 192.0 / 208.0;  // of the ERS-7's camera, as a multiple of the picture's width

// While the ball is this near to the middle, the head does not follow it. The limit is a part of the picture's width.
constexpr double kQuiet = 0.03;

class BallFollower {
 public:
  BallFollower(ros::NodeHandle handle, const ros::NodeHandle& parameters)
      : name_(parameters.param<std::string>("name", "pink_ball")),
        fewest_pixels_(aibo_driver::node::readNumber(parameters, "fewest_pixels", 20, 416 * 320)),
        points_(handle.advertise<PointStamped>("look_at", 1)),
        regions_(handle.subscribe("color_regions", 1, &BallFollower::receive, this)) {}

 private:
  void receive(const ColorRegions::ConstPtr& regions) {
    const auto ball = std::find_if(regions->regions.begin(), regions->regions.end(), [this](const ColorRegion& region) {
      return region.name == name_ && region.pixels >= fewest_pixels_;
    });
    const bool is_seen = ball != regions->regions.end() && regions->width > 0 && regions->height > 0;
    if (is_seen != was_seen_) {
      ROS_INFO("%s", is_seen ? "There is the ball." : "The ball is out of sight; the head waits for it.");
      was_seen_ = is_seen;
    }
    if (is_seen) {
      follow(*ball, *regions);
    }
  }

  // The point is relative to where the camera was when it saw the ball. aibo_look_at knows from tf where that is now.
  void follow(const ColorRegion& ball, const ColorRegions& picture) {
    const double width = picture.width;
    const double right = (ball.x + 0.5 - picture.width / 2.0) / width;
    const double down = (ball.y + 0.5 - picture.height / 2.0) / width;
    if (std::hypot(right, down) < kQuiet) {
      return;
    }
    const double diameter = std::max({ball.box.width, ball.box.height, 1u}) / width;
    const double distance = 2 * kBallRadius * kFocalLength / diameter;
    PointStamped point;
    point.header = picture.header;
    point.point.x = right / kFocalLength * distance;
    point.point.y = down / kFocalLength * distance;
    point.point.z = distance;
    points_.publish(point);
  }

  const std::string name_;
  const double fewest_pixels_;
  bool was_seen_ = false;
  ros::Publisher points_;
  ros::Subscriber regions_;
};

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "ball_follower");
  return aibo_driver::node::runNode("ball follower", [] {
    return std::make_shared<BallFollower>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"),
                                          ros::NodeHandle("~"));
  });
}
