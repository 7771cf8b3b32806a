/// @file ball_finder.h
/// Finds the robot's ball among the detected colours.
#ifndef AIBO_DRIVER_TOOLS_BALL_FINDER_H
#define AIBO_DRIVER_TOOLS_BALL_FINDER_H

#include <sensor_msgs/Image.h>

#include <optional>

namespace aibo_driver::ball {

constexpr double kBallRadius = 0.0425;  ///< m, the radius of the pink ball

/// A ball as the camera sees it.
struct Ball {
  double left;      ///< the tangent of the angle to the left of the picture's middle; negative: to the right
  double up;        ///< the tangent of the angle upwards; negative: down
  double distance;  ///< m from the camera, computed from the ball's size in the picture
};

/// Finds the largest round patch of detected pixels. A ball looks as wide as it is high. The robot's bone is just as
/// pink, but it has another shape, so the ball is found even if both are in the picture.
/// @param mask an image of color_mask: rgb8, black where nothing was detected
/// @return empty if there is no ball, or if the image is of another kind
std::optional<Ball> findBall(const sensor_msgs::Image& mask);

}  // namespace aibo_driver::ball

#endif  // AIBO_DRIVER_TOOLS_BALL_FINDER_H
