#include "simulator/ers7/camera/camera.h"

#include "simulator/ers7/camera/fbk_image_writer.h"
#include "simulator/ers7/camera_timing.h"

namespace simulated_ers7 {

Camera::Camera(PictureSource& source, OPrimitiveID id)
    : source_(source), regions_(fbkImageSize(), [id](RCRegion* region) { prepareFbkImage(region, id); }) {}

bool Camera::imageDue(longword frame) {
  const longword images = imagesUpTo(frame);
  const bool due = images != images_seen_;
  images_seen_ = images;
  return due;
}

RCRegion* Camera::capture(longword frame) {
  const longword image_number = imagesUpTo(frame);
  RCRegion* region = regions_.freeRegion();
  writeFbkImage(region, source_.picture(frame * kFrameSeconds, image_number, settings_), frame, image_number);
  return region;
}

OStatus Camera::control(OPrimitiveRequest request, const void* param, size_t param_size) {
  return controlCamera(request, param, param_size, &settings_);
}

}  // namespace simulated_ers7
