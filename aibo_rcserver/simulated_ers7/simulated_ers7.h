/// @file simulated_ers7.h
/// A Sony Aibo ERS-7 without the metal, for openr_host::Machine.
///
/// What it has so far is its camera. It stands still and looks at a ball that rolls to and fro (scene.h), or shows
/// photographs (photo_show.h).
#ifndef SIMULATED_ERS7_SIMULATED_ERS7_H
#define SIMULATED_ERS7_SIMULATED_ERS7_H

#include <cstdint>
#include <memory>
#include <string>

#include "openr_host/virtual_robot.h"
#include "simulated_ers7/camera.h"
#include "simulated_ers7/picture_source.h"
#include "simulated_ers7/primitive_table.h"
#include "simulated_ers7/scene.h"

namespace simulated_ers7 {

struct SimulatedErs7Options {
  /// Folder with photographs for the camera to show in turn. Empty: the camera sees the scene.
  std::string images_folder;

  /// How long each photograph is shown, in seconds, above 0.
  double seconds_per_image = 2;

  /// Of the camera's noise. The same seed gives the same images.
  std::uint64_t seed = 1;
};

/// Not thread-safe; all calls come from the machine's thread.
class SimulatedErs7 : public openr_host::VirtualRobot {
 public:
  using Options = SimulatedErs7Options;

  /// @throw PhotographError if the photographs cannot be shown: the text names folder or file, and says what to do
  explicit SimulatedErs7(const Options& options = Options());

  std::string design() const override;
  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override;
  OStatus closePrimitive(OPrimitiveID id) override;
  OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size, void* result,
                           size_t result_size) override;
  bool cameraImageDue(longword frame) override;
  RCRegion* captureImage(longword frame) override;

  const CameraSettings& cameraSettings() const { return camera_.settings(); }

 private:
  PrimitiveTable primitives_;
  Scene scene_;
  std::unique_ptr<PictureSource> pictures_;
  Camera camera_;
};

}  // namespace simulated_ers7

#endif  // SIMULATED_ERS7_SIMULATED_ERS7_H
