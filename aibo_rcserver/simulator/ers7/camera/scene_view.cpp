#include "simulator/ers7/camera/scene_view.h"

namespace simulated_ers7 {

SceneView::SceneView(Scene& scene, std::uint64_t seed) : scene_(scene), renderer_(scene), sensor_(seed) {}

Eigen::Isometry3d SceneView::camera() const {
  return body_ * cameraInBody(head_);
}

const YCrCbImage& SceneView::picture(double seconds, longword image_number, const CameraSettings& settings) {
  scene_.setTime(seconds);
  sensor_.expose(lens_.project(renderer_.render(camera())), settings, image_number, &picture_);
  return picture_;
}

}  // namespace simulated_ers7
