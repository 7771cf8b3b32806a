#include "client/calls.h"

#include "client/argument_checks.h"
#include "protocol/big_endian.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

/// @param name the name of a file, which gets into the payload in capitals
/// @param read protocol::readMotionName(), protocol::readPictureName() or readNewMotionName()
template <typename Payload>
Call callForFile(const version2::Request& request, Payload payload, const std::string& name,
                 version2::ReadFileName read, int id = 0) {
  if (const char* const problem = read(name.data(), name.size(), payload.name)) {
    throw InvalidArgumentException("'" + name + "': " + problem);
  }
  return makeCall(request, payload, payload.name, id);
}

const char* readNewMotionName(const char* text, std::size_t size, protocol::FileName& name) {
  const char* const problem = protocol::readMotionName(text, size, name);
  return problem != nullptr ? problem : protocol::problemOfNewMotionName(name);
}

}  // namespace

Call callForPicture(int quality, std::optional<Resolution> resolution) {
  checkRange("quality", quality, 0, 100);
  const bool is_usual = resolution.value_or(Resolution::kHigh) == Resolution::kHigh;
  Call call = makeCall(version2::TAKE_PICTURE, version2::NoPayload(), is_usual ? "" : "of this resolution");
  call.quality = quality;
  call.resolution = resolution;
  return call;
}

Call callForMotors(bool on) {
  return makeCall(on ? version2::SWITCH_MOTORS_ON : version2::SWITCH_MOTORS_OFF, version2::MotorOrder{0, on});
}

Call callToHold(const std::vector<int>& joints) {
  checkJointsToHold(joints);
  Call call = makeCall(version2::HOLD, version2::NoPayload(), "",
                       joints.empty() ? version2::HOLD_EVERYTHING : version2::HOLD_JOINTS);
  call.payload.assign(joints.begin(), joints.end());
  call.joints = joints;
  return call;
}

Call callForPosture(Posture posture) {
  const auto id = static_cast<version2::Posture>(posture);
  return makeCall(version2::TAKE_POSTURE, version2::PostureOrder{0}, version2::postureName(id), id);
}

Call callToPlay(const std::string& name, int repetitions, bool leaves_out_missing_joints) {
  checkRange("repetitions", repetitions, 1, 65535);
  const version2::MotionOrder order = {0, static_cast<unsigned short>(repetitions), ""};
  return callForFile(version2::PLAY_MOTION, order, name, protocol::readMotionName,
                     leaves_out_missing_joints ? version2::LEAVE_OUT_MISSING_JOINTS : 0);
}

Call callToStop(const std::string& name) {
  const version2::MotionOrder stop = {};
  return name.empty() ? makeCall(version2::STOP_ALL_MOTIONS, stop)
                      : callForFile(version2::STOP_MOTION, stop, name, protocol::readMotionName);
}

Call callToStore(const std::string& name, const std::vector<std::uint8_t>& content, bool leaves_out_missing_joints) {
  checkRange("the motion's size", static_cast<long long>(content.size()), 1, version2::MAX_MOTION_FILE_SIZE, " bytes");
  const version2::MotionUpload upload = {"", content.data(), content.size()};
  return callForFile(version2::STORE_MOTION, upload, name, readNewMotionName,
                     leaves_out_missing_joints ? version2::LEAVE_OUT_MISSING_JOINTS : 0);
}

Call callToDelete(const std::string& name) {
  return callForFile(version2::DELETE_MOTION, version2::MotionToDelete{}, name, protocol::readMotionName);
}

Call callToSavePicture(int quality) {
  checkRange("quality", quality, 1, 100);
  return makeCall(version2::SAVE_PICTURE, version2::NoPayload(), "", quality);
}

Call callToFetchPicture(const std::string& name) {
  return callForFile(version2::FETCH_STICK_PICTURE, version2::StickPicture{}, name, protocol::readPictureName,
                     version2::FETCH_PICTURE);
}

Call callToDeletePicture(const std::string& name) {
  return callForFile(version2::DELETE_STICK_PICTURE, version2::StickPicture{}, name, protocol::readPictureName,
                     version2::DELETE_PICTURE);
}

Call callToPlaySamples(const SoundPart& part, const std::vector<std::int16_t>& samples) {
  Call::Bytes bytes(samples.size() * version2::BYTES_PER_SAMPLE);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    protocol::encodeBigEndian16(static_cast<unsigned short>(samples[i]), &bytes[i * version2::BYTES_PER_SAMPLE]);
  }
  const version2::PlayedSound sound = {part.position, part.is_last, bytes.data(), bytes.size()};
  Call call = makeCall(version2::PLAY_SOUND, sound, "", version2::SOUND_SPEAKER);
  call.sound_part = part;
  return call;
}

Call callForVolume(int volume) {
  if (volume != kVolumeOfRobot) {
    checkRange("volume", volume, 0, kLoudestVolume);
  }
  const version2::Volume step = {static_cast<unsigned char>(volume)};
  return makeCall(version2::SET_VOLUME, step, "", version2::SOUND_VOLUME);
}

}  // namespace aibo_client
