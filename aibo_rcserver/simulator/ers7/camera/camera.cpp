#include "simulator/ers7/camera/camera.h"

#include <cstring>

#include "simulator/ers7/camera/fbk_image_writer.h"
#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

/// Each of the three settings has the values 1, 2 and 3.
OStatus choose(const void* param, size_t param_size, longword* setting) {
  longword value = 0;
  if (param == nullptr || param_size != sizeof(OPrimitiveControl_CameraParam)) {
    return oINVALID_ARG;
  }
  std::memcpy(&value, param, sizeof(value));
  if (value < 1 || value > 3) {
    return oINVALID_ARG;
  }
  *setting = value;
  return oSUCCESS;
}

OStatus turn(bool on, bool* setting) {
  *setting = on;
  return oSUCCESS;
}

}  // namespace

Camera::Camera(PictureSource& source, OPrimitiveID id)
    : source_(source), regions_(fbkImageSize(), [this, id](RCRegion* region) {
        prepareFbkImage(region, id);
        pixels_.try_emplace(region, region->Base(), region->Size());
      }) {}

bool Camera::imageDue(longword frame) {
  const longword images = imagesUpTo(frame);
  const bool due = images != images_seen_;
  images_seen_ = images;
  return due;
}

RCRegion* Camera::capture(longword frame, const CameraPose& pose) {
  RCRegion* region = regions_.freeRegion();
  announceFbkImage(region, frame, imagesUpTo(frame));
  pixels_.at(region).fillBy(
      [this, region, exposure = Exposure{frame, pose, settings_, colors_}] { draw(exposure, region); });
  return region;
}

void Camera::reset() {
  settings_ = CameraSettings();
  colors_.clear();
}

void Camera::draw(const Exposure& exposure, RCRegion* region) {
  const longword image_number = imagesUpTo(exposure.frame);
  source_.setHead(exposure.pose.head);
  source_.setBody(exposure.pose.body);
  const double seconds = exposure.frame * openr_host::kFrameSeconds;
  drawFbkImage(region, source_.picture(seconds, image_number, exposure.settings), exposure.colors, image_number);
}

OStatus Camera::control(OPrimitiveRequest request, const void* param, size_t param_size) {
  switch (request) {
    case oprmreqCAM_SET_WHITE_BALANCE:
      return choose(param, param_size, &settings_.white_balance);
    case oprmreqCAM_SET_GAIN:
      return choose(param, param_size, &settings_.gain);
    case oprmreqCAM_SET_SHUTTER_SPEED:
      return choose(param, param_size, &settings_.shutter);
    case oprmreqCAM_AE_ON:
    case oprmreqCAM_AE_OFF:
      return turn(request == oprmreqCAM_AE_ON, &settings_.auto_exposure);
    case oprmreqCAM_AWB_ON:
    case oprmreqCAM_AWB_OFF:
      return turn(request == oprmreqCAM_AWB_ON, &settings_.auto_white_balance);
    default:
      return oINVALID_ARG;
  }
}

}  // namespace simulated_ers7
