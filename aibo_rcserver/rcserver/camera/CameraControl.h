#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include "protocol/camera_settings.h"
#include "protocol/color_requests.h"
#include "rcserver/body/Primitives.h"

/// Sets the camera, keeps its settings, and loads the tables of its colour detection. OPEN-R cannot read a setting
/// back, so this class assumes that the camera starts with Sony's defaults
/// (protocol::version2::defaultCameraSettings()) and that no other object sets it.
///
/// The camera's primitive is opened when the first setting is changed, or for the first table.
class CameraControl {
 public:
  /// @param channels number of channels for colours that the camera has (robot_model.h)
  explicit CameraControl(int channels);
  ~CameraControl();

  /// @param value valid for the setting (protocol::version2::problemOfCameraValue())
  /// @return false if the robot refuses; in that case nothing changes, and the console says why
  bool Set(protocol::version2::CameraSetting setting, unsigned char value);

  const protocol::version2::CameraSettings& Settings() const { return settings_; }
  int NumberOfChannels() const { return channels_; }

  /// The channels with a non-empty table, as bits like those in the pixels of the plane.
  unsigned char LoadedTables() const { return loaded_; }

  /// Replaces the table of a channel.
  /// @param table a table of a channel below NumberOfChannels()
  /// @return false if the robot refuses; in that case nothing changes, and the console says why
  bool Load(const protocol::version2::ColorTable& table);

  /// Restores the default settings and empties all tables, for the next client.
  void ClientGone();

 private:
  CameraControl(const CameraControl&);
  CameraControl& operator=(const CameraControl&);

  bool Open();
  OPrimitiveID Id() const;
  bool Command(protocol::version2::CameraSetting setting, unsigned char value);
  bool CreateVector();
  bool SetTables(int number_of_tables);

  Primitives camera_;
  protocol::version2::CameraSettings settings_;
  int channels_;
  unsigned char loaded_;
  MemoryRegionID memory_;
  OCdtVectorData* vector_;  ///< created for the first table, and NULL before
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_CAMERA_CONTROL_H
