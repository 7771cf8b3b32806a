#include "simulated_ers7/simulated_ers7.h"

#include <OPENR/ODataFormats.h>
#include <gtest/gtest.h>

#include <cstring>

#include "simulated_ers7/photograph.h"

namespace simulated_ers7 {
namespace {

constexpr char kCameraLocator[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";

class SimulatedErs7Test : public testing::Test {
 protected:
  OStatus control(OPrimitiveRequest request, longword value) {
    OPrimitiveControl_CameraParam param(value);
    return robot_.controlPrimitive(camera_, request, &param, sizeof(param), nullptr, 0);
  }

  OStatus control(OPrimitiveRequest request) {
    return robot_.controlPrimitive(camera_, request, nullptr, 0, nullptr, 0);
  }

  SimulatedErs7 robot_;
  OPrimitiveID camera_ = oprimitiveID_UNDEF;
};

TEST_F(SimulatedErs7Test, ItIsAnErs7) {
  EXPECT_EQ(robot_.design(), "ERS-7");
}

TEST_F(SimulatedErs7Test, TheCameraIsFoundAtItsLocatorOnly) {
  EXPECT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  OPrimitiveID other = 77;
  EXPECT_EQ(robot_.openPrimitive("PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F2", &other), oNOT_FOUND);
  EXPECT_EQ(robot_.openPrimitive("", &other), oNOT_FOUND);
  EXPECT_EQ(robot_.openPrimitive(nullptr, &other), oINVALID_ARG);
  EXPECT_EQ(other, 77u);
}

TEST_F(SimulatedErs7Test, APrimitiveStaysOpenUntilItIsClosedAsOftenAsOpened) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  OPrimitiveID again = 0;
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &again), oSUCCESS);
  EXPECT_EQ(again, camera_);
  EXPECT_EQ(robot_.closePrimitive(camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_AE_ON), oSUCCESS);
  EXPECT_EQ(robot_.closePrimitive(camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_AE_ON), oINVALID_PRIMITIVE_ID);
  EXPECT_EQ(robot_.closePrimitive(camera_), oINVALID_PRIMITIVE_ID);
}

TEST_F(SimulatedErs7Test, TheUndefinedPrimitiveClosesAll) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(robot_.closePrimitive(oprimitiveID_UNDEF), oSUCCESS);
  EXPECT_EQ(robot_.closePrimitive(camera_), oINVALID_PRIMITIVE_ID);
}

TEST_F(SimulatedErs7Test, TheCameraTakesItsSettings) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_WHITE_BALANCE, ocamparamWB_INDOOR_MODE), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, ocamparamGAIN_HIGH), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_SHUTTER_SPEED, ocamparamSHUTTER_SLOW), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_AE_ON), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_AWB_ON), oSUCCESS);
  EXPECT_EQ(robot_.cameraSettings().white_balance, ocamparamWB_INDOOR_MODE);
  EXPECT_EQ(robot_.cameraSettings().gain, ocamparamGAIN_HIGH);
  EXPECT_EQ(robot_.cameraSettings().shutter, ocamparamSHUTTER_SLOW);
  EXPECT_TRUE(robot_.cameraSettings().auto_exposure);
  EXPECT_TRUE(robot_.cameraSettings().auto_white_balance);
  EXPECT_EQ(control(oprmreqCAM_AE_OFF), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_AWB_OFF), oSUCCESS);
  EXPECT_FALSE(robot_.cameraSettings().auto_exposure);
  EXPECT_FALSE(robot_.cameraSettings().auto_white_balance);
}

TEST_F(SimulatedErs7Test, TheCameraRefusesWhatItDoesNotKnow) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, 0), oINVALID_ARG);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, 4), oINVALID_ARG);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN), oINVALID_ARG);
  EXPECT_EQ(control(383), oINVALID_ARG);
  EXPECT_EQ(control(392), oINVALID_ARG);
  EXPECT_EQ(robot_.cameraSettings().gain, ocamparamGAIN_MID);
}

TEST_F(SimulatedErs7Test, TwoRobotsWithTheSameSeedDeliverTheSameBytes) {
  SimulatedErs7 twin;
  for (longword frame = 0; frame < 50; ++frame) {
    const bool due = robot_.cameraImageDue(frame);
    ASSERT_EQ(due, twin.cameraImageDue(frame));
    if (due) {
      RCRegion* left = robot_.captureImage(frame);
      RCRegion* right = twin.captureImage(frame);
      ASSERT_EQ(left->Size(), right->Size());
      ASSERT_EQ(std::memcmp(left->Base(), right->Base(), left->Size()), 0) << "frame " << frame;
    }
  }
}

TEST_F(SimulatedErs7Test, AMissingFolderOfPicturesIsAnError) {
  SimulatedErs7::Options options;
  options.images_folder = "/nonexistent/pictures";
  EXPECT_THROW(SimulatedErs7{options}, PhotographError);
}

}  // namespace
}  // namespace simulated_ers7
