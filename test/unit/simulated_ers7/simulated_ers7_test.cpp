#include "simulated_ers7/simulated_ers7.h"

#include <OPENR/ODataFormats.h>
#include <OPENR/OFbkImage.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <map>
#include <set>
#include <vector>

#include "robot_model/robot_model.h"
#include "simulated_ers7/camera_optics.h"
#include "simulated_ers7/photograph.h"
#include "simulated_ers7/resting_posture.h"

namespace simulated_ers7 {
namespace {

constexpr char kCameraLocator[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";

/// Middle of all pixels that are pink in a part of the picture around a place.
Eigen::Vector2d middleOfPink(RCRegion* region, const Eigen::Vector2d& around) {
  void* base = region->Base();
  auto* vector = static_cast<OFbkImageVectorData*>(base);
  OFbkImage cr(vector->GetInfo(ofbkimageLAYER_H), vector->GetData(ofbkimageLAYER_H), ofbkimageBAND_Cr);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      const Eigen::Vector2d place(x + 0.5, y + 0.5);
      if (cr.Pixel(x, y) > 165 && (place - around).norm() < 17) {
        sum += place;
        ++count;
      }
    }
  }
  return sum / count;
}

class SimulatedErs7Test : public testing::Test {
 protected:
  OStatus control(OPrimitiveRequest request, longword value) {
    OPrimitiveControl_CameraParam param(value);
    return robot_.controlPrimitive(camera_, request, &param, sizeof(param), nullptr, 0);
  }

  OStatus control(OPrimitiveRequest request) {
    return robot_.controlPrimitive(camera_, request, nullptr, 0, nullptr, 0);
  }

  static const robot_model::RobotModel& model() { return *robot_model::findRobotModel("ERS-7"); }

  OPrimitiveID openJoint(const char* name) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    const robot_model::Joint& joint = model().joints[robot_model::findJointByName(model(), name)];
    EXPECT_EQ(robot_.openPrimitive(joint.locator, &id), oSUCCESS);
    return id;
  }

  /// Opens a joint and switches everything on that it needs.
  OPrimitiveID driveJoint(const char* name) {
    const OPrimitiveID id = openJoint(name);
    EXPECT_EQ(robot_.setMotorPower(opowerON), oSUCCESS);
    EXPECT_EQ(robot_.setJointGain(id, 8, 2, 4, 0x0E, 0x02, 0x0F), oSUCCESS);
    EXPECT_EQ(robot_.enableJointGain(id), oSUCCESS);
    return id;
  }

  static openr_host::EffectorCommand jointCommand(OPrimitiveID id, slongword position) {
    openr_host::EffectorCommand command = {id, odataJOINT_COMMAND2, {}};
    const OJointCommandValue2 value = {position, 0};
    std::memcpy(&command.value, &value, sizeof(value));
    return command;
  }

  void passFrames(longword count) {
    for (longword i = 0; i < count; ++i) {
      robot_.passFrame(frame_++, {});
    }
  }

  SimulatedErs7 robot_;
  longword frame_ = 0;
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

TEST_F(SimulatedErs7Test, All18JointsAreFoundAtTheirLocators) {
  std::set<OPrimitiveID> ids;
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  ids.insert(camera_);
  for (int i = 0; i < model().number_of_joints; ++i) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    ASSERT_EQ(robot_.openPrimitive(model().joints[i].locator, &id), oSUCCESS) << model().joints[i].name;
    OJointValue value;
    EXPECT_EQ(robot_.getJointValue(id, &value), oSUCCESS);
    EXPECT_GE(value.value, model().joints[i].lowest) << model().joints[i].name;
    EXPECT_LE(value.value, model().joints[i].highest) << model().joints[i].name;
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 19u);
}

TEST_F(SimulatedErs7Test, WhatIsNotOpenOrNoJointIsRefused) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  OPrimitiveID closed = openJoint("head_pan");
  ASSERT_EQ(robot_.closePrimitive(closed), oSUCCESS);
  for (const OPrimitiveID id : {camera_, closed, OPrimitiveID{0}, OPrimitiveID{20}, OPrimitiveID{4711}}) {
    OJointValue value;
    OSensorValue sensor_value;
    EXPECT_EQ(robot_.setJointGain(id, 8, 2, 4, 0x0E, 0x02, 0x0F), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.enableJointGain(id), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.disableJointGain(id), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.getJointValue(id, &value), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.getSensorValue(id, &sensor_value), oINVALID_PRIMITIVE_ID) << id;
  }
  OJointValue value;
  EXPECT_EQ(robot_.getJointValue(oprimitiveID_UNDEF, &value), oINVALID_PRIMITIVE_ID) << "which one?";
  EXPECT_EQ(robot_.getJointValue(openJoint("mouth"), nullptr), oINVALID_ARG);
}

TEST_F(SimulatedErs7Test, TheUndefinedPrimitiveMeansAllOpenJoints) {
  const OPrimitiveID pan = openJoint("head_pan");
  const OPrimitiveID tail = openJoint("tail_pan");
  EXPECT_EQ(robot_.enableJointGain(oprimitiveID_UNDEF), oFAIL) << "no power";
  ASSERT_EQ(robot_.setMotorPower(opowerON), oSUCCESS);
  ASSERT_EQ(robot_.setJointGain(oprimitiveID_UNDEF, 8, 2, 4, 0x0E, 0x02, 0x0F), oSUCCESS);
  ASSERT_EQ(robot_.enableJointGain(oprimitiveID_UNDEF), oSUCCESS);
  robot_.passFrame(0, {jointCommand(pan, 100000), jointCommand(tail, 200000)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 100000);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000);
  ASSERT_EQ(robot_.disableJointGain(oprimitiveID_UNDEF), oSUCCESS);
  robot_.passFrame(61, {jointCommand(pan, 0), jointCommand(tail, 0)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 100000);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000);
}

TEST_F(SimulatedErs7Test, CommandsForWhatIsNotOpenOrOfAnotherKindChangeNothing) {
  const OPrimitiveID pan = driveJoint("head_pan");
  const OPrimitiveID closed = driveJoint("tail_pan");
  ASSERT_EQ(robot_.closePrimitive(closed), oSUCCESS);
  openr_host::EffectorCommand led = jointCommand(pan, 100000);
  led.type = odataLED_COMMAND2;
  EXPECT_TRUE(robot_.takesCommand(pan, odataJOINT_COMMAND2));
  EXPECT_FALSE(robot_.takesCommand(pan, odataLED_COMMAND2));
  EXPECT_FALSE(robot_.takesCommand(closed, odataJOINT_COMMAND2));
  EXPECT_FALSE(robot_.takesCommand(4711, odataJOINT_COMMAND2));
  robot_.passFrame(0, {led, jointCommand(closed, 100000), jointCommand(4711, 100000)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 0);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 0);
}

TEST_F(SimulatedErs7Test, EachFramesCommandCountsFromThatFrameOn) {
  const OPrimitiveID pan = driveJoint("head_pan");
  OJointValue value;
  for (slongword i = 1; i <= 8; ++i) {
    robot_.passFrame(frame_++, {jointCommand(pan, 10000 * i)});
    ASSERT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
    EXPECT_EQ(value.refValue, 10000 * i);
  }
  passFrames(60);
  ASSERT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
  EXPECT_NEAR(value.value, 80000, 873) << "the last one holds";
}

TEST_F(SimulatedErs7Test, AJammedJointSaysSo) {
  const OPrimitiveID pan = driveJoint("head_pan");
  robot_.jam("head_pan", true);
  robot_.passFrame(frame_++, {jointCommand(pan, 500000)});
  passFrames(63);
  OJointValue value;
  EXPECT_EQ(robot_.getJointValue(pan, &value), oALERT_JOINT_UNCONTROLLABLE);
  EXPECT_NEAR(value.value, 0, 873);
  EXPECT_EQ(value.pwmDuty, 512);
  robot_.jam("head_pan", false);
  passFrames(60);
  EXPECT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
  EXPECT_NEAR(value.value, 500000, 873);
}

TEST_F(SimulatedErs7Test, TheSensorVectorHasTheLastFourFramesOfAllJoints) {
  std::map<OPrimitiveID, const char*> names;
  for (int i = 0; i < model().number_of_joints; ++i) {
    names[openJoint(model().joints[i].name)] = model().joints[i].name;
  }
  const OPrimitiveID pan = driveJoint("head_pan");
  std::map<OPrimitiveID, std::vector<OJointValue>> reported;
  for (; frame_ < 8; ++frame_) {
    robot_.passFrame(frame_, {jointCommand(pan, 10000 * static_cast<slongword>(frame_ + 1))});
    for (const auto& [id, name] : names) {
      OJointValue value;
      robot_.getJointValue(id, &value);
      reported[id].push_back(value);
    }
  }

  RCRegion* region = robot_.captureSensors(7);
  void* base = region->Base();
  auto* vector = static_cast<OSensorFrameVectorData*>(base);
  EXPECT_EQ(vector->vectorInfo.type, odataSENSOR_FRAME_VECTOR);
  EXPECT_EQ(vector->vectorInfo.totalSize, region->Size());
  EXPECT_EQ(vector->vectorInfo.infoOffset, 192u);
  EXPECT_EQ(vector->vectorInfo.infoSize, 32u);
  ASSERT_EQ(vector->vectorInfo.numData, 18u);
  longword end_of_last = 192 + 18 * 32;
  for (int i = 0; i < 18; ++i) {
    const OSensorFrameInfo& info = *vector->GetInfo(i);
    ASSERT_EQ(names.count(info.primitiveID), 1u);
    SCOPED_TRACE(names[info.primitiveID]);
    EXPECT_EQ(info.type, odataJOINT_VALUE);
    EXPECT_EQ(info.frameNumber, 4u);
    EXPECT_EQ(info.numFrames, 4u);
    EXPECT_EQ(info.frameSize, 16u);
    EXPECT_EQ(info.dataSize, 256u);
    ASSERT_GE(info.dataOffset, end_of_last) << "entries overlap";
    end_of_last = info.dataOffset + info.dataSize;
    ASSERT_LE(end_of_last, region->Size());
    for (std::size_t frame = 0; frame < 4; ++frame) {
      const OJointValue& expected = reported[info.primitiveID][4 + frame];
      EXPECT_EQ(std::memcmp(&vector->GetData(i)->frame[frame], &expected, sizeof(expected)), 0) << frame;
    }
    names.erase(info.primitiveID);
  }
  EXPECT_TRUE(names.empty()) << "a joint is missing";
}

TEST_F(SimulatedErs7Test, ASensorVectorThatIsStillReadIsNotWrittenAgain) {
  passFrames(4);
  RCRegion* kept = robot_.captureSensors(3);
  kept->AddReference();
  passFrames(4);
  RCRegion* next = robot_.captureSensors(7);
  EXPECT_NE(next, kept);
  kept->RemoveReference();
  passFrames(4);
  EXPECT_EQ(robot_.captureSensors(11), kept);
}

TEST_F(SimulatedErs7Test, WhenTheHeadPansLeftTheBallMovesRightByAsManyPixelsAsTheLensSays) {
  const longword kBallPeriodFrames = 750;  // 6 s: the ball is in the same place again
  Scene scene;
  scene.setTime(0);
  const auto expectedPlace = [&scene](const HeadAngles& head) {
    const Eigen::Isometry3d camera = Eigen::Translation3d(0, 0, kStandingHeight) * cameraInBody(head);
    return placeOf(camera.inverse() * scene.ballCenter());
  };
  HeadAngles head = restingHead();
  const Eigen::Vector2d expected_before = expectedPlace(head);
  head.head_pan = 0.2;
  const Eigen::Vector2d expected_after = expectedPlace(head);

  robot_.passFrame(frame_++, {});
  ASSERT_TRUE(robot_.cameraImageDue(0));
  const Eigen::Vector2d before = middleOfPink(robot_.captureImage(0), expected_before);
  const OPrimitiveID pan = driveJoint("head_pan");
  robot_.passFrame(frame_++, {jointCommand(pan, 200000)});
  passFrames(kBallPeriodFrames - 1);
  ASSERT_TRUE(robot_.cameraImageDue(kBallPeriodFrames));
  const Eigen::Vector2d after = middleOfPink(robot_.captureImage(kBallPeriodFrames), expected_after);

  EXPECT_LT((before - expected_before).norm(), 1) << before.transpose();
  EXPECT_LT((after - expected_after).norm(), 1) << after.transpose();
  // By hand: 0.2 rad are 191.9 * tan(0.2) = 39 pixels on the axis of sight, and some more for a camera that is carried
  // aside while it turns.
  EXPECT_NEAR(after.x() - before.x(), 43, 4);
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
