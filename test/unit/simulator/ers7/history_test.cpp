// Whatever a program has done with the robot, and wherever it was cut off: afterwards the robot is as a fresh one.
#include <OPENR/OFbkImage.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "effector_command.h"
#include "robot_model/robot_model.h"
#include "simulator/ers7/camera/scene_view.h"
#include "simulator/ers7/console_commands.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/temporary_folder.h"

namespace simulated_ers7 {
namespace {

using openr_host::EffectorCommand;
using openr_host::EffectorCommands;
using openr_host::SpeakerFrame;

/// All that a robot has shown: texts, and measurements with a sensor's error.
struct Record {
  std::vector<std::string> lines;
  std::vector<double> measurements;

  template <typename... Parts>
  void add(const Parts&... parts) {
    std::ostringstream line;
    line.precision(10);
    ((line << parts << ' '), ...);
    lines.push_back(line.str());
  }
};

/// The whole picture in an image's region, which is drawn for it.
std::string pixelsIn(RCRegion* region) {
  void* base = region->Base();
  auto* vector = static_cast<OFbkImageVectorData*>(base);
  const byte* const first = vector->GetData(ofbkimageLAYER_H);
  for (const OFbkImageLayer layer : {ofbkimageLAYER_H, ofbkimageLAYER_M, ofbkimageLAYER_L, ofbkimageLAYER_C}) {
    const auto band = layer == ofbkimageLAYER_C ? ofbkimageBAND_CDT : ofbkimageBAND_Y_HH;
    OFbkImage(vector->GetInfo(layer), vector->GetData(layer), band).Pointer();
  }
  OFbkImage(vector->GetInfo(ofbkimageLAYER_H), vector->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y).Pointer();
  const char* const end = region->Base() + region->Size();
  return std::string(reinterpret_cast<const char*>(first), end);
}

/// Draws Y, Cr and Cb of the largest layer only.
void colorsIn(RCRegion* region) {
  void* base = region->Base();
  auto* vector = static_cast<OFbkImageVectorData*>(base);
  OFbkImage(vector->GetInfo(ofbkimageLAYER_H), vector->GetData(ofbkimageLAYER_H), ofbkimageBAND_Cr).Pointer();
}

MATCHER_P(IsNearlyAs, share, "") {
  const auto [value, expected] = arg;
  return std::abs(value - expected) <= share * std::abs(expected) + 100000;
}

std::size_t hashOf(const std::string& bytes) {
  return std::hash<std::string>()(bytes);
}

OCdtVectorData everyColor(OPrimitiveID camera, OCdtChannel channel) {
  OCdtVectorData tables{};
  tables.SetNumData(1);
  tables.GetInfo(0)->Init(camera, channel);
  for (int segment = 0; segment < ocdtMAX_Y_SEGMENT; ++segment) {
    tables.GetInfo(0)->Set(segment, 255, 0, 255, 0);
  }
  return tables;
}

/// A robot in somebody's hands, and a program that uses all its parts.
class UsedRobot {
 public:
  explicit UsedRobot(const std::string& design)
      : model_(*robot_model::findRobotModel(design.c_str())), robot(optionsOf(design)) {
    addLocators();
    robot.lift(true);
    for (const Joint& joint : robot.joints().all()) {
      rest_.push_back(static_cast<int>(joint.position()));
    }
  }

  void open() {
    for (const std::string& locator : locators_) {
      EXPECT_EQ(robot.openPrimitive(locator.c_str(), &ids_[locator]), oSUCCESS) << locator;
    }
  }

  EffectorCommands joints(const std::function<slongword(std::size_t)>& position) {
    EffectorCommands commands;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      commands.push_back(
          effectorCommand(ids_[model_.joints[i].locator], odataJOINT_COMMAND2, OJointCommandValue2{position(i), 0}));
    }
    return commands;
  }

  /// Somewhere else for each joint and each round.
  EffectorCommands away(int round) {
    return joints([this, round](std::size_t i) {
      const robot_model::Joint& joint = model_.joints[i];
      const double share = 0.1 + 0.06 * static_cast<double>((7 * i + 5 * static_cast<std::size_t>(round)) % 13);
      return static_cast<slongword>(joint.lowest + share * (static_cast<double>(joint.highest) - joint.lowest));
    });
  }

  EffectorCommands back() {
    return joints([this](std::size_t i) { return rest_[i]; });
  }

  EffectorCommands lights(int round) {
    EffectorCommands commands;
    for (int i = 0; i < model_.number_of_leds; ++i) {
      const OPrimitiveID id = ids_[model_.leds[i].locator];
      if (model_.leds[i].kind == robot_model::LED2) {
        commands.push_back(
            effectorCommand(id, odataLED_COMMAND2, OLEDCommandValue2{(i + round) % 2 == 0 ? oledON : oledOFF, 1, 0}));
      } else {
        const auto mode = (i + round) % 2 == 0 ? oled3_MODE_B : oled3_MODE_A;
        commands.push_back(
            effectorCommand(id, odataLED_COMMAND3, OLEDCommandValue3{static_cast<sword>(5 * i + round), mode, 1, 0}));
      }
    }
    return commands;
  }

  EffectorCommands ears(bool left, bool right) {
    EffectorCommands commands;
    for (int i = 0; i < model_.number_of_ears; ++i) {
      const bool is_new = model_.ears[i].kind != robot_model::EAR_JOINT3;
      const bool on = i == 0 ? left : right;
      commands.push_back(effectorCommand(ids_[model_.ears[i].locator],
                                         is_new ? odataJOINT_COMMAND4 : odataJOINT_COMMAND3,
                                         OJointCommandValue4{on ? ojoint4_STATE1 : ojoint4_STATE0, 1, 0}));
    }
    return commands;
  }

  void pass(const EffectorCommands& commands, longword frames = 1) {
    for (longword i = 0; i < frames; ++i) {
      robot.passFrame(++frame, i == 0 ? commands : EffectorCommands());
    }
  }

  void passUntil(longword end) { pass({}, end - frame); }

  template <typename Param>
  OStatus control(OPrimitiveID id, OPrimitiveRequest request, Param param) {
    return robot.controlPrimitive(id, request, &param, sizeof(param), nullptr, 0);
  }
  OStatus control(OPrimitiveID id, OPrimitiveRequest request) {
    return robot.controlPrimitive(id, request, nullptr, 0, nullptr, 0);
  }

  OPrimitiveID camera() const { return ids_.at(locators_[0]); }
  OPrimitiveID speaker() const { return ids_.at(locators_[1]); }

  void startMotors() {
    robot.setMotorPower(opowerON);
    robot.enableJointGain(oprimitiveID_UNDEF);
    robot.setDefaultJointGain(oprimitiveID_UNDEF);
  }

  /// What OPEN-R's calls say of all parts. Not all may be open.
  void showParts(Record* record) {
    OPowerStatus power;
    record->add("power", robot.getPowerStatus(&power), power.robotStatus);
    const CameraSettings& camera = robot.cameraSettings();
    record->add("camera", camera.white_balance, camera.gain, camera.shutter, camera.auto_exposure,
                camera.auto_white_balance);
    OMemoryStickStatus stick = omemorystickUNDEF;
    record->add("stick", robot.getMemoryStickStatus(&stick), stick, *robot.stick().room(),
                robot.stick().jobTime().count());
    for (const auto& [locator, id] : ids_) {
      for (const ODataType type :
           {odataJOINT_COMMAND2, odataJOINT_COMMAND3, odataJOINT_COMMAND4, odataLED_COMMAND2, odataLED_COMMAND3}) {
        record->add(locator, type, robot.takesCommand(id, type));
      }
      OJointValue value{};
      OSensorValue reading{};
      record->add(locator, robot.getJointValue(id, &value), value.value, value.signal, value.pwmDuty, value.refValue,
                  robot.setDefaultJointGain(id), robot.getSensorValue(id, &reading));
      const OCdtVectorData no_colors = everyColor(id, OCdtChannel{1} << 7);
      record->add(locator, robot.setCdtVectorData(no_colors), robot.soundTypeOf(id).value_or(0),
                  control(id, oprmreqCAM_SET_GAIN, OPrimitiveControl_CameraParam(9)),
                  control(id, oprmreqSPEAKER_SET_SOUND_TYPE, OPrimitiveControl_SpeakerSoundType(9)));
    }
    for (int i = 0; i < model_.number_of_leds; ++i) {
      const Led& led = robot.led(model_.leds[i].name);
      record->add(model_.leds[i].name, led.intensity, led.mode);
    }
    for (int i = 0; i < model_.number_of_ears; ++i) {
      const Ear& ear = robot.ear(model_.ears[i].name);
      record->add(model_.ears[i].name, ear.isDrawn(), ear.isHot());
    }
    for (const Joint& joint : robot.joints().all()) {
      record->add(joint.model().name, joint.position());
    }
  }

  void showSensors(Record* record) {
    void* base = robot.captureSensors(frame)->Base();
    auto* const vector = static_cast<OSensorFrameVectorData*>(base);
    record->add("sensors", vector->vectorInfo.numData);
    for (longword i = 0; i < vector->vectorInfo.numData; ++i) {
      const OSensorFrameInfo& info = *vector->GetInfo(static_cast<int>(i));
      record->add(info.primitiveID, info.frameNumber, info.numFrames);
      for (longword reading = 0; reading < info.numFrames; ++reading) {
        const slongword value = vector->GetData(static_cast<int>(i))->frame[reading].value;
        if (i < rest_.size()) {
          record->add("joint", value);
        } else if (info.type == odataSWITCH || info.type == odataFORCE) {
          record->add("pressed", value);
        } else if (info.type == odataNO_DIMENSION) {
          record->add("touched", value > 10);
        } else {
          record->measurements.push_back(value);
        }
      }
    }
  }

  void showPicture(Record* record) { record->add("picture", hashOf(pixelsIn(robot.captureImage(frame)))); }

  void showSound(Record* record) {
    SpeakerFrame played{};
    played.fill(10000);
    const openr_host::MicrophoneFrame heard = robot.passSound(frame, &played);
    record->add("heard", heard[0].L, heard[0].R, heard[127].R);
  }

  void press(bool pressed) {
    for (int i = 0; i < model_.number_of_sensors; i += 1) {
      const robot_model::SensorKind kind = model_.sensors[i].kind;
      if (kind == robot_model::SENSOR_TOUCH || kind == robot_model::SENSOR_SWITCH ||
          kind == robot_model::SENSOR_FORCE) {
        robot.press(model_.sensors[i].name, pressed || std::string(model_.sensors[i].name) == "wlan_switch");
      }
    }
    robot.press(kPauseButton, pressed);
  }

  void jam(bool jammed) {
    for (int i = 0; i < model_.number_of_joints; ++i) {
      robot.jam(model_.joints[i].name, jammed);
    }
  }

  bool hasMoved() const {
    const auto& joints = robot.joints().all();
    return !std::equal(joints.begin(), joints.end(), rest_.begin(),
                       [](const Joint& joint, int rest) { return joint.position() == rest; });
  }

  std::string say(const std::string& line) { return obeyConsole(robot, line).value_or("no command"); }

 private:
  static SimulatedErs7Options optionsOf(const std::string& design) {
    SimulatedErs7Options options;
    options.design = design;
    options.hears_itself = 0.5;
    return options;
  }

  void addLocators() {
    const bool is_210 = std::string(model_.design) == "ERS-210";
    locators_ = {"PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1",
                 is_210 ? "PRM:/r1/c1/c2/c3/s1-Speaker:S1" : "PRM:/s1-Speaker:S1", "PRM:/r1/c1/c2/c3/m1-Mic:M1"};
    const auto add = [this](const char* locator) {
      if (locator != nullptr) {
        locators_.emplace_back(locator);
      }
    };
    for (int i = 0; i < model_.number_of_joints; ++i) {
      add(model_.joints[i].locator);
    }
    for (int i = 0; i < model_.number_of_sensors; ++i) {
      add(model_.sensors[i].locator);
    }
    for (int i = 0; i < model_.number_of_leds; ++i) {
      add(model_.leds[i].locator);
    }
    for (int i = 0; i < model_.number_of_ears; ++i) {
      add(model_.ears[i].locator);
    }
  }

  const robot_model::RobotModel& model_;
  std::vector<std::string> locators_;
  std::map<std::string, OPrimitiveID> ids_;
  std::vector<int> rest_;

 public:
  SimulatedErs7 robot;
  longword frame = 0;
};

using History = std::pair<std::string, std::function<void(UsedRobot&)>>;

/// Each is cut off where it is.
const std::vector<History> kHistories = {
    {"a movement",
     [](UsedRobot& use) {
       use.startMotors();
       use.pass(use.away(1), 7);
     }},
    {"a movement against what jams",
     [](UsedRobot& use) {
       use.jam(true);
       use.startMotors();
       use.pass(use.away(2), 9);
       use.jam(false);
     }},
    {"motors off in a movement",
     [](UsedRobot& use) {
       use.startMotors();
       use.pass(use.away(3), 30);
       use.robot.setMotorPower(opowerOFF);
       use.pass(use.away(1), 3);
     }},
    {"other gains",
     [](UsedRobot& use) {
       use.startMotors();
       use.robot.setJointGain(oprimitiveID_UNDEF, 3, 1, 2, 0x0E, 0x02, 0x0F);
       use.pass(use.away(4), 2);
     }},
    {"lights and ears",
     [](UsedRobot& use) {
       use.pass(use.lights(9));
       use.pass(use.ears(true, false), 90);
     }},
    {"hot ears", [](UsedRobot& use) { use.pass(use.ears(true, true), 140); }},
    {"settings of camera and speaker",
     [](UsedRobot& use) {
       use.control(use.camera(), oprmreqCAM_SET_WHITE_BALANCE, OPrimitiveControl_CameraParam(ocamparamWB_INDOOR_MODE));
       use.control(use.camera(), oprmreqCAM_SET_GAIN, OPrimitiveControl_CameraParam(ocamparamGAIN_LOW));
       use.control(use.camera(), oprmreqCAM_SET_SHUTTER_SPEED, OPrimitiveControl_CameraParam(ocamparamSHUTTER_SLOW));
       use.control(use.speaker(), oprmreqSPEAKER_SET_VOLUME, OPrimitiveControl_SpeakerVolume(ospkvol25dB));
       use.control(use.speaker(), oprmreqSPEAKER_SET_SOUND_TYPE, OPrimitiveControl_SpeakerSoundType(ospksndMONO16K16B));
     }},
    {"automatic settings and silence",
     [](UsedRobot& use) {
       use.control(use.camera(), oprmreqCAM_AE_ON);
       use.control(use.camera(), oprmreqCAM_AWB_ON);
       use.control(use.speaker(), oprmreqSPEAKER_MUTE_ON);
     }},
    {"colours and pictures, some of them kept",
     [](UsedRobot& use) {
       EXPECT_EQ(use.robot.setCdtVectorData(everyColor(use.camera(), ocdtCHANNEL2)), oSUCCESS);
       RCRegion* const kept = use.robot.captureImage(use.frame);
       kept->AddReference();
       pixelsIn(use.robot.captureImage(use.frame));
       kept->RemoveReference();
     }},
    {"parts opened twice",
     [](UsedRobot& use) {
       use.open();
       use.open();
     }},
    {"everything that people do with it", [](UsedRobot& use) {
       for (const char* side : {"left", "back", "right", "feet"}) {
         use.say(std::string("lie ") + side);
         use.pass({}, 40);
       }
       use.press(true);
       use.pass({}, 3);
       use.press(false);
       for (const char* state : {"locked", "out", "slow", "full", "ready"}) {
         use.say(std::string("stick ") + state);
       }
       const test_support::TemporaryFolder folder;
       const std::string path = folder.path("loud.wav").string();
       SpeakerFrame loud{};
       loud.fill(12345);
       WavWriter(path).write(loud);
       EXPECT_EQ(use.say("hear " + path), "ok: hear " + path + "\n");
       use.robot.passSound(use.frame, nullptr);
       EXPECT_EQ(use.say("hear silence"), "ok: hear silence\n");
       EXPECT_THAT(use.say("hear nothing.wav"), testing::StartsWith("error"));
     }}};

/// Uses everything, and shows it.
Record useEverything(UsedRobot& use) {
  Record record;
  use.showParts(&record);
  use.open();
  use.showParts(&record);
  use.showPicture(&record);
  use.showSound(&record);
  use.showSensors(&record);
  use.robot.enableJointGain(oprimitiveID_UNDEF);
  use.pass(use.away(5), 2);
  use.robot.setMotorPower(opowerON);
  use.pass({}, 2);
  use.showParts(&record);
  use.robot.disableJointGain(oprimitiveID_UNDEF);
  for (const int round : {6, 7}) {
    use.startMotors();
    use.pass(use.lights(round));
    use.pass(use.ears(round == 6, round == 7));
    use.press(round == 6);
    use.pass(use.away(round), 10);
    use.showParts(&record);
    use.pass({}, 100);
    use.showParts(&record);
    use.showSensors(&record);
  }
  use.showPicture(&record);
  use.robot.lift(false);
  use.pass(use.back(), 250);
  use.showSensors(&record);
  record.measurements.push_back(1e6 * use.robot.pose().x);
  record.measurements.push_back(1e6 * use.robot.pose().yaw);
  return record;
}

/// What a robot shows when it is used after this history, after it was switched off. What has moved is brought back.
Record afterHistory(const std::string& design, const std::function<void(UsedRobot&)>& history) {
  UsedRobot use(design);
  use.open();
  use.pass({}, 70);
  history(use);
  use.robot.switchOff();
  if (use.hasMoved()) {
    use.open();
    use.pass(use.back());
    use.startMotors();
    use.pass({}, 300);
    use.robot.switchOff();
  }
  use.passUntil(1400);
  return useEverything(use);
}

/// The first line that differs, if any.
std::string difference(const std::vector<std::string>& lines, const std::vector<std::string>& expected) {
  const auto [line, other] = std::mismatch(lines.begin(), lines.end(), expected.begin(), expected.end());
  const bool is_same = line == lines.end() && other == expected.end();
  return is_same                   ? ""
         : line == lines.end()     ? "no " + *other
         : other == expected.end() ? "also " + *line
                                   : std::to_string(line - lines.begin()) + ": " + *line + "instead of " + *other;
}

TEST(RobotHistory, SwitchedOnAgainTheRobotIsAsAFreshOne) {
  constexpr double kErrors = 0.05;  // sensors err by some percent
  for (const char* design : {"ERS-7", "ERS-210"}) {
    const Record fresh = afterHistory(design, [](UsedRobot&) {});
    for (const auto& [name, history] : kHistories) {
      const Record again = afterHistory(design, history);
      EXPECT_EQ(difference(again.lines, fresh.lines), "") << design << " after " << name;
      EXPECT_THAT(again.measurements, testing::Pointwise(IsNearlyAs(kErrors), fresh.measurements))
          << design << " after " << name;
    }
  }
}

/// Other times, poses, settings and colours for each step, some of them as before.
struct Scenery {
  Scene scene;
  SceneView view{scene, 7};
  Camera camera{view, 42};

  RCRegion* take(int step) {
    CameraPose pose;
    pose.head.head_pan = 0.2 * ((step / 4) % 4 - 1);
    pose.body.translation().y() = 0.05 * ((step / 2) % 2);
    camera.reset();
    for (const auto& [request, place] :
         {std::pair(oprmreqCAM_SET_WHITE_BALANCE, 2), {oprmreqCAM_SET_GAIN, 3}, {oprmreqCAM_SET_SHUTTER_SPEED, 5}}) {
      OPrimitiveControl_CameraParam value(static_cast<longword>(1 + (step / place) % 3));
      camera.control(request, &value, sizeof(value));
    }
    camera.control(step % 11 == 4 ? oprmreqCAM_AE_ON : oprmreqCAM_AE_OFF, nullptr, 0);
    camera.control(step % 5 == 3 ? oprmreqCAM_AWB_ON : oprmreqCAM_AWB_OFF, nullptr, 0);
    if (step % 4 == 2 || step % 8 == 3) {
      camera.colors().load(everyColor(42, OCdtChannel{1} << step % 7));
    }
    // In some frames the ball is where it was, or near it.
    return camera.capture(static_cast<longword>(step % 6 == 5 ? 4 : 37 * step), pose);
  }
};

TEST(PictureHistory, APictureAfterAnyOthersIsAsTheFirstOfAFreshRobot) {
  Scenery used;
  std::vector<RCRegion*> kept;
  for (int step = 0; step < 32; ++step) {
    RCRegion* const region = used.take(step);
    if (step % 3 == 2) {
      colorsIn(region);  // the rest is drawn later
    }
    if (step % 3 != 0) {  // nobody reads the others
      Scenery fresh;
      ASSERT_EQ(hashOf(pixelsIn(region)), hashOf(pixelsIn(fresh.take(step)))) << "picture " << step;
    }
    if (step % 8 == 3) {
      region->AddReference();
      kept.push_back(region);
    } else if (step % 8 == 7) {
      pixelsIn(kept.back());  // when the camera has drawn others
      Scenery fresh;
      ASSERT_EQ(hashOf(pixelsIn(kept.back())), hashOf(pixelsIn(fresh.take(step - 4)))) << "kept picture " << step - 4;
      kept.back()->RemoveReference();
      kept.pop_back();
    }
  }
}

}  // namespace
}  // namespace simulated_ers7
