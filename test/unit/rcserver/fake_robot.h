/// @file fake_robot.h
/// A robot whose camera images, joints and sensors can be told apart.
#ifndef TEST_UNIT_RCSERVER_FAKE_ROBOT_H
#define TEST_UNIT_RCSERVER_FAKE_ROBOT_H

#include <OPENR/ODataFormats.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "robot_model/robot_model.h"
#include "simulator/openr_host/virtual_robot.h"

/// Takes an image every four frames, beginning with frame 4, in the layers H, M and L, and C if the test
/// has given a plane of detected colours. Each image has the same
/// brightness all over, which differs from that of the ten images before and after.
///
/// Begins upright, in an allowed posture. In each frame, a joint with gains moves to the position it was last commanded
/// to, unless it is jammed. Joints report their positions, but those with gains are a little off, each by its own
/// error. Sensors report the values that the test has set. LEDs and ears keep their last commands.
class FakeRobot : public openr_host::VirtualRobot {
 public:
  static constexpr longword kFramesPerImage = 4;
  static constexpr longword kFirstFrame = 100000;  ///< in which tests begin
  static constexpr longword kFirstImage = 100;     ///< its image
  static constexpr size_t kWidth = 208;
  static constexpr size_t kHeight = 160;
  static constexpr size_t kMostBands = 6;
  static constexpr size_t kLayers = 4;

  struct FakeJoint {
    bool gain = false;
    bool jammed = false;
    bool refuses_gains = false;  ///< SetJointGain fails
    bool is_mute = false;        ///< GetJointValue fails
    std::optional<int> duty{};   ///< that it reports; otherwise it is full unless the joint is at its reference
    int duty_at_rest = 0;
    int error = 0;  ///< of the position that it reports while it has gains
    robot_model::PidGains gains = {};
    int position = 0;
    int reference = 0;
    int error_when_gain_went_on = 0;  ///< its reference minus its position
    std::vector<int> path;            ///< its position at the end of each frame
  };

  struct FakeLed {
    int intensity = 0;  ///< of one that is only on or off: 0 or 1
    int mode = 0;
  };

  struct FakeEar {
    bool drawn = false;
    std::vector<bool> path;  ///< at the end of each frame
  };

  /// @param robot_design one that robot_model knows
  explicit FakeRobot(const char* robot_design = "ERS-7")
      : model(*robot_model::findRobotModel(robot_design)),
        region_(new RCRegion(sizeof(OFbkImageVectorData) + kLayers * sizeof(OFbkImageInfo) +
                             2 * kMostBands * kWidth * kHeight)) {
    std::vector<int> posture(joints.size(), 0);
    for (size_t i = 0; i < joints.size(); ++i) {
      const int number = static_cast<int>(i) + 1;
      const int sign = i % 2 == 0 ? -1 : 1;
      posture[i] = sign * (1000 + 211 * number);
      joints[i].error = sign * (300 + 47 * number);
      joints[i].duty_at_rest = sign * 3 * number;
    }
    robot_model::clampPosture(model, posture.data());
    for (size_t i = 0; i < joints.size(); ++i) {
      joints[i].position = joints[i].reference = posture[i];
    }
    for (size_t i = 0; i < sensor_values.size(); ++i) {
      if (model.sensors[i].kind == robot_model::SENSOR_TOUCH) {
        sensor_values[i] = 3 + static_cast<int>(i);
      }
    }
    const std::pair<const char*, int> at_rest[] = {{"range_near", 500000},
                                                   {"range_far", 1500000},
                                                   {"range_chest", 223000},
                                                   {"acceleration_up_down", -9780000},
                                                   {"acceleration_right_left", 150000},
                                                   {"acceleration_front_back", -90000}};
    for (const auto& [name, value] : at_rest) {
      if (robot_model::findSensorByName(model, name) != robot_model::NO_SENSOR) {
        sensor(name) = value;
      }
    }
  }
  ~FakeRobot() override {
    region_->RemoveReference();
    sensors_->RemoveReference();
  }
  FakeRobot(const FakeRobot&) = delete;
  FakeRobot& operator=(const FakeRobot&) = delete;

  /// Brightness of an image, by its number.
  static int brightness(unsigned image) { return 25 + 10 * static_cast<int>(image % 20); }

  /// Number of the image that was taken last.
  unsigned lastImage() const { return image_; }

  /// From now on images are noise, which makes the largest pictures.
  void showNoise() { noise_ = true; }

  std::string design() const override { return model.design; }
  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override {
    if (locator == missing_locator) {
      return oNOT_FOUND;
    }
    const std::pair<int, OPrimitiveID> parts[] = {{robot_model::findJointByLocator(model, locator), kFirstPrimitive},
                                                  {robot_model::findSensorByLocator(model, locator), kFirstSensor},
                                                  {robot_model::findLedByLocator(model, locator), kFirstLed},
                                                  {robot_model::findEarByLocator(model, locator), kFirstEar}};
    for (const auto& [index, first] : parts) {
      if (index >= 0) {
        *id = first + static_cast<OPrimitiveID>(index);
        return oSUCCESS;
      }
    }
    const bool is_camera = std::string(locator) == "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";
    *id = is_camera ? kCamera : kSpeaker;
    return is_camera || std::string(locator) == "PRM:/s1-Speaker:S1" ? oSUCCESS : oNOT_FOUND;
  }
  OStatus closePrimitive(OPrimitiveID) override { return oSUCCESS; }
  OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t size, void*,
                           size_t) override {
    longword value = 0;
    if (size > 0) {
      std::memcpy(&value, param, std::min(size, sizeof(value)));
    }
    if (id == kSpeaker && !refuses_speaker) {
      speaker_requests[request] = value;
      return oSUCCESS;
    }
    if (id != kCamera || refuses_camera_settings) {
      return oINVALID_PRIMITIVE_ID;
    }
    camera_requests.emplace_back(request, value);
    return oSUCCESS;
  }

  OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) override {
    if (!at(id).gain) {
      return oGAIN_DISABLED;
    }
    if (at(id).refuses_gains) {
      return oFAIL;
    }
    at(id).gains = {pg, ig, dg, ps, is, ds};
    return oSUCCESS;
  }
  OStatus enableJointGain(OPrimitiveID id) override {
    at(id).gain = true;
    at(id).error_when_gain_went_on = at(id).reference - at(id).position;
    return oSUCCESS;
  }
  OStatus disableJointGain(OPrimitiveID id) override {
    at(id).gain = false;
    at(id).gains = {};
    return oSUCCESS;
  }
  OStatus getJointValue(OPrimitiveID id, OJointValue* value) override {
    *value = read(at(id));
    value->value = at(id).position;
    return at(id).is_mute ? oFAIL : oSUCCESS;
  }
  OStatus getSensorValue(OPrimitiveID, OSensorValue*) override { return oINVALID_PRIMITIVE_ID; }
  OStatus setMotorPower(OPower power) override {
    if (refuses_power) {
      return oFAIL;
    }
    powered = power == opowerON;
    return oSUCCESS;
  }
  OStatus getPowerStatus(OPowerStatus* status) override {
    *status = power_status;
    return oSUCCESS;
  }
  OStatus getMemoryStickStatus(OMemoryStickStatus* status) override {
    *status = stick_status;
    return oSUCCESS;
  }
  OStatus setCdtVectorData(const OCdtVectorData& tables) override {
    for (longword i = 0; i < tables.vectorInfo.numData; ++i) {
      color_tables[tables.info[i].channel] =
          std::vector<longword>(tables.info[i].table, tables.info[i].table + ocdtMAX_Y_SEGMENT);
    }
    return oSUCCESS;
  }
  OVolumeSwitch volumeSwitch() const override { return volume_switch; }
  std::optional<OSpeakerSoundType> soundTypeOf(OPrimitiveID id) const override {
    const auto type = speaker_requests.find(oprmreqSPEAKER_SET_SOUND_TYPE);
    return id == kSpeaker && type != speaker_requests.end() ? std::make_optional(type->second) : std::nullopt;
  }
  openr_host::MicrophoneFrame passSound(longword frame, const openr_host::SpeakerFrame* frame_played) override {
    if (frame_played != nullptr) {
      played.insert(played.end(), frame_played->begin(), frame_played->end());
    }
    openr_host::MicrophoneFrame heard{};
    for (size_t i = 0; i < heard.size(); ++i) {
      heard[i] = sound ? sound(frame * heard.size() + i) : OSoundSampleStereo16{};
    }
    return heard;
  }
  void switchOff() override { ++times_switched_off; }
  bool takesCommand(OPrimitiveID id, ODataType type) const override {
    if (id >= kFirstEar) {
      return type ==
             (model.ears[id - kFirstEar].kind == robot_model::EAR_JOINT4 ? odataJOINT_COMMAND4 : odataJOINT_COMMAND3);
    }
    if (id >= kFirstLed) {
      return type == (model.leds[id - kFirstLed].kind == robot_model::LED2 ? odataLED_COMMAND2 : odataLED_COMMAND3);
    }
    return id >= kFirstPrimitive && id - kFirstPrimitive < joints.size() && type == odataJOINT_COMMAND2;
  }

  void passFrame(longword, const openr_host::EffectorCommands& commands) override {
    for (const openr_host::EffectorCommand& command : commands) {
      carryOut(command);
    }
    for (FakeJoint& joint : joints) {
      if (powered && joint.gain && joint.gains.proportional != 0 && !joint.jammed) {
        joint.position = joint.reference;
      }
      joint.path.push_back(joint.position);
    }
    for (FakeEar& ear : ears) {
      ear.path.push_back(ear.drawn);
    }
  }

  RCRegion* captureSensors(longword frame) override {
    void* base = sensors_->Base();
    auto* vector = static_cast<OSensorFrameVectorData*>(base);
    vector->vectorInfo.numData = 0;
    for (size_t i = 0; i < joints.size(); ++i) {
      const OJointValue value = read(joints[i]);
      report(frame, kFirstPrimitive + static_cast<OPrimitiveID>(i), &value, *vector);
    }
    for (size_t i = 0; i < sensor_values.size(); ++i) {
      if (model.sensors[i].locator != nullptr) {
        const OSensorValue value{sensor_values[i], 0, {}};
        report(frame, kFirstSensor + static_cast<OPrimitiveID>(i), &value, *vector);
      }
    }
    return sensors_;
  }

  /// The position that a joint reports.
  static int measured(const FakeJoint& joint) { return joint.position + (joint.gain ? joint.error : 0); }

  /// It lies on its right side.
  void layOnSide() {
    sensor("acceleration_right_left") = 9806650;
    sensor("acceleration_up_down") = 40000;
  }

  /// The value that a sensor reports, in the units of robot_model::SensorKind.
  int& sensor(const std::string& name) {
    return sensor_values[static_cast<size_t>(robot_model::findSensorByName(model, name.c_str()))];
  }
  FakeLed& led(const std::string& name) {
    return leds[static_cast<size_t>(robot_model::findLedByName(model, name.c_str()))];
  }

  FakeJoint& joint(const std::string& name) {
    return joints[static_cast<size_t>(robot_model::findJointByName(model, name.c_str()))];
  }

  const robot_model::RobotModel& model;
  std::vector<FakeJoint> joints = std::vector<FakeJoint>(static_cast<size_t>(model.number_of_joints));
  std::vector<int> sensor_values = std::vector<int>(static_cast<size_t>(model.number_of_sensors));
  std::vector<FakeLed> leds = std::vector<FakeLed>(static_cast<size_t>(model.number_of_leds));
  std::vector<FakeEar> ears = std::vector<FakeEar>(static_cast<size_t>(model.number_of_ears));
  OPowerStatus power_status;
  OMemoryStickStatus stick_status = omemorystickWRITABLE;
  int times_switched_off = 0;
  bool powered = false;
  bool refuses_power = false;
  std::optional<std::array<byte, 3>> detail{};  ///< of images, in LH, HL and HH; without it there are no such bands
  bool refuses_camera_settings = false;
  std::map<OCdtChannel, std::vector<longword>> color_tables;  ///< as last set, of each channel
  std::vector<byte> color_plane;  ///< of images, as high as layer M; empty: images have no such plane
  std::vector<std::pair<OPrimitiveRequest, longword>> camera_requests;  ///< value 0 for those without one
  std::map<OPrimitiveRequest, longword> speaker_requests;               ///< the last one of each
  bool refuses_speaker = false;
  OVolumeSwitch volume_switch = ovolumeSW2;
  std::vector<sword> played;                          ///< by the speaker, without pauses between sounds
  std::function<OSoundSampleStereo16(size_t)> sound;  ///< in the room; 0 is the first sample of frame 0
  std::string missing_locator;                        ///< of a primitive that does not open

  bool cameraImageDue(longword frame) override {
    const longword image = (frame - kFirstFrame) / kFramesPerImage + kFirstImage;
    const bool due = image != image_;
    image_ = image;
    return due;
  }

  RCRegion* captureImage(longword frame) override {
    void* base = region_->Base();
    auto* vector = static_cast<OFbkImageVectorData*>(base);
    longword offset = static_cast<longword>(offsetof(OFbkImageVectorData, info) + kLayers * sizeof(OFbkImageInfo));
    for (const OFbkImageLayer layer : {ofbkimageLAYER_H, ofbkimageLAYER_M, ofbkimageLAYER_L}) {
      drawLayer(frame, offset, *vector, layer);
      offset += vector->GetInfo(layer)->dataSize;
    }
    drawColorPlane(offset, *vector);
    return region_;
  }

 private:
  static constexpr OPrimitiveID kFirstPrimitive = 100;
  static constexpr OPrimitiveID kFirstSensor = 200;
  static constexpr OPrimitiveID kFirstLed = 300;
  static constexpr OPrimitiveID kFirstEar = 400;
  static constexpr OPrimitiveID kCamera = 500;
  static constexpr OPrimitiveID kSpeaker = 501;
  static constexpr size_t kMostEntries = robot_model::MAX_JOINTS + robot_model::MAX_SENSORS;

  void carryOut(const openr_host::EffectorCommand& command) {
    if (command.type == odataJOINT_COMMAND2) {
      at(command.primitive).reference = valueOf<OJointCommandValue2>(command).value;
    } else if (command.primitive >= kFirstEar) {
      const auto value = valueOf<OJointCommandValue4>(command);
      FakeEar& ear = ears.at(command.primitive - kFirstEar);
      ear.drawn = value.value == ojoint4_STATE1;
    } else {
      FakeLed& led = leds.at(command.primitive - kFirstLed);
      if (command.type == odataLED_COMMAND2) {
        led.intensity = static_cast<int>(valueOf<OLEDCommandValue2>(command).led);
      } else {
        led.intensity = valueOf<OLEDCommandValue3>(command).intensity;
        led.mode = valueOf<OLEDCommandValue3>(command).mode;
      }
    }
  }

  template <typename Value>
  static Value valueOf(const openr_host::EffectorCommand& command) {
    Value value;
    std::memcpy(&value, &command.value, sizeof(value));
    return value;
  }

  // Adds an entry for the four frames that end with this one.
  static void report(longword frame, OPrimitiveID id, const void* value, OSensorFrameVectorData& vector) {
    const longword entry = vector.vectorInfo.numData++;
    OSensorFrameInfo* info = vector.GetInfo(static_cast<int>(entry));
    info->primitiveID = id;
    info->frameNumber = frame - 3;
    info->numFrames = 4;
    info->dataOffset = static_cast<longword>(sizeof(OSensorFrameVectorData) + kMostEntries * sizeof(OSensorFrameInfo) +
                                             entry * sizeof(OSensorFrameData));
    std::memcpy(&vector.GetData(static_cast<int>(entry))->frame[3], value, sizeof(OSensorValue));
  }

  FakeJoint& at(OPrimitiveID id) { return joints.at(id - kFirstPrimitive); }

  static OJointValue read(const FakeJoint& joint) {
    OJointValue value{};
    value.value = measured(joint);
    value.refValue = joint.reference;
    const int duty = joint.reference == joint.position ? joint.duty_at_rest : 512;
    value.pwmDuty = static_cast<sword>(joint.duty.value_or(duty));
    return value;
  }

  void drawColorPlane(longword offset, OFbkImageVectorData& vector) const {
    OFbkImageInfo* info = vector.GetInfo(ofbkimageLAYER_C);
    info->type = color_plane.empty() ? odataUNDEF : odataFBK_CDT;
    info->dataOffset = offset;
    info->dataSize = static_cast<longword>(color_plane.size());
    info->height = kHeight / 2;
    info->width = info->dataSize / info->height;
    std::copy(color_plane.begin(), color_plane.end(), vector.GetData(ofbkimageLAYER_C));
  }

  void drawLayer(longword frame, longword offset, OFbkImageVectorData& vector, OFbkImageLayer layer) {
    const size_t width = kWidth >> layer;
    const size_t height = kHeight >> layer;
    OFbkImageInfo* info = vector.GetInfo(layer);
    const size_t bands = detail ? kMostBands : 3;
    info->type = detail ? odataFBK_YCrCb_HPF : odataFBK_YCrCb;
    info->frameNumber = frame;
    info->dataOffset = offset;
    info->dataSize = static_cast<longword>(bands * width * height);
    info->width = static_cast<longword>(width);
    info->height = static_cast<longword>(height);
    byte* pixels = vector.GetData(layer);
    for (size_t row = 0; row < height; ++row) {
      byte* const bytes = pixels + bands * width * row;
      std::fill_n(bytes, width, static_cast<byte>(brightness(image_)));
      std::fill_n(bytes + width, 2 * width, byte{128});
      for (size_t band = 3; band < bands; ++band) {
        std::fill_n(bytes + band * width, width, (*detail)[band - 3]);
      }
    }
    if (noise_) {
      std::generate_n(pixels, bands * width * height, [this] { return static_cast<byte>(random_() & 0xff); });
    }
    byte* tag = pixels + bands * width * (height - 1);
    tag[0] = static_cast<byte>(image_ & 0xff);
    tag[1] = static_cast<byte>(image_ >> 8);
  }

  RCRegion* region_;
  RCRegion* sensors_ = new RCRegion(sizeof(OSensorFrameVectorData) +
                                    kMostEntries * (sizeof(OSensorFrameInfo) + sizeof(OSensorFrameData)));
  unsigned image_ = 0;
  bool noise_ = false;
  std::minstd_rand random_;
};

#endif  // TEST_UNIT_RCSERVER_FAKE_ROBOT_H
