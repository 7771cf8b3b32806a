#include "simulator/ers7/simulated_ers7.h"

#include <OPENR/ODataFormats.h>
#include <OPENR/OFbkImage.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "effector_command.h"
#include "robot_model/robot_model.h"
#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/body/stance.h"
#include "simulator/ers7/camera/camera_optics.h"
#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

constexpr char kCameraLocator[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";

OFbkImage bandIn(RCRegion* region, OFbkImageBand band = ofbkimageBAND_Cr) {
  void* base = region->Base();
  auto* vector = static_cast<OFbkImageVectorData*>(base);
  return OFbkImage(vector->GetInfo(ofbkimageLAYER_H), vector->GetData(ofbkimageLAYER_H), band);
}

/// The camera draws what is read.
void draw(RCRegion* region) {
  bandIn(region).Pointer();
}

/// Centre of all pink pixels in the part of the picture around a point.
Eigen::Vector2d middleOfPink(RCRegion* region, const Eigen::Vector2d& around) {
  const OFbkImage cr = bandIn(region);
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

  OPrimitiveID openSensor(const std::string& name) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    const robot_model::Sensor& sensor = model().sensors[robot_model::findSensorByName(model(), name.c_str())];
    EXPECT_EQ(robot_.openPrimitive(sensor.locator, &id), oSUCCESS) << name;
    return id;
  }

  int sensorValue(const std::string& name) {
    OSensorValue value = {};
    EXPECT_EQ(robot_.getSensorValue(openSensor(name), &value), oSUCCESS) << name;
    return value.value;
  }

  OPrimitiveID openLocator(const char* locator) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    EXPECT_EQ(robot_.openPrimitive(locator, &id), oSUCCESS) << locator;
    return id;
  }

  openr_host::EffectorCommand earCommand(OPrimitiveID id, OJointValue4 state) {
    return effectorCommand(id, odataJOINT_COMMAND4, OJointCommandValue4{state, 1, 0});
  }

  /// The bytes of an open joint's or sensor's reading.
  OSensorValue readingOf(OPrimitiveID id) {
    OSensorValue value;
    OJointValue joint_value;
    if (robot_.getSensorValue(id, &value) != oSUCCESS) {
      robot_.getJointValue(id, &joint_value);
      std::memcpy(&value, &joint_value, sizeof(value));
    }
    return value;
  }

  /// Opens a joint and switches on its gain and power.
  OPrimitiveID driveJoint(const char* name) {
    const OPrimitiveID id = openJoint(name);
    EXPECT_EQ(robot_.setMotorPower(opowerON), oSUCCESS);
    EXPECT_EQ(robot_.enableJointGain(id), oSUCCESS);
    EXPECT_EQ(robot_.setJointGain(id, 8, 2, 4, 0x0E, 0x02, 0x0F), oSUCCESS);
    return id;
  }

  static openr_host::EffectorCommand jointCommand(OPrimitiveID id, slongword position) {
    return effectorCommand(id, odataJOINT_COMMAND2, OJointCommandValue2{position, 0});
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

TEST_F(SimulatedErs7Test, ClosingTheUndefinedPrimitiveClosesAll) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(robot_.closePrimitive(oprimitiveID_UNDEF), oSUCCESS);
  EXPECT_EQ(robot_.closePrimitive(camera_), oINVALID_PRIMITIVE_ID);
}

TEST_F(SimulatedErs7Test, TheCameraAcceptsItsSettings) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_WHITE_BALANCE, 1), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, 3), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_SHUTTER_SPEED, 2), oSUCCESS);
  const std::pair<OPrimitiveRequest, std::pair<bool, bool>> automatic[] = {{oprmreqCAM_AE_ON, {true, false}},
                                                                           {oprmreqCAM_AWB_ON, {true, true}},
                                                                           {oprmreqCAM_AE_OFF, {false, true}},
                                                                           {oprmreqCAM_AWB_OFF, {false, false}}};
  for (const auto& [request, expected] : automatic) {
    EXPECT_EQ(control(request), oSUCCESS);
    const CameraSettings& now = robot_.cameraSettings();
    EXPECT_EQ(std::tuple(now.white_balance, now.gain, now.shutter), std::tuple(1U, 3U, 2U));
    EXPECT_EQ(std::pair(now.auto_exposure, now.auto_white_balance), expected);
  }
}

TEST_F(SimulatedErs7Test, TablesOfColoursNeedTheOpenCamera) {
  OCdtVectorData tables{};
  tables.SetNumData(1);
  tables.GetInfo(0)->Init(1, ocdtCHANNEL0);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oINVALID_PRIMITIVE_ID);
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  tables.GetInfo(0)->Init(openJoint("head_pan"), ocdtCHANNEL0);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oINVALID_PRIMITIVE_ID);
  tables.GetInfo(0)->Init(camera_, ocdtCHANNEL0);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oSUCCESS);
  tables.GetInfo(0)->Init(camera_, ocdtCHANNEL7);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oINVALID_ARG);
  tables.SetNumData(2);
  tables.GetInfo(0)->Init(camera_, ocdtCHANNEL0);
  for (int segment = 0; segment < ocdtMAX_Y_SEGMENT; ++segment) {
    tables.GetInfo(0)->Set(segment, 255, 0, 255, 0);
  }
  tables.GetInfo(1)->Init(camera_ + 1, ocdtCHANNEL1);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oINVALID_PRIMITIVE_ID);
  EXPECT_EQ(bandIn(robot_.captureImage(0), ofbkimageBAND_Y).ColorFrequency(ocdtCHANNEL0), 0)
      << "nothing of it is loaded";
  tables.GetInfo(1)->Init(camera_, ocdtCHANNEL7);
  EXPECT_EQ(robot_.setCdtVectorData(tables), oINVALID_ARG);
}

TEST_F(SimulatedErs7Test, TheCameraRefusesUnknownRequests) {
  ASSERT_EQ(robot_.openPrimitive(kCameraLocator, &camera_), oSUCCESS);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, 0), oINVALID_ARG);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN, 4), oINVALID_ARG);
  EXPECT_EQ(control(oprmreqCAM_SET_GAIN), oINVALID_ARG);
  longword gain[2] = {ocamparamGAIN_LOW, 0};
  EXPECT_EQ(robot_.controlPrimitive(camera_, oprmreqCAM_SET_GAIN, gain, sizeof(gain), nullptr, 0), oINVALID_ARG);
  EXPECT_EQ(robot_.controlPrimitive(camera_, oprmreqCAM_SET_GAIN, nullptr, sizeof(gain[0]), nullptr, 0), oINVALID_ARG);
  EXPECT_EQ(robot_.getPowerStatus(nullptr), oINVALID_ARG);
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

TEST_F(SimulatedErs7Test, CallsForClosedPrimitivesOrOtherThanJointsAreRefused) {
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
  EXPECT_EQ(robot_.getJointValue(oprimitiveID_UNDEF, &value), oINVALID_PRIMITIVE_ID) << "reading needs one joint";
  EXPECT_EQ(robot_.getJointValue(openJoint("mouth"), nullptr), oINVALID_ARG);
}

TEST_F(SimulatedErs7Test, TheUndefinedPrimitiveMeansAllOpenJoints) {
  const OPrimitiveID pan = openJoint("head_pan");
  const OPrimitiveID tail = openJoint("tail_pan");
  ASSERT_EQ(robot_.setMotorPower(opowerON), oSUCCESS);
  ASSERT_EQ(robot_.enableJointGain(tail), oSUCCESS);
  EXPECT_EQ(robot_.setJointGain(oprimitiveID_UNDEF, 8, 2, 4, 0x0E, 0x02, 0x0F), oGAIN_DISABLED);
  robot_.passFrame(0, {jointCommand(tail, 200000)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000) << "one joint's error is not the others'";
  ASSERT_EQ(robot_.enableJointGain(oprimitiveID_UNDEF), oSUCCESS);
  ASSERT_EQ(robot_.setJointGain(oprimitiveID_UNDEF, 8, 2, 4, 0x0E, 0x02, 0x0F), oSUCCESS);
  robot_.setMotorPower(opowerOFF);
  robot_.passFrame(0, {jointCommand(pan, 100000), jointCommand(tail, 0)});
  passFrames(9);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 0);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000);
  robot_.setMotorPower(opowerON);
  robot_.passFrame(0, {jointCommand(tail, 200000)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 100000);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000);
  ASSERT_EQ(robot_.disableJointGain(oprimitiveID_UNDEF), oSUCCESS);
  robot_.passFrame(61, {jointCommand(pan, 0), jointCommand(tail, 0)});
  passFrames(60);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 100000);
  EXPECT_EQ(robot_.joints().named("tail_pan").position(), 200000);
}

TEST_F(SimulatedErs7Test, CommandsForClosedPrimitivesOrOfTheWrongTypeChangeNothing) {
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

TEST_F(SimulatedErs7Test, ACommandTakesEffectFromItsFrameOn) {
  const OPrimitiveID pan = driveJoint("head_pan");
  OJointValue value;
  for (slongword i = 1; i <= 8; ++i) {
    robot_.passFrame(frame_++, {jointCommand(pan, 10000 * i)});
    ASSERT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
    EXPECT_EQ(value.refValue, 10000 * i);
  }
  passFrames(60);
  ASSERT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
  EXPECT_NEAR(value.value, 80000, 873) << "the last command stays in effect";
}

// GetJointValue() fails only for a wrong primitive (Level2 Reference Guide, page 72).
TEST_F(SimulatedErs7Test, AJammedJointShowsInItsDuty) {
  const OPrimitiveID pan = driveJoint("head_pan");
  robot_.jam("head_pan", true);
  robot_.passFrame(frame_++, {jointCommand(pan, 500000)});
  passFrames(63);
  OJointValue value;
  EXPECT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
  EXPECT_NEAR(value.value, 0, 873);
  EXPECT_EQ(value.pwmDuty, 512);
  robot_.jam("head_pan", false);
  passFrames(60);
  EXPECT_EQ(robot_.getJointValue(pan, &value), oSUCCESS);
  EXPECT_NEAR(value.value, 500000, 873);
}

TEST_F(SimulatedErs7Test, TheSensorVectorHasTheLastFourFramesOfAllJointsAndSensors) {
  std::map<OPrimitiveID, const char*> names;
  for (int i = 0; i < model().number_of_joints; ++i) {
    names[openJoint(model().joints[i].name)] = model().joints[i].name;
  }
  const std::size_t joints = names.size();
  for (int i = 0; i < model().number_of_sensors; ++i) {
    if (model().sensors[i].locator != nullptr) {
      names[openSensor(model().sensors[i].name)] = model().sensors[i].name;
    }
  }
  const OPrimitiveID pan = driveJoint("head_pan");
  std::map<OPrimitiveID, std::vector<OSensorValue>> reported;
  for (; frame_ < 8; ++frame_) {
    robot_.passFrame(frame_, {jointCommand(pan, 10000 * static_cast<slongword>(frame_ + 1))});
    for (const auto& [id, name] : names) {
      reported[id].push_back(readingOf(id));
    }
  }

  RCRegion* region = robot_.captureSensors(7);
  void* base = region->Base();
  auto* vector = static_cast<OSensorFrameVectorData*>(base);
  EXPECT_EQ(vector->vectorInfo.type, odataSENSOR_FRAME_VECTOR);
  EXPECT_EQ(vector->vectorInfo.totalSize, region->Size());
  EXPECT_EQ(vector->vectorInfo.infoOffset, 192u);
  EXPECT_EQ(vector->vectorInfo.infoSize, 32u);
  ASSERT_EQ(vector->vectorInfo.numData, 34u);
  longword end_of_last = 192 + 34 * 32;
  for (int i = 0; i < 34; ++i) {
    const OSensorFrameInfo& info = *vector->GetInfo(i);
    ASSERT_EQ(names.count(info.primitiveID), 1u);
    SCOPED_TRACE(names[info.primitiveID]);
    EXPECT_EQ(info.type == odataJOINT_VALUE, static_cast<std::size_t>(i) < joints);
    EXPECT_EQ(info.frameNumber, 4u);
    EXPECT_EQ(info.numFrames, 4u);
    EXPECT_EQ(info.frameSize, 16u);
    EXPECT_EQ(info.dataSize, 256u);
    ASSERT_GE(info.dataOffset, end_of_last) << "entries overlap";
    end_of_last = info.dataOffset + info.dataSize;
    ASSERT_LE(end_of_last, region->Size());
    for (std::size_t frame = 0; frame < 4; ++frame) {
      const OSensorValue& expected = reported[info.primitiveID][4 + frame];
      EXPECT_EQ(std::memcmp(&vector->GetData(i)->frame[frame], &expected, sizeof(expected)), 0) << frame;
    }
    names.erase(info.primitiveID);
  }
  EXPECT_TRUE(names.empty()) << "a joint or sensor is missing";
}

TEST_F(SimulatedErs7Test, ButtonsAreReportedWhileTheyArePressed) {
  for (const char* name : {"chin", "paw_left_hind", "wlan_switch", "head_touch", "back_middle"}) {
    const robot_model::Sensor& sensor = model().sensors[robot_model::findSensorByName(model(), name)];
    robot_.press(name, true);
    passFrames(1);
    EXPECT_TRUE(robot_model::isPressed(sensor, sensorValue(name), false)) << name;
    robot_.press(name, false);
  }
  passFrames(1);
  for (const char* name : {"chin", "wlan_switch", "head_touch", "back_middle"}) {
    const robot_model::Sensor& sensor = model().sensors[robot_model::findSensorByName(model(), name)];
    EXPECT_FALSE(robot_model::isPressed(sensor, sensorValue(name), true)) << name;
  }
}

TEST_F(SimulatedErs7Test, CallsForClosedPrimitivesOrOtherThanSensorsAreRefused) {
  OSensorValue value;
  EXPECT_EQ(robot_.getSensorValue(openJoint("head_pan"), &value), oINVALID_PRIMITIVE_ID);
  const OPrimitiveID chin = openSensor("chin");
  EXPECT_EQ(robot_.getSensorValue(chin, nullptr), oINVALID_ARG);
  ASSERT_EQ(robot_.closePrimitive(chin), oSUCCESS);
  EXPECT_EQ(robot_.getSensorValue(chin, &value), oINVALID_PRIMITIVE_ID);
  const auto refusal = [&] {
    try {
      robot_.press("range_near", true);
      return std::string("none");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  const std::string first = refusal();
  EXPECT_EQ(first.rfind("there is no \"range_near\" to press; there are ", 0), 0U) << first;
  EXPECT_EQ(refusal(), first);
}

TEST_F(SimulatedErs7Test, OnlyTheSwitchOfALiftedPawIsOff) {
  for (const std::string leg : {"left_front", "left_hind", "right_front", "right_hind"}) {
    const OPrimitiveID knee = driveJoint((leg + "_knee").c_str());
    robot_.passFrame(frame_++, {jointCommand(knee, 1900000)});
    passFrames(100);
    for (const std::string paw : {"left_front", "left_hind", "right_front", "right_hind"}) {
      EXPECT_EQ(sensorValue("paw_" + paw), paw != leg) << leg;
    }
    robot_.press("paw_" + leg, true);
    passFrames(1);
    EXPECT_EQ(sensorValue("paw_" + leg), 1) << "by hand";
    robot_.press("paw_" + leg, false);
    robot_.passFrame(frame_++, {jointCommand(knee, restingPosition(leg + "_knee"))});
    passFrames(100);
  }
}

TEST_F(SimulatedErs7Test, OnATableItStandsOnItsTop) {
  SimulatedErs7::Options options;
  options.on_table = true;
  SimulatedErs7 robot(options);
  robot.passFrame(0, {});
  const double height = robot.travel().stance().body.translation().z();
  EXPECT_DOUBLE_EQ(height, kTableHeight + robot_.travel().stance().body.translation().z());
  EXPECT_NEAR(robot.scene().castRay({{0, 0, height}, {0, 0, -1}}).distance, height - kTableHeight, 1e-9);
}

TEST_F(SimulatedErs7Test, LedsKeepTheirLastCommandUntilTheRobotIsSwitchedOff) {
  const OPrimitiveID white = openLocator("PRM:/r1/c1/c2/c3/l2-LED2:l2");
  const OPrimitiveID face = openLocator("PRM:/r1/c1/c2/c3/la-LED3:la");
  EXPECT_TRUE(robot_.takesCommand(white, odataLED_COMMAND2));
  EXPECT_FALSE(robot_.takesCommand(white, odataLED_COMMAND3));
  EXPECT_FALSE(robot_.takesCommand(face, odataLED_COMMAND2));
  robot_.passFrame(frame_++, {effectorCommand(white, odataLED_COMMAND2, OLEDCommandValue2{oledON, 1, 0}),
                              effectorCommand(face, odataLED_COMMAND3, OLEDCommandValue3{100, oled3_MODE_B, 1, 0})});
  passFrames(10);
  EXPECT_EQ(robot_.led("head_white").intensity, 255);
  EXPECT_EQ(robot_.led("face_1").intensity, 100);
  EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
  EXPECT_EQ(robot_.led("face_2").intensity, 0);
  robot_.switchOff();
  EXPECT_EQ(robot_.led("head_white").intensity, 0);
  EXPECT_EQ(robot_.led("face_1").intensity, 0);
  EXPECT_THROW(robot_.led("nose"), std::invalid_argument);
  for (const auto& [asked, shown] : {std::pair(-1, 0), std::pair(256, 255)}) {
    robot_.passFrame(frame_++, {effectorCommand(openLocator("PRM:/r1/c1/c2/c3/la-LED3:la"), odataLED_COMMAND3,
                                                OLEDCommandValue3{static_cast<sword>(asked), oled3_MODE_A, 1, 0})});
    EXPECT_EQ(robot_.led("face_1").intensity, shown);
  }
}

TEST_F(SimulatedErs7Test, WhatPeopleHaveDoneWithItOutlastsAReboot) {
  robot_.press("chin", true);
  robot_.press(kPauseButton, true);
  robot_.setCharge(0.3);
  robot_.stick().set(StickState::kLocked);
  robot_.lift(true);
  robot_.jam("head_pan", true);
  passFrames(10);
  EXPECT_LT(sensorValue("acceleration_up_down"), -10200000) << "it goes up";
  passFrames(115);
  robot_.switchOff();
  const OPrimitiveID pan = driveJoint("head_pan");
  robot_.passFrame(frame_++, {jointCommand(pan, 500000)});
  passFrames(125);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 0);
  EXPECT_EQ(sensorValue("chin"), 1);
  EXPECT_EQ(sensorValue("paw_left_front"), 0);
  OPowerStatus power;
  robot_.getPowerStatus(&power);
  EXPECT_EQ(power.remainingCapacity, 30);
  EXPECT_NE(power.robotStatus & orsbPAUSE, 0U);
  EXPECT_EQ(robot_.stick().status(), omemorystickWRITE_PROTECTED);
}

TEST_F(SimulatedErs7Test, APulseDrawsAnEarAndASecondMakesItTooHot) {
  const OPrimitiveID left = openLocator("PRM:/r1/c1/c2/c3/e5-Joint4:15");
  robot_.passFrame(frame_++, {earCommand(left, ojoint4_STATE1)});
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn());
  EXPECT_FALSE(robot_.ear("right_ear").isDrawn());
  robot_.passFrame(frame_++, {earCommand(left, ojoint4_STATE0)});
  EXPECT_FALSE(robot_.ear("left_ear").isDrawn());

  const OPrimitiveID right = openLocator("PRM:/r1/c1/c2/c3/e6-Joint4:16");
  robot_.passFrame(frame_++, {earCommand(left, ojoint4_STATE1), earCommand(right, ojoint4_STATE1)});
  passFrames(124);
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn());
  testing::internal::CaptureStdout();
  passFrames(1);
  const std::string too_long = " was energised for 1000 ms without a pause and is too hot now: let it go\n";
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "WARNING left_ear" + too_long + "WARNING right_ear" + too_long);
  EXPECT_TRUE(robot_.ear("left_ear").isHot());
  EXPECT_TRUE(robot_.ear("right_ear").isHot());
  EXPECT_THROW(robot_.ear("nose"), std::invalid_argument);
  EXPECT_FALSE(robot_.ear("left_ear").isDrawn());
  passFrames(625);
  EXPECT_FALSE(robot_.ear("left_ear").isHot());
  passFrames(125);
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn()) << "it was never told to let go";
  passFrames(1);
  EXPECT_TRUE(robot_.ear("left_ear").isHot());
}

TEST_F(SimulatedErs7Test, TheBatteryRunsDownInTheConfiguredTimeAndWarmsUp) {
  SimulatedErs7::Options options;
  options.battery_minutes = 1.5;
  SimulatedErs7 robot(options);
  OPowerStatus full;
  ASSERT_EQ(robot.getPowerStatus(&full), oSUCCESS);
  EXPECT_EQ(full.remainingCapacity, 100);
  EXPECT_EQ(full.fullyChargedCapacity, 2200) << "mAh";
  EXPECT_EQ(full.voltage, 8200) << "mV";
  EXPECT_EQ(full.robotStatus, orsbBATTERY_CONNECTED);
  EXPECT_EQ(full.current, -32767) << "mA; no more fit";
  OPowerStatus usual;
  ASSERT_EQ(robot_.getPowerStatus(&usual), oSUCCESS);
  EXPECT_EQ(usual.current, -1466) << "in 90 minutes";
  robot_.setCharge(0.3);
  ASSERT_EQ(robot_.getPowerStatus(&usual), oSUCCESS);
  EXPECT_EQ(usual.current, -1466) << "as ever";
  robot.setMotorPower(opowerON);
  longword frame = 0;
  const auto passSeconds = [&](longword seconds) {
    for (const longword end = frame + 125 * seconds; frame < end; ++frame) {
      robot.passFrame(frame, {});
    }
  };
  passSeconds(45);
  OPowerStatus half;
  ASSERT_EQ(robot.getPowerStatus(&half), oSUCCESS);
  EXPECT_EQ(half.remainingCapacity, 50);
  EXPECT_EQ(half.robotStatus, orsbBATTERY_CONNECTED | orsbMOTOR_POWER);
  EXPECT_EQ(half.voltage, 7500);
  EXPECT_NEAR(half.temperature - full.temperature, 130 * (1 - std::exp(-45 / 600.0)), 1) << "a tenth of 38 - 25";
  EXPECT_NEAR(full.temperature, 2982, 1) << "25 degrees Celsius, in tenths of a kelvin";
  passSeconds(46);
  OPowerStatus empty;
  ASSERT_EQ(robot.getPowerStatus(&empty), oSUCCESS);
  EXPECT_EQ(empty.remainingCapacity, 0);
  EXPECT_NE(empty.robotStatus & orsbBATTERY_CAPACITY_LOW, 0u);
  robot.setCharge(0.87);
  ASSERT_EQ(robot.getPowerStatus(&half), oSUCCESS);
  EXPECT_EQ(half.remainingCapacity, 87);
  passSeconds(3);
  ASSERT_EQ(robot.getPowerStatus(&half), oSUCCESS);
  EXPECT_EQ(half.remainingCapacity, 84) << "it runs down from there";
  const std::tuple<double, bool, bool> low_and_empty[] = {{0.101, false, false}, {0.1, true, false}, {0, true, true}};
  for (const auto& [charge, is_low, is_empty] : low_and_empty) {
    robot.setCharge(charge);
    OPowerStatus status;
    ASSERT_EQ(robot.getPowerStatus(&status), oSUCCESS);
    EXPECT_EQ((status.robotStatus & orsbBATTERY_CAPACITY_LOW) != 0, is_low) << charge;
    EXPECT_EQ((status.batteryStatus & obsbREMAINING_CAPACITY_ALARM) != 0, is_low) << charge;
    EXPECT_EQ((status.batteryStatus & obsbFULLY_DISCHARGED) != 0, is_empty) << charge;
  }
}

TEST_F(SimulatedErs7Test, ASensorVectorInUseIsNotOverwritten) {
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

TEST_F(SimulatedErs7Test, WhenTheHeadPansLeftTheBallMovesRightAsTheLensPredicts) {
  const longword kBallPeriodFrames = 750;  // 6 s, after which the ball is in the same place again
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
  // By hand: 0.2 rad are 191.9 * tan(0.2) = 39 pixels on the optical axis, and a few more because the turning head
  // moves the camera sideways.
  EXPECT_NEAR(after.x() - before.x(), 43, 4);
}

TEST_F(SimulatedErs7Test, WhenTheFrontLegsSpreadTheCameraLooksDownWithTheBody) {
  const longword kBallPeriodFrames = 750;  // 6 s, after which the ball is where it started
  std::vector<openr_host::EffectorCommand> commands;
  for (const char* name : {"left_front_elevator", "right_front_elevator"}) {
    commands.push_back(jointCommand(driveJoint(name), 350000));
  }
  robot_.passFrame(frame_++, commands);
  passFrames(kBallPeriodFrames);
  ASSERT_TRUE(robot_.cameraImageDue(kBallPeriodFrames));

  Scene scene;
  scene.setTime(0);
  const Eigen::Isometry3d level(Eigen::Translation3d(0, 0, kStandingHeight));
  const Eigen::Isometry3d body = standOn(robot_.joints().legs()).body;
  const auto placeFrom = [&scene](const Eigen::Isometry3d& pose) {
    return placeOf((pose * cameraInBody(restingHead())).inverse() * scene.ballCenter());
  };
  ASSERT_LT(placeFrom(body).y(), placeFrom(level).y() - 5) << "the ball is higher in the picture";
  const Eigen::Vector2d seen = middleOfPink(robot_.captureImage(kBallPeriodFrames), placeFrom(body));
  EXPECT_LT((seen - placeFrom(body)).norm(), 1) << seen.transpose();
}

TEST_F(SimulatedErs7Test, TheBallRollsWithTheFrames) {
  Scene scene;
  for (const longword frame : {100U, 300U}) {
    scene.setTime(frame * openr_host::kFrameSeconds);
    robot_.passFrame(frame, {});
    EXPECT_TRUE(robot_.scene().ballCenter().isApprox(scene.ballCenter(), 1e-9)) << frame;
  }
}

TEST_F(SimulatedErs7Test, LegsThatSwingBackPushTheRobotAhead) {
  const char* const names[] = {"left_front_rotator", "right_front_rotator", "left_hind_rotator", "right_hind_rotator"};
  for (int swung = 0; swung <= 200000; swung += 2000) {
    std::vector<openr_host::EffectorCommand> commands;
    for (const char* name : names) {
      commands.push_back(jointCommand(driveJoint(name), restingPosition(name) - swung));
    }
    robot_.passFrame(frame_++, commands);
  }
  passFrames(20);
  EXPECT_NEAR(robot_.pose().x, 0.2 * kStandingHeight, 0.001) << "their feet roll over the floor";
  EXPECT_NEAR(robot_.pose().y, 0, 0.001);
  EXPECT_NEAR(robot_.pose().yaw, 0, 0.01);
}

TEST_F(SimulatedErs7Test, OnlyRobotsWithTheSameSeedDeliverTheSameBytes) {
  SimulatedErs7::Options options;
  SimulatedErs7 twin(options);
  options.seed = 2;
  SimulatedErs7 other(options);
  const auto captured = [](SimulatedErs7& robot, longword frame) {
    RCRegion* const region = robot.captureImage(frame);
    draw(region);
    return std::string(region->Base(), region->Size());
  };
  for (longword frame = 0; frame < 48; ++frame) {
    for (SimulatedErs7* const robot : {&robot_, &twin, &other}) {
      robot->passFrame(frame, {});
    }
    const bool due = robot_.cameraImageDue(frame);
    ASSERT_EQ(twin.cameraImageDue(frame), due);
    ASSERT_EQ(other.cameraImageDue(frame), due);
    if (due) {
      const std::string image = captured(robot_, frame);
      ASSERT_TRUE(image == captured(twin, frame)) << "frame " << frame;
      ASSERT_FALSE(image == captured(other, frame)) << "frame " << frame;
    }
  }
  const auto readings = [](SimulatedErs7& robot) {
    void* const base = robot.captureSensors(47)->Base();
    auto* const vector = static_cast<OSensorFrameVectorData*>(base);
    std::vector<std::pair<ODataType, std::string>> all;
    for (int i = 0; i < 34; ++i) {
      const void* const frames = vector->GetData(i)->frame;
      all.emplace_back(vector->GetInfo(i)->type,
                       std::string(static_cast<const char*>(frames), 4 * sizeof(OSensorValue)));
    }
    return all;
  };
  const auto own = readings(robot_);
  const auto others = readings(other);
  EXPECT_TRUE(own == readings(twin));
  std::set<ODataType> differing;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i] != others[i]) {
      differing.insert(own[i].first);
    }
  }
  EXPECT_EQ(differing, (std::set<ODataType>{odataJOINT_VALUE, odataACCELERATION, odataLENGTH, odataNO_DIMENSION}))
      << "whatever is measured; touch has no dimension";
}

class SimulatedErs210Test : public testing::Test {
 protected:
  SimulatedErs210Test() : robot_(options()) { robot_.setMotorPower(opowerON); }

  static SimulatedErs7::Options options() {
    SimulatedErs7::Options options;
    options.design = "ERS-210";
    return options;
  }

  OPrimitiveID open(const char* locator) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    EXPECT_EQ(robot_.openPrimitive(locator, &id), oSUCCESS) << locator;
    return id;
  }

  int sensor(const char* locator) {
    OSensorValue value = {};
    EXPECT_EQ(robot_.getSensorValue(open(locator), &value), oSUCCESS) << locator;
    return value.value;
  }

  SimulatedErs7 robot_;
};

// Model Information ERS-210, section 2: its joints, sensors and LEDs.
TEST_F(SimulatedErs210Test, ItsOwnJointsMove) {
  EXPECT_EQ(robot_.design(), "ERS-210");
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-210");
  openr_host::EffectorCommands commands;
  for (int i = 0; i < model.number_of_joints; ++i) {
    const OPrimitiveID id = open(model.joints[i].locator);
    robot_.enableJointGain(id);
    robot_.setDefaultJointGain(id);
    commands.push_back(effectorCommand(id, odataJOINT_COMMAND2, OJointCommandValue2{model.joints[i].highest, 0}));
  }
  for (longword frame = 0; frame < 250; ++frame) {
    robot_.passFrame(frame, commands);
  }
  for (int i = 0; i < model.number_of_joints; ++i) {
    EXPECT_NEAR(robot_.joints().named(model.joints[i].name).position(), model.joints[i].highest, 1);
  }
}

TEST_F(SimulatedErs210Test, ItsOwnSensorsLightsAndEarsWork) {
  robot_.press("head_front", true);
  const OPrimitiveID led = open("PRM:/r6/l1-LED2:l1");
  const OPrimitiveID ear = open("PRM:/r1/c1/c2/c3/e1-Joint3:j5");
  EXPECT_TRUE(robot_.takesCommand(ear, odataJOINT_COMMAND3));
  EXPECT_FALSE(robot_.takesCommand(ear, odataJOINT_COMMAND4));
  robot_.passFrame(0, {effectorCommand(led, odataLED_COMMAND2, OLEDCommandValue2{oledON, 1, 0}),
                       effectorCommand(ear, odataJOINT_COMMAND3, ojoint3_STATE1)});
  EXPECT_EQ(robot_.led("tail_blue").intensity, 255);
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn());
  EXPECT_GT(sensor("PRM:/r1/c1/c2/c3/f2-Sensor:f2"), 0);
  EXPECT_EQ(sensor("PRM:/r1/c1/c2/c3/f1-Sensor:f1"), 0);
  EXPECT_GE(sensor("PRM:/r1/c1/c2/c3/p1-Sensor:p1"), 100000);
  EXPECT_GT(sensor("PRM:/r6/t1-Sensor:t1"), 0);
  open("PRM:/r1/c1/c2/c3/s1-Speaker:S1");
  open(kCameraLocator);
}

}  // namespace
}  // namespace simulated_ers7
