#include "simulator/ers7/camera/camera_optics.h"

#include <cmath>

namespace simulated_ers7 {
namespace {

double focalLength(int pixels, double field_of_view) {
  const double half_angle = field_of_view / 2 * std::acos(-1.0) / 180;
  return pixels / 2.0 / std::tan(half_angle);
}

const double kFocalLengthX = focalLength(kPictureWidth, kHorizontalFieldOfView);
const double kFocalLengthY = focalLength(kPictureHeight, kVerticalFieldOfView);

}  // namespace

double focalLengthX() {
  return kFocalLengthX;
}

double focalLengthY() {
  return kFocalLengthY;
}

Eigen::Vector3d directionOf(const Eigen::Vector2d& place) {
  const double left = (kPictureWidth / 2.0 - place.x()) / kFocalLengthX;
  const double up = (kPictureHeight / 2.0 - place.y()) / kFocalLengthY;
  return Eigen::Vector3d(1, left, up) * (1 / std::sqrt(1 + left * left + up * up));
}

Eigen::Vector2d placeOf(const Eigen::Vector3d& point) {
  return {kPictureWidth / 2.0 - kFocalLengthX * point.y() / point.x(),
          kPictureHeight / 2.0 - kFocalLengthY * point.z() / point.x()};
}

}  // namespace simulated_ers7
