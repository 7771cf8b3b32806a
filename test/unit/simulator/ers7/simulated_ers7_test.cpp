// The robot as objects see it: docs/simulated_robot.md, and OPEN-R SDK Level2 Reference Guide.
#include "simulator/ers7/simulated_ers7.h"

#include <OPENR/OFbkImage.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "robot_model/robot_model.h"
#include "simulator/ers7/camera/scene_view.h"
#include "simulator/ers7/console_commands.h"
#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

using openr_host::EffectorCommand;
using openr_host::EffectorCommands;

constexpr char kCameraLocator[] = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";
constexpr char kWhiteLed[] = "PRM:/r1/c1/c2/c3/l2-LED2:l2";
constexpr char kFaceLed[] = "PRM:/r1/c1/c2/c3/la-LED3:la";
constexpr char kLeftEar[] = "PRM:/r1/c1/c2/c3/e5-Joint4:15";

class SimulatedErs7Test : public testing::Test {
 protected:
  explicit SimulatedErs7Test(const SimulatedErs7Options& options = {}) : robot_(options) {}

  OPrimitiveID open(const std::string& locator) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    EXPECT_EQ(robot_.openPrimitive(locator.c_str(), &id), oSUCCESS) << locator;
    return id;
  }
  const robot_model::Joint& joint(int index) const { return model_.joints[index]; }
  OPrimitiveID openJoint(const char* name) { return open(joint(robot_model::findJointByName(model_, name)).locator); }
  OPrimitiveID openSensor(const std::string& name) {
    return open(model_.sensors[robot_model::findSensorByName(model_, name.c_str())].locator);
  }
  int sensor(const std::string& name) {
    OSensorValue value = {};
    EXPECT_EQ(robot_.getSensorValue(openSensor(name), &value), oSUCCESS) << name;
    return value.value;
  }
  // Switches on a joint's motor.
  OPrimitiveID drive(const char* name) {
    const OPrimitiveID id = openJoint(name);
    robot_.setMotorPower(opowerON);
    EXPECT_EQ(robot_.enableJointGain(id), oSUCCESS);
    EXPECT_EQ(robot_.setDefaultJointGain(id), oSUCCESS);
    return id;
  }
  double positionOf(const char* name) const { return robot_.joints().named(name).position(); }
  OStatus control(OPrimitiveID id, OPrimitiveRequest request, longword value) {
    return robot_.controlPrimitive(id, request, &value, sizeof(value), nullptr, 0);
  }
  void pass(longword frames, const EffectorCommands& commands = {}) {
    for (longword i = 0; i < frames; ++i) {
      robot_.passFrame(frame_++, i == 0 ? commands : EffectorCommands());
    }
  }
  OPowerStatus power() { return powerOf(robot_); }
  static OPowerStatus powerOf(SimulatedErs7& robot) {
    OPowerStatus status;
    EXPECT_EQ(robot.getPowerStatus(&status), oSUCCESS);
    return status;
  }

  SimulatedErs7 robot_;
  const robot_model::RobotModel& model_ = *robot_model::findRobotModel(robot_.design().c_str());
  longword frame_ = 0;
};

template <typename Value>
EffectorCommand effectorCommand(OPrimitiveID id, ODataType type, const Value& value) {
  EffectorCommand command = {id, type, {}};
  std::memcpy(&command.value, &value, sizeof(value));
  return command;
}

EffectorCommand jointCommand(OPrimitiveID id, slongword position) {
  return effectorCommand(id, odataJOINT_COMMAND2, OJointCommandValue2{position, 0});
}
EffectorCommand earCommand(OPrimitiveID id, OJointValue4 state) {
  return effectorCommand(id, odataJOINT_COMMAND4, OJointCommandValue4{state, 1, 0});
}
EffectorCommand faceCommand(OPrimitiveID id, int intensity) {
  return effectorCommand(id, odataLED_COMMAND3, OLEDCommandValue3{static_cast<sword>(intensity), oled3_MODE_B, 1, 0});
}

TEST_F(SimulatedErs7Test, CallsForClosedPrimitivesOrOthersThanMeantAreRefused) {
  EffectorCommand led = jointCommand(drive("head_pan"), 100000);
  led.type = odataLED_COMMAND2;
  const OPrimitiveID closed = drive("tail_pan");
  EXPECT_EQ(robot_.closePrimitive(closed), oSUCCESS);
  pass(60, {led, jointCommand(closed, 100000), jointCommand(4711, 100000)});
  EXPECT_EQ(positionOf("head_pan"), 0);
  EXPECT_EQ(positionOf("tail_pan"), 0);
  for (const OPrimitiveID id : {open(kCameraLocator), closed, OPrimitiveID{0}, OPrimitiveID{4711}}) {
    OJointValue value;
    OSensorValue sensor_value;
    EXPECT_EQ(robot_.setJointGain(id, 8, 2, 4, 0x0E, 0x02, 0x0F), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.enableJointGain(id), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.disableJointGain(id), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.getJointValue(id, &value), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_EQ(robot_.getSensorValue(id, &sensor_value), oINVALID_PRIMITIVE_ID) << id;
    EXPECT_FALSE(robot_.takesCommand(id, odataJOINT_COMMAND2)) << id;
  }
}

TEST_F(SimulatedErs7Test, TheCameraAcceptsItsSettingsOnly) {
  const OPrimitiveID camera = open(kCameraLocator);
  const auto settings = [this] {
    const CameraSettings& now = robot_.cameraSettings();
    return std::tuple(now.white_balance, now.gain, now.shutter, now.auto_exposure, now.auto_white_balance);
  };
  const std::tuple<OPrimitiveRequest, longword, OStatus, decltype(settings())> rows[] = {
      {oprmreqCAM_SET_WHITE_BALANCE, 1, oSUCCESS, {1, 2, 2, false, false}},
      {oprmreqCAM_SET_GAIN, 3, oSUCCESS, {1, 3, 2, false, false}},
      {oprmreqCAM_SET_SHUTTER_SPEED, 3, oSUCCESS, {1, 3, 3, false, false}},
      {oprmreqCAM_AE_ON, 0, oSUCCESS, {1, 3, 3, true, false}},
      {oprmreqCAM_AWB_ON, 0, oSUCCESS, {1, 3, 3, true, true}},
      {oprmreqCAM_AE_OFF, 0, oSUCCESS, {1, 3, 3, false, true}},
      {oprmreqCAM_AWB_OFF, 0, oSUCCESS, {1, 3, 3, false, false}},
      {oprmreqCAM_SET_GAIN, 0, oINVALID_ARG, {1, 3, 3, false, false}},
      {oprmreqCAM_SET_GAIN, 4, oINVALID_ARG, {1, 3, 3, false, false}},
      {392, 1, oINVALID_ARG, {1, 3, 3, false, false}},
  };
  for (const auto& [request, value, status, expected] : rows) {
    EXPECT_EQ(control(camera, request, value), status) << request << " " << value;
    EXPECT_EQ(settings(), expected) << request << " " << value;
  }
  EXPECT_EQ(robot_.controlPrimitive(camera, oprmreqCAM_SET_GAIN, nullptr, 4, nullptr, 0), oINVALID_ARG);
}

TEST_F(SimulatedErs7Test, ItsCameraSeesTheRoomFromWhereHeadAndLegsPutIt) {
  pass(125, {jointCommand(drive("head_pan"), 200000), jointCommand(drive("left_front_elevator"), 350000),
             jointCommand(drive("right_front_elevator"), 350000)});
  void* const base = robot_.captureImage(frame_)->Base();
  auto* const vector = static_cast<OFbkImageVectorData*>(base);
  const OFbkImage image(vector->GetInfo(ofbkimageLAYER_H), vector->GetData(ofbkimageLAYER_H), ofbkimageBAND_Cr);

  Scene scene;
  scene.setTime(frame_ * openr_host::kFrameSeconds);
  SceneView view(scene, SimulatedErs7Options().seed);
  const YCrCbImage& expected = view.picture({robot_.joints().head(), robot_.travel().stance().body},
                                            frame_ * openr_host::kFrameSeconds, imagesUpTo(frame_), {});
  for (std::size_t i = 0; i < expected.cr.size(); ++i) {
    const auto place = static_cast<int>(i);
    ASSERT_EQ(image.Pixel(place % kPictureWidth, place / kPictureWidth), expected.cr[i]) << i;
  }
}

// Level2 Reference Guide, pages 53 to 57.
TEST_F(SimulatedErs7Test, TheSensorVectorHasTheLastFourFramesOfAllJointsAndSensors) {
  const OPrimitiveID pan = drive("head_pan");
  for (int frame = 0; frame < 8; ++frame) {
    robot_.press("chin", frame >= 6);
    pass(1, {jointCommand(pan, 10000 * frame)});
  }
  RCRegion* const region = robot_.captureSensors(7);
  void* const base = region->Base();
  auto* const vector = static_cast<OSensorFrameVectorData*>(base);
  EXPECT_EQ(vector->vectorInfo.type, odataSENSOR_FRAME_VECTOR);
  EXPECT_EQ(vector->vectorInfo.totalSize, region->Size());
  ASSERT_EQ(vector->vectorInfo.numData, 34U);
  std::set<OPrimitiveID> ids;
  for (int i = 0; i < 34; ++i) {
    const OSensorFrameInfo& info = *vector->GetInfo(i);
    EXPECT_EQ(info.type == odataJOINT_VALUE, i < 18) << i;
    EXPECT_EQ(info.frameNumber, 4U) << i;
    EXPECT_EQ(info.numFrames, 4U) << i;
    EXPECT_EQ(info.frameSize, 16U) << i;
    ids.insert(info.primitiveID);
    for (int frame = 0; frame < 4; ++frame) {
      const OSensorValue& value = vector->GetData(i)->frame[frame];
      if (info.primitiveID == openSensor("chin")) {
        EXPECT_EQ(value.value, frame >= 2 ? 1 : 0) << frame;
      } else if (info.primitiveID == pan) {
        EXPECT_EQ(reinterpret_cast<const OJointValue&>(value).refValue, 10000 * (4 + frame));
      }
    }
  }
  EXPECT_EQ(ids.size(), 34U);
}

TEST_F(SimulatedErs7Test, ButtonsAreReportedWhileTheyArePressed) {
  pass(1);
  EXPECT_EQ(sensor("wlan_switch"), 1) << "it is on at first";
  for (const std::string name : {"chin", "wlan_switch", "head_touch", "back_rear", "back_middle", "back_front"}) {
    const robot_model::Sensor& button = model_.sensors[robot_model::findSensorByName(model_, name.c_str())];
    for (const bool pressed : {true, false}) {
      obeyConsole(robot_, (pressed ? "press " : "release ") + name);
      pass(1);
      EXPECT_EQ(robot_model::isPressed(button, sensor(name), !pressed), pressed) << name;
    }
  }
}

TEST_F(SimulatedErs7Test, LedsKeepTheirLastCommand) {
  const OPrimitiveID white = open(kWhiteLed);
  const OPrimitiveID face = open(kFaceLed);
  EXPECT_FALSE(robot_.takesCommand(white, odataLED_COMMAND3));
  EXPECT_FALSE(robot_.takesCommand(face, odataLED_COMMAND2));
  for (const auto& [asked, shown] : {std::pair(-1, 0), {100, 100}, {256, 255}}) {
    pass(10, {effectorCommand(white, odataLED_COMMAND2, OLEDCommandValue2{oledON, 1, 0}), faceCommand(face, asked)});
    EXPECT_EQ(robot_.led("head_white").intensity, 255);
    EXPECT_EQ(robot_.led("face_1").intensity, shown);
    EXPECT_EQ(robot_.led("face_1").mode, oled3_MODE_B);
  }
  EXPECT_EQ(robot_.led("face_2").intensity, 0);
}

TEST_F(SimulatedErs7Test, ItsConsoleTellsWhereItIsAndWhatItsPartsDo) {
  pass(1, {faceCommand(open(kFaceLed), 100), earCommand(open("PRM:/r1/c1/c2/c3/e6-Joint4:16"), ojoint4_STATE1)});
  for (const char* answer : {"where 0.0000 0.0000 0.0000", "joint neck_tilt -25.00", "light face_1 100",
                             "light face_2 0", "ear left_ear let go", "ear right_ear drawn"}) {
    const std::string line = answer;
    const size_t words = line.find(' ', line[0] == 'w' ? 0 : line.find(' ') + 1);
    EXPECT_EQ(obeyConsole(robot_, line.substr(0, words)), "ok: " + line + "\n");
  }
}

TEST_F(SimulatedErs7Test, AnEarThatIsEnergisedForASecondDoesNothingForFive) {
  pass(125, {earCommand(open(kLeftEar), ojoint4_STATE1)});
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn());
  testing::internal::CaptureStdout();
  pass(1);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("WARNING left_ear was energised"));
  for (int frame = 0; frame < 625; ++frame) {
    EXPECT_TRUE(robot_.ear("left_ear").isHot()) << frame;
    EXPECT_FALSE(robot_.ear("left_ear").isDrawn()) << frame;
    pass(1);
  }
  pass(1);
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn()) << "it was never told to let go";
}

TEST_F(SimulatedErs7Test, TheBatteryRunsDownEvenlyAndWarmsUp) {
  SimulatedErs7::Options options;
  options.battery_minutes = 1.5;
  SimulatedErs7 robot(options);
  const OPowerStatus full = powerOf(robot);
  EXPECT_EQ(full.remainingCapacity, 100);
  EXPECT_EQ(full.fullyChargedCapacity, 2200) << "mAh";
  EXPECT_EQ(full.voltage, 8200) << "mV";
  EXPECT_NEAR(full.temperature, 2982, 1) << "25 degrees Celsius, in tenths of a kelvin";
  EXPECT_EQ(full.robotStatus, orsbBATTERY_CONNECTED);
  EXPECT_EQ(power().current, -1466) << "mA, for 90 minutes";
  robot.setMotorPower(opowerON);
  for (longword frame = 0; frame < 45 * 125; ++frame) {
    robot.passFrame(frame, {});
  }
  const OPowerStatus half = powerOf(robot);
  EXPECT_EQ(half.remainingCapacity, 50);
  EXPECT_EQ(half.voltage, 7500);
  EXPECT_EQ(half.robotStatus, orsbBATTERY_CONNECTED | orsbMOTOR_POWER);
  EXPECT_NEAR(half.temperature - full.temperature, 130 * (1 - std::exp(-45 / 600.0)), 1) << "on the way to 38 degrees";
}

TEST_F(SimulatedErs7Test, TheBatteryIsLowAtTenPercent) {
  const std::tuple<double, int, bool, bool> rows[] = {
      // charge, percent, low, empty
      {0.87, 87, false, false},
      {0.101, 10, false, false},
      {0.1, 10, true, false},
      {0, 0, true, true},
  };
  for (const auto& [charge, percent, is_low, is_empty] : rows) {
    robot_.setCharge(charge);
    EXPECT_EQ(power().remainingCapacity, percent);
    EXPECT_EQ((power().robotStatus & orsbBATTERY_CAPACITY_LOW) != 0, is_low) << charge;
    EXPECT_EQ((power().batteryStatus & obsbREMAINING_CAPACITY_ALARM) != 0, is_low) << charge;
    EXPECT_EQ((power().batteryStatus & obsbFULLY_DISCHARGED) != 0, is_empty) << charge;
  }
}

TEST_F(SimulatedErs7Test, AfterARebootNothingThatAProgramHasSetIsLeft) {
  const OPrimitiveID camera = open(kCameraLocator);
  control(camera, oprmreqCAM_SET_GAIN, 3);
  control(open("PRM:/s1-Speaker:S1"), oprmreqSPEAKER_SET_SOUND_TYPE, ospksndMONO16K16B);
  pass(10, {jointCommand(drive("head_pan"), 500000), faceCommand(open(kFaceLed), 100),
            earCommand(open(kLeftEar), ojoint4_STATE1)});
  const double pan = positionOf("head_pan");
  robot_.switchOff();
  pass(60);
  EXPECT_EQ(control(camera, oprmreqCAM_SET_GAIN, 1), oINVALID_PRIMITIVE_ID) << "it is closed";
  EXPECT_EQ(robot_.cameraSettings().gain, ocamparamGAIN_MID);
  EXPECT_EQ(robot_.soundTypeOf(open("PRM:/s1-Speaker:S1")), ospksndMONO8K8B);
  EXPECT_EQ(robot_.led("face_1").intensity, 0);
  EXPECT_FALSE(robot_.ear("left_ear").isDrawn());
  EXPECT_EQ(power().robotStatus & orsbMOTOR_POWER, 0U);
  drive("head_pan");
  pass(60);
  EXPECT_NEAR(positionOf("head_pan"), pan, 1) << "the command is forgotten";
}

TEST_F(SimulatedErs7Test, WhatPeopleHaveDoneWithItOutlastsAReboot) {
  robot_.press("chin", true);
  robot_.press(kPauseButton, true);
  robot_.setCharge(0.3);
  robot_.stick().set(StickState::kLocked);
  robot_.lift(true);
  robot_.jam("head_pan", true);
  robot_.switchOff();
  pass(125, {jointCommand(drive("head_pan"), 500000)});
  EXPECT_EQ(positionOf("head_pan"), 0);
  EXPECT_EQ(sensor("chin"), 1);
  EXPECT_EQ(sensor("paw_left_front"), 0);
  EXPECT_EQ(power().remainingCapacity, 30);
  EXPECT_NE(power().robotStatus & orsbPAUSE, 0U);
  EXPECT_EQ(robot_.stick().status(), omemorystickWRITE_PROTECTED);
}

TEST(SimulatedErs7OnATable, StandsOnItsTop) {
  SimulatedErs7Options options;
  options.on_table = true;
  SimulatedErs7 robot(options);
  robot.passFrame(0, {});
  const double height = robot.travel().stance().body.translation().z();
  EXPECT_NEAR(height, kTableHeight + kStandingHeight, 0.001);
  EXPECT_NEAR(robot.scene().castRay({{0, 0, height}, {0, 0, -1}}).distance, height - kTableHeight, 1e-9);
}

// Model Information ERS-210, section 2: its joints, sensors and LEDs.
class SimulatedErs210 : public SimulatedErs7Test {
 protected:
  SimulatedErs210() : SimulatedErs7Test(options()) {}
  static SimulatedErs7Options options() {
    SimulatedErs7Options options;
    options.design = "ERS-210";
    return options;
  }
};

TEST_F(SimulatedErs210, HasItsOwnJoints) {
  EffectorCommands commands;
  for (int i = 0; i < model_.number_of_joints; ++i) {
    commands.push_back(jointCommand(drive(joint(i).name), joint(i).highest));
  }
  pass(250, commands);
  for (int i = 0; i < model_.number_of_joints; ++i) {
    EXPECT_NEAR(positionOf(joint(i).name), joint(i).highest, 1);
  }
  EXPECT_EQ(robot_.joints().head().neck_tilt, SimulatedErs7().joints().head().neck_tilt) << "at rest";
}

TEST_F(SimulatedErs210, HasItsOwnSensorsLightsAndEars) {
  robot_.press("head_front", true);
  const OPrimitiveID ear = open("PRM:/r1/c1/c2/c3/e1-Joint3:j5");
  EXPECT_FALSE(robot_.takesCommand(ear, odataJOINT_COMMAND4));
  pass(1, {effectorCommand(open("PRM:/r6/l1-LED2:l1"), odataLED_COMMAND2, OLEDCommandValue2{oledON, 1, 0}),
           effectorCommand(ear, odataJOINT_COMMAND3, ojoint3_STATE1)});
  EXPECT_EQ(robot_.led("tail_blue").intensity, 255);
  EXPECT_TRUE(robot_.ear("left_ear").isDrawn());
  EXPECT_GT(sensor("head_front"), 0);
  open("PRM:/r1/c1/c2/c3/s1-Speaker:S1");
  open(kCameraLocator);
}

}  // namespace
}  // namespace simulated_ers7
