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
  /// @param scene the scene, which is set to each picture's time; must outlive the view
  SceneView(Scene& scene, std::uint64_t seed) : scene_(scene), renderer_(scene), sensor_(seed) {}

  const YCrCbImage& picture(const CameraPose& pose, double seconds, longword image_number,
                            const CameraSettings& settings) override {
    scene_.setTime(seconds);
    const LightImage& light = lens_.project(renderer_.render(pose.body * cameraInBody(pose.head)));
    sensor_.expose(light, renderer_.detail(), settings, image_number, &picture_);
    return picture_;
  }

 private:
  Scene& scene_;
  Renderer renderer_;
  Lens lens_;
  ImageSensor sensor_;
  YCrCbImage picture_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_SCENE_VIEW_H
