#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H

#include "protocol/camera_settings.h"
#include "rcserver/body/Primitives.h"

/// Sets the camera, and keeps its settings. OPEN-R cannot read a setting back, so this class assumes that the camera
/// starts with Sony's defaults (protocol::version2::defaultCameraSettings()) and that no other object sets it.
///
/// The camera's primitive is opened when the first setting is changed.
class CameraControl {
 public:
  CameraControl();

  /// Opens the camera's primitive, unless it is open already.
  /// @return false if it does not open; the console says so
  bool Open();

  OPrimitiveID Id() const;

  /// @param value valid for the setting (protocol::version2::problemOfCameraValue())
  /// @return false if the robot refuses; in that case nothing changes, and the console says why
  bool Set(protocol::version2::CameraSetting setting, unsigned char value);

  const protocol::version2::CameraSettings& Settings() const { return settings_; }
  void ClientGone();

 private:
  bool Command(protocol::version2::CameraSetting setting, unsigned char value);

  Primitives camera_;
  protocol::version2::CameraSettings settings_;
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H
