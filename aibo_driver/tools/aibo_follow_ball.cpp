// Lets the robot walk after a pink ball, like the one that came with it, and around it. It steers by the camera's
// pictures alone: where the ball is in the picture gives its direction, how large it is its distance.

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "ros/node.h"

namespace {

constexpr double kBallRadius = 0.0425;          // m
constexpr double kFocalLength = 192.0 / 208.0;  // of the ERS-7's camera, in widths of the picture
constexpr double kClose = 0.45;                 // m; then it walks around the ball

// A patch of pink pixels: its edges in the picture.
struct Patch {
  int left;
  int right;  // the first column beyond it
  int top;
  int bottom;
  int pixels = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }

  // A ball looks as wide as high; the robot's bone, which is as pink, does not.
  bool isRound() const { return width() < 1.5 * height() && height() < 1.5 * width(); }
};

// The pink patches of a picture.
class PinkPatches {
 public:
  explicit PinkPatches(const sensor_msgs::Image& picture)
      : width_(static_cast<int>(picture.width)), height_(static_cast<int>(picture.height)) {
    is_pink_.reserve(picture.width * picture.height);
    for (std::size_t y = 0; y < picture.height; ++y) {
      for (std::size_t x = 0; x < picture.width; ++x) {
        const unsigned char* bgr = &picture.data[y * picture.step + 3 * x];
        is_pink_.push_back(bgr[2] > 90 && bgr[2] > 2 * bgr[1] && bgr[2] > bgr[0] + 40);
      }
    }
  }

  // The largest round patch.
  std::optional<Patch> findBall() {
    constexpr int kFewestPixels = 25;
    std::optional<Patch> ball;
    for (std::size_t place = 0; place < is_pink_.size(); ++place) {
      if (is_pink_[place]) {
        const Patch patch = takePatch(place);
        if (patch.pixels >= kFewestPixels && patch.isRound() && (!ball || patch.pixels > ball->pixels)) {
          ball = patch;
        }
      }
    }
    return ball;
  }

 private:
  // The patch with this pixel, which is removed.
  Patch takePatch(std::size_t place) {
    Patch patch{width_, 0, height_, 0};
    std::vector<std::size_t> to_visit;
    const auto visit = [&](int x, int y) {
      const auto next = static_cast<std::size_t>(y * width_ + x);
      if (x >= 0 && x < width_ && y >= 0 && y < height_ && is_pink_[next]) {
        is_pink_[next] = false;
        to_visit.push_back(next);
      }
    };
    visit(static_cast<int>(place) % width_, static_cast<int>(place) / width_);
    while (!to_visit.empty()) {
      const int x = static_cast<int>(to_visit.back()) % width_;
      const int y = static_cast<int>(to_visit.back()) / width_;
      to_visit.pop_back();
      patch.left = std::min(patch.left, x);
      patch.right = std::max(patch.right, x + 1);
      patch.top = std::min(patch.top, y);
      patch.bottom = std::max(patch.bottom, y + 1);
      ++patch.pixels;
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
    return patch;
  }

  int width_;
  int height_;
  std::vector<bool> is_pink_;
};

class FollowBall {
 public:
  explicit FollowBall(ros::NodeHandle handle) {
    publisher_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    pictures_ = handle.subscribe("camera/image_raw", 1, &FollowBall::receive, this);
  }

 private:
  // Without pictures there are no commands, so the driver stops the robot.
  void receive(const sensor_msgs::Image::ConstPtr& picture) {
    if (picture->encoding != sensor_msgs::image_encodings::BGR8) {
      ROS_ERROR_STREAM_THROTTLE(10, "The pictures have the encoding " << picture->encoding << " instead of bgr8.");
      return;
    }
    const std::optional<Patch> ball = PinkPatches(*picture).findBall();
    publisher_.publish(ball ? towards(*ball, picture->width) : searching());
  }

  geometry_msgs::Twist towards(const Patch& ball, double picture_width) {
    const double left = 0.5 - (ball.left + ball.right) / (2 * picture_width);
    const double distance = kBallRadius * kFocalLength * 2 * picture_width / std::max(ball.width(), ball.height());
    last_seen_on_ = left < 0 ? -1 : 1;
    geometry_msgs::Twist twist;
    twist.linear.x = std::clamp(0.6 * (distance - kClose), -0.05, 0.12);
    twist.linear.y = distance < kClose + 0.1 ? -0.04 : 0;
    twist.angular.z = std::clamp(1.5 * left, -0.6, 0.6);
    return twist;
  }

  geometry_msgs::Twist searching() const {
    geometry_msgs::Twist twist;
    twist.angular.z = 0.4 * last_seen_on_;
    return twist;
  }

  ros::Publisher publisher_;
  ros::Subscriber pictures_;
  int last_seen_on_ = 1;  // -1: on the right
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "aibo_follow_ball");
  const FollowBall follow_ball(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"));
  ros::spin();
}
