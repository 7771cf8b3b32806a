/// @file fake_robot.h
#ifndef TEST_UNIT_SIMULATOR_OPENR_HOST_FAKE_ROBOT_H
#define TEST_UNIT_SIMULATOR_OPENR_HOST_FAKE_ROBOT_H

#include <OPENR/ODataFormats.h>

#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// A robot that records what happens to it. It has no camera. Its sensors have one entry, whose value in each frame is
/// the frame's number. Its joints accept odataJOINT_COMMAND2 and are the primitives 1 to 20.
class FakeRobot : public VirtualRobot {
 public:
  ~FakeRobot() override {
    if (sensors_ != nullptr) {
      sensors_->RemoveReference();
    }
  }

  int sound_frames = 0;                                             ///< calls of passSound()
  std::map<longword, std::map<OPrimitiveID, slongword>> commanded;  ///< by frame and joint

  std::map<longword, std::vector<sword>> played;  ///< by frame

  RCRegion* sensors() const { return sensors_; }

  std::string design() const override { return "ERS-7"; }

  OStatus openPrimitive(const char*, OPrimitiveID*) override { return oSUCCESS; }
  OStatus closePrimitive(OPrimitiveID) override { return oSUCCESS; }
  OStatus controlPrimitive(OPrimitiveID, OPrimitiveRequest, void*, size_t, void*, size_t) override { return oSUCCESS; }
  OStatus setJointGain(OPrimitiveID, word, word, word, word, word, word) override { return oSUCCESS; }
  OStatus enableJointGain(OPrimitiveID) override { return oSUCCESS; }
  OStatus disableJointGain(OPrimitiveID) override { return oSUCCESS; }
  OStatus getJointValue(OPrimitiveID, OJointValue*) override { return oSUCCESS; }
  OStatus getSensorValue(OPrimitiveID, OSensorValue*) override { return oSUCCESS; }
  OStatus setMotorPower(OPower) override { return oSUCCESS; }
  OStatus getMemoryStickStatus(OMemoryStickStatus*) override { return oSUCCESS; }
  OStatus getPowerStatus(OPowerStatus*) override { return oSUCCESS; }
  OStatus setCdtVectorData(const OCdtVectorData&) override { return oSUCCESS; }
  void switchOff() override {}

  bool takesCommand(OPrimitiveID id, ODataType type) const override {
    return id >= 1 && id <= 20 && type == odataJOINT_COMMAND2;
  }

  std::optional<OSpeakerSoundType> soundTypeOf(OPrimitiveID id) const override {
    return id == 30 ? std::make_optional<OSpeakerSoundType>(ospksndMONO16K16B) : std::nullopt;
  }

  /// The microphones hear the number of the sample, the right one its negative.
  MicrophoneFrame passSound(longword frame, const SpeakerFrame* frame_played) override {
    ++sound_frames;
    if (frame_played != nullptr) {
      played[frame].assign(frame_played->begin(), frame_played->end());
    }
    MicrophoneFrame heard{};
    for (std::size_t i = 0; i < heard.size(); ++i) {
      const auto sample = static_cast<sword>(frame * heard.size() + i);
      heard[i] = {sample, static_cast<sword>(-sample)};
    }
    return heard;
  }

  void passFrame(longword frame, const EffectorCommands& commands) override {
    for (const auto& command : commands) {
      OJointCommandValue2 value;
      std::memcpy(&value, &command.value, sizeof(value));
      commanded[frame][command.primitive] = value.value;
    }
  }

  RCRegion* captureSensors(longword frame) override {
    if (sensors_ == nullptr) {
      sensors_ = new RCRegion(sizeof(OSensorFrameVectorData) + sizeof(OSensorFrameData));
    }
    void* base = sensors_->Base();
    auto* vector = static_cast<OSensorFrameVectorData*>(base);
    OSensorFrameInfo& info = *vector->GetInfo(0);
    info.frameNumber = frame - 3;
    info.numFrames = 4;
    info.dataOffset = sizeof(OSensorFrameVectorData);
    for (longword i = 0; i < info.numFrames; ++i) {
      vector->GetData(0)->frame[i].value = static_cast<slongword>(info.frameNumber + i);
    }
    return sensors_;
  }

  bool cameraImageDue(longword) override { return false; }
  RCRegion* captureImage(longword) override { return nullptr; }

 private:
  RCRegion* sensors_ = nullptr;
};

}  // namespace openr_host

#endif  // TEST_UNIT_SIMULATOR_OPENR_HOST_FAKE_ROBOT_H
