#include "simulated_ers7/simulated_ers7.h"

#include "simulated_ers7/photo_show.h"
#include "simulated_ers7/scene_view.h"

namespace simulated_ers7 {
namespace {

std::unique_ptr<PictureSource> makePictures(const SimulatedErs7::Options& options, Scene& scene) {
  if (!options.images_folder.empty()) {
    return std::make_unique<PhotoShow>(options.images_folder, options.seconds_per_image);
  }
  return std::make_unique<SceneView>(scene, options.seed);
}

}  // namespace

SimulatedErs7::SimulatedErs7(const Options& options)
    : pictures_(makePictures(options, scene_)), camera_(*pictures_, kCameraPrimitive) {}

std::string SimulatedErs7::design() const {
  return "ERS-7";
}

OStatus SimulatedErs7::openPrimitive(const char* locator, OPrimitiveID* id) {
  return primitives_.open(locator, id);
}

OStatus SimulatedErs7::closePrimitive(OPrimitiveID id) {
  return primitives_.close(id);
}

OStatus SimulatedErs7::controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size,
                                        void* /*result*/, size_t /*result_size*/) {
  if (!primitives_.isOpen(id)) {
    return oINVALID_PRIMITIVE_ID;
  }
  return id == kCameraPrimitive ? camera_.control(request, param, param_size) : oINVALID_ARG;
}

bool SimulatedErs7::cameraImageDue(longword frame) {
  return camera_.imageDue(frame);
}

RCRegion* SimulatedErs7::captureImage(longword frame) {
  return camera_.capture(frame);
}

}  // namespace simulated_ers7
