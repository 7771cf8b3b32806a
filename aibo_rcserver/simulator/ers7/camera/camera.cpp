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

std::size_t distance(const void* from, const void* to) {
  return static_cast<std::size_t>(static_cast<const byte*>(to) - static_cast<const byte*>(from));
}

OStatus turn(bool on, bool* setting) {
  *setting = on;
  return oSUCCESS;
}

}  // namespace

Camera::Camera(PictureSource& source, OPrimitiveID id)
    : source_(source), regions_(fbkImageSize(), [this, id](RCRegion* region) {
        prepareFbkImage(region, id);
        images_.try_emplace(region, region);
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
  Image& image = images_.at(region);
  image.exposure = {frame, pose, settings_, colors_};
  image.largest_colors.fillBy([this, &image] { drawLargestColors(image); });
  image.others.fillBy([this, &image] { draw(image); });
  if (drawn_ == &image) {
    drawn_ = nullptr;
  }
  return region;
}

void Camera::reset() {
  settings_ = CameraSettings();
  colors_.clear();
}

Camera::Image::Image(RCRegion* region_)
    : region(region_),
      largest_colors(region->Base(), distance(region->Base(), otherBands(region))),
      others(otherBands(region), region->Size() - distance(region->Base(), otherBands(region))) {}

/// With colour detection, the whole image is drawn, because the result is in the tag of layer H. If the same photograph
/// is already in the region, only its tag changes, and announceFbkImage() has written this.
void Camera::drawLargestColors(Image& image) {
  if (image.exposure.colors.isOn()) {
    openr_host::FilledOnRead::read(otherBands(image.region));
    return;
  }
  const YCrCbImage& picture = pictureOf(image);
  if (image.written != &picture) {
    simulated_ers7::drawLargestColors(image.region, picture, imagesUpTo(image.exposure.frame));
  }
  image.written = source_.hasConstantPictures() ? &picture : nullptr;
}

void Camera::draw(Image& image) {
  image.written = nullptr;
  drawFbkImage(image.region, pictureOf(image), image.exposure.colors, imagesUpTo(image.exposure.frame));
}

const YCrCbImage& Camera::pictureOf(const Image& image) {
  if (drawn_ != &image) {
    const Exposure& exposure = image.exposure;
    const double seconds = exposure.frame * openr_host::kFrameSeconds;
    picture_ = &source_.picture(exposure.pose, seconds, imagesUpTo(exposure.frame), exposure.settings);
    drawn_ = &image;
  }
  return *picture_;
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
