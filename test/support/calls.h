/// @file calls.h
/// Calls as RcServerClient makes them, for tests of what is below it. Nobody waits for them.
#ifndef TEST_SUPPORT_CALLS_H
#define TEST_SUPPORT_CALLS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/call.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace test_support {

using aibo_client::Call;
using aibo_client::makeCall;

template <typename Payload>
Call callForFile(const protocol::version2::Request& request, Payload payload, const std::string& name, int id = 0) {
  name.copy(payload.name, protocol::MAX_FILE_NAME_SIZE);
  return makeCall(request, payload, name, id);
}

inline Call callForPicture(int quality, std::optional<aibo_client::Resolution> resolution = std::nullopt) {
  Call call = makeCall(protocol::version2::TAKE_PICTURE);
  call.quality = quality;
  call.resolution = resolution;
  return call;
}

inline Call callForMotors(bool on) {
  return makeCall(on ? protocol::version2::SWITCH_MOTORS_ON : protocol::version2::SWITCH_MOTORS_OFF,
                  protocol::version2::MotorOrder{0, on});
}

inline Call callToHold(const std::vector<int>& joints) {
  Call call = makeCall(protocol::version2::HOLD, protocol::version2::NoPayload(), "", joints.empty() ? 0 : 1);
  call.payload.assign(joints.begin(), joints.end());
  call.joints = joints;
  return call;
}

inline Call callForPosture(protocol::version2::Posture posture) {
  return makeCall(protocol::version2::TAKE_POSTURE, protocol::version2::PostureOrder{0},
                  protocol::version2::postureName(posture), posture);
}

/// @param name empty means all motions
/// @param repetitions 0 stops it
inline Call callToPlay(const std::string& name, unsigned short repetitions = 1) {
  const protocol::version2::Request& stop =
      name.empty() ? protocol::version2::STOP_ALL_MOTIONS : protocol::version2::STOP_MOTION;
  return callForFile(repetitions == 0 ? stop : protocol::version2::PLAY_MOTION,
                     protocol::version2::MotionOrder{0, repetitions, ""}, name);
}

inline Call callToStop(const std::string& name) {
  return callToPlay(name, 0);
}

inline Call callToStore(const std::string& name, const Call::Bytes& content) {
  return callForFile(protocol::version2::STORE_MOTION,
                     protocol::version2::MotionUpload{"", content.data(), content.size()}, name);
}

inline Call callToDelete(const std::string& name) {
  return callForFile(protocol::version2::DELETE_MOTION, protocol::version2::MotionToDelete(), name);
}

inline Call callToFetchPicture(const std::string& name) {
  return callForFile(protocol::version2::FETCH_STICK_PICTURE, protocol::version2::StickPicture(), name,
                     protocol::version2::FETCH_PICTURE);
}

/// Silence, as many samples as the part has.
inline Call callToPlaySamples(const aibo_client::SoundPart& part) {
  const Call::Bytes samples(2 * part.size);
  Call call = makeCall(protocol::version2::PLAY_SOUND,
                       protocol::version2::PlayedSound{part.position, part.is_last, samples.data(), samples.size()}, "",
                       protocol::version2::SOUND_SPEAKER);
  call.sound_part = part;
  return call;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_CALLS_H
