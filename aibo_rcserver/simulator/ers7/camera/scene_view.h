/// @file scene_view.h
/// The scene as the camera in the robot's head sees it.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_SCENE_VIEW_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_SCENE_VIEW_H

#include <cstdint>

#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/image_sensor.h"
#include "simulator/ers7/camera/renderer.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

class SceneView : public PictureSource {
 public:
  /// @param scene set to each picture's time; must outlive the view
  SceneView(Scene& scene, std::uint64_t seed) : scene_(scene), renderer_(scene), sensor_(seed) {}

  /// The head's pose is restingHead() at first.
  void setHead(const HeadAngles& angles) override { head_ = angles; }

  /// The body is level and kStandingHeight above the floor at first.
  void setBody(const Eigen::Isometry3d& in_room) override { body_ = in_room; }

  /// In the room.
  Eigen::Isometry3d camera() const { return body_ * cameraInBody(head_); }

  const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) override {
    scene_.setTime(seconds);
    const LightImage& light = lens_.project(renderer_.render(camera()));
    sensor_.expose(light, renderer_.detail(), settings, image_number, &picture_);
    return picture_;
  }

 private:
  Scene& scene_;
  HeadAngles head_ = restingHead();
  Eigen::Isometry3d body_{Eigen::Translation3d(0, 0, kStandingHeight)};
  Renderer renderer_;
  Lens lens_;
  ImageSensor sensor_;
  YCrCbImage picture_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_SCENE_VIEW_H
