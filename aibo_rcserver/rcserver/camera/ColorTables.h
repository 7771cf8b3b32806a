#ifndef AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_TABLES_H
#define AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_TABLES_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include "protocol/color_requests.h"
#include "rcserver/camera/CameraControl.h"

/// Loads tables into the camera, and knows which channels have one. The camera's primitive is opened for the first
/// table.
class ColorTables {
 public:
  /// @param channels number of channels that the camera has (robot_model.h)
  ColorTables(CameraControl& camera, int channels);
  ~ColorTables();

  int NumberOfChannels() const { return channels_; }

  /// The channels with a non-empty table, as bits like those in the pixels of the plane.
  unsigned char Loaded() const { return loaded_; }

  /// Replaces the table of a channel.
  /// @param table a table of a channel below NumberOfChannels()
  /// @return false if the robot refuses; in that case nothing changes, and the console says why
  bool Load(const protocol::version2::ColorTable& table);

  /// Empties all tables, for the next client.
  void ClientGone();

 private:
  ColorTables(const ColorTables&);
  ColorTables& operator=(const ColorTables&);

  bool CreateVector();
  bool Set(int number_of_tables);

  CameraControl& camera_;
  int channels_;
  unsigned char loaded_;
  MemoryRegionID memory_;
  OCdtVectorData* vector_;  ///< created for the first table, and NULL before
};

#endif  // AIBO_RCSERVER_RCSERVER_CAMERA_COLOR_TABLES_H
