/// @file fake_robot.h
#ifndef TEST_OPENR_HOST_FAKE_ROBOT_H
#define TEST_OPENR_HOST_FAKE_ROBOT_H

#include <OPENR/ODataFormats.h>

#include <set>
#include <string>
#include <vector>

#include "openr_host/virtual_robot.h"

namespace openr_host {

/// A robot whose camera has an image in the frames that a test names, 4x1 pixels with the frame number as field
/// counter.
class FakeRobot : public VirtualRobot {
 public:
  ~FakeRobot() override {
    if (image_ != nullptr) {
      image_->RemoveReference();
    }
  }

  std::set<longword> frames_with_image;
  std::vector<longword> frames_seen;
  std::vector<longword> frames_captured;

  RCRegion* image() const { return image_; }

  std::string design() const override { return "ERS-7"; }

  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override {
    *id = 42;
    return std::string(locator) == "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1" ? oSUCCESS : oNOT_FOUND;
  }

  OStatus closePrimitive(OPrimitiveID id) override { return id == 42 ? oSUCCESS : oINVALID_PRIMITIVE_ID; }

  OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size, void* /*result*/,
                           size_t /*result_size*/) override {
    if (id != 42) {
      return oINVALID_PRIMITIVE_ID;
    }
    return request == oprmreqCAM_SET_GAIN && param_size == sizeof(OPrimitiveControl_CameraParam) &&
                   static_cast<OPrimitiveControl_CameraParam*>(param)->param == ocamparamGAIN_HIGH
               ? oSUCCESS
               : oINVALID_ARG;
  }

  bool cameraImageDue(longword frame) override {
    frames_seen.push_back(frame);
    return frames_with_image.count(frame) != 0;
  }

  RCRegion* captureImage(longword frame) override {
    frames_captured.push_back(frame);
    if (image_ == nullptr) {
      image_ = new RCRegion(sizeof(OFbkImageVectorData) + 3 * 4);
    }
    void* base = image_->Base();
    auto* vector = static_cast<OFbkImageVectorData*>(base);
    OFbkImageInfo& info = *vector->GetInfo(ofbkimageLAYER_H);
    info.type = odataFBK_YCrCb;
    info.dataOffset = sizeof(OFbkImageVectorData);
    info.width = 4;
    info.height = 1;
    vector->GetData(ofbkimageLAYER_H)[0] = static_cast<byte>(frame);
    return image_;
  }

 private:
  RCRegion* image_ = nullptr;
};

}  // namespace openr_host

#endif  // TEST_OPENR_HOST_FAKE_ROBOT_H
