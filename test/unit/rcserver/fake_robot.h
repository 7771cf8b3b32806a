/// @file fake_robot.h
/// A robot with nothing but a camera, whose every image tells which one it is.
#ifndef TEST_FAKE_ROBOT_H
#define TEST_FAKE_ROBOT_H

#include <OPENR/ODataFormats.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

#include "openr_host/virtual_robot.h"

/// Takes an image every four frames, beginning with frame 4. Each has one brightness all over, which is another one
/// than that of the ten images before and after.
class FakeRobot : public openr_host::VirtualRobot {
 public:
  static constexpr longword kFramesPerImage = 4;
  static constexpr size_t kWidth = 208;
  static constexpr size_t kHeight = 160;

  FakeRobot() : region_(new RCRegion(sizeof(OFbkImageVectorData) + 3 * kWidth * kHeight)) {}
  ~FakeRobot() override { region_->RemoveReference(); }
  FakeRobot(const FakeRobot&) = delete;
  FakeRobot& operator=(const FakeRobot&) = delete;

  /// Brightness of an image, by its number.
  static int brightness(unsigned image) { return 25 + 10 * static_cast<int>(image % 20); }

  /// Number of the image that was taken last.
  unsigned lastImage() const { return image_; }

  /// From now on images are noise, which makes the largest pictures there are.
  void showNoise() { noise_ = true; }

  std::string design() const override { return "ERS-7"; }
  OStatus openPrimitive(const char*, OPrimitiveID*) override { return oNOT_FOUND; }
  OStatus closePrimitive(OPrimitiveID) override { return oINVALID_PRIMITIVE_ID; }
  OStatus controlPrimitive(OPrimitiveID, OPrimitiveRequest, void*, size_t, void*, size_t) override {
    return oINVALID_PRIMITIVE_ID;
  }

  bool cameraImageDue(longword frame) override {
    const longword image = frame / kFramesPerImage;
    const bool due = image != image_;
    image_ = image;
    return due;
  }

  RCRegion* captureImage(longword frame) override {
    auto* vector = reinterpret_cast<OFbkImageVectorData*>(region_->Base());
    OFbkImageInfo* info = vector->GetInfo(ofbkimageLAYER_H);
    info->type = odataFBK_YCrCb;
    info->frameNumber = frame;
    info->dataOffset = sizeof(OFbkImageVectorData);
    info->dataSize = 3 * kWidth * kHeight;
    info->width = kWidth;
    info->height = kHeight;
    byte* pixels = vector->GetData(ofbkimageLAYER_H);
    for (size_t row = 0; row < kHeight; ++row) {
      std::fill_n(pixels + 3 * kWidth * row, kWidth, static_cast<byte>(brightness(image_)));
      std::fill_n(pixels + 3 * kWidth * row + kWidth, 2 * kWidth, byte{128});
    }
    if (noise_) {
      std::generate_n(pixels, 3 * kWidth * kHeight, [this] { return static_cast<byte>(random_() & 0xff); });
    }
    byte* tag = pixels + 3 * kWidth * (kHeight - 1);
    tag[0] = static_cast<byte>(image_ & 0xff);
    tag[1] = static_cast<byte>(image_ >> 8);
    return region_;
  }

 private:
  RCRegion* region_;
  unsigned image_ = 0;
  bool noise_ = false;
  std::minstd_rand random_;
};

#endif  // TEST_FAKE_ROBOT_H
