#include "client/call.h"

#include <algorithm>
#include <utility>

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// The lowest rate of a transfer. A weak wireless link of 1 Mbit/s has this much left beside a stream, and a memory
// stick is about as fast.
constexpr std::size_t kSlowestTransfer = 32 * 1024;  // bytes/s

std::string allowedBy(const std::string& setting) {
  return "is it allowed? OPEN-R/MW/CONF/RCSERVER.CFG on the robot's memory stick needs a line " + setting +
         "=yes; it is read when the robot starts";
}

std::string explain(const Call& call, int code) {
  if (code == protocol::ERROR_FILE_MISSING) {
    return "there is no such file in OPEN-R/MW/DATA/P on its memory stick, or it cannot be read";
  }
  if (code == protocol::ERROR_NOT_A_MOTION) {
    return "it does not accept this as the name of a motion";
  }
  if (call.request.setting != nullptr) {
    return allowedBy(call.request.setting);
  }
  return call.request.letter == version2::REQUEST_PLAY ? "are its motors on, and is the file a motion for this robot?"
                                                       : "";
}

/// Makes the version 1 request for a file.
Call::Bytes fileRequest(char letter, const std::string& name, int number = 0, const Call::Bytes& content = {}) {
  protocol::FileRequest file = {};
  name.copy(file.name, protocol::MAX_FILE_NAME_SIZE);
  file.a = static_cast<unsigned short>(number);
  if (!content.empty()) {
    protocol::announceContent(content.size(), &file);
  }
  Call::Bytes bytes(protocol::FILE_REQUEST_SIZE);
  bytes[0] = static_cast<std::uint8_t>(letter);
  protocol::encodeFileRequest(file, bytes.data() + protocol::BASIC_COMMAND_SIZE);
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

/// Makes a call whose payload begins or ends with the name of what it is for.
template <typename Payload>
Call makeNamedCall(const version2::Request& request, Payload payload, const std::string& name) {
  name.copy(payload.name, protocol::MAX_FILE_NAME_SIZE);
  Call call = makeCall(request, name);
  call.payload = encoded(payload);
  return call;
}

Call makeStickCall(const version2::Request& request, version2::StickPictureRequest id, const std::string& name) {
  Call call = makeNamedCall(request, version2::StickPicture{}, name);
  call.id = id;
  return call;
}

/// @param read decides which names are accepted
Call::ReadAnswer readNames(version2::ReadFileName read) {
  return [read](const unsigned char* payload, std::size_t size, Answer* answer) {
    version2::FileList list;
    const char* const problem = version2::decodeFileList(read, payload, size, &list);
    answer->names.assign(list.names, list.names + (problem == nullptr ? list.count : 0));
    return problem;
  };
}

}  // namespace

Answer makeFailure(CallOutcome outcome, const std::string& problem, FaultKind fault) {
  Answer answer;
  answer.outcome = outcome;
  answer.problem = problem;
  answer.fault = fault;
  return answer;
}

bool Call::cancels(const Call& other) const {
  const bool stops_it = has(version2::STOPS_MOTIONS) && other.request.letter == version2::REQUEST_PLAY &&
                        (object.empty() || object == other.object);
  return other.terms && (has(version2::STOPS_ROBOT) || stops_it);
}

void Call::dropFrom(CommandOutbox* commands) const {
  const std::string reason = "the robot was told to " + describe(*this) + " before it was sent";
  if (has(version2::STOPS_ROBOT) || has(version2::TAKES_OVER_JOINTS)) {
    commands->stopJoints(joints, reason);
  }
  if (has(version2::ENDS_WALK) && (joints.empty() || std::any_of(joints.begin(), joints.end(), isOfLeg))) {
    commands->stopWalk(has(version2::STOPS_ROBOT), reason);
  }
}

std::optional<RefusedRequest> refusedRequest(char letter) {
  switch (letter) {
    case version2::REQUEST_JOINTS:
      return RefusedRequest::kJoints;
    case version2::REQUEST_SPEED_LIMITS:
      return RefusedRequest::kSpeedLimits;
    case version2::REQUEST_STEER:
      return RefusedRequest::kWalk;
    case version2::REQUEST_LEDS:
    case protocol::REQUEST_FACE_LEDS:
      return RefusedRequest::kLeds;
    case version2::REQUEST_EARS:
      return RefusedRequest::kEars;
    case version2::REQUEST_SOUND:
      return RefusedRequest::kMicrophone;
    case version2::REQUEST_PLAY:
      return RefusedRequest::kMotion;
    case version2::REQUEST_POSTURE:
      return RefusedRequest::kPosture;
    default:
      return std::nullopt;
  }
}

std::string describe(const Call& call) {
  return call.object.empty() ? call.request.words : call.request.words + (" " + call.object);
}

std::string explainRefusal(const Call& call, int code) {
  const std::string code_text = "error code " + std::to_string(code);
  const std::string hint = call.isForPicture() ? "" : explain(call, code);
  return hint.empty() ? code_text : hint + " (" + code_text + ")";
}

bool isKnownToVersion1(const Call& call) {
  return !call.version1.empty() ||
         (call.isForPicture() && call.resolution.value_or(Resolution::kHigh) == Resolution::kHigh);
}

Call makeCall(const version2::Request& request, const std::string& object) {
  Call call;
  call.request = request;
  call.object = object;
  return call;
}

Call callForPicture(int quality, std::optional<Resolution> resolution) {
  const bool is_usual = resolution.value_or(Resolution::kHigh) == Resolution::kHigh;
  Call call = makeCall(version2::TAKE_PICTURE, is_usual ? "" : "of this resolution");
  call.quality = quality;
  call.resolution = resolution;
  return call;
}

Call callForMotors(bool on) {
  Call call = makeCall(on ? version2::SWITCH_MOTORS_ON : version2::SWITCH_MOTORS_OFF);
  call.payload = encoded(version2::MotorOrder{0, on});
  call.read_answer = readAs<version2::MotorState>(
      [](const version2::MotorState& state, Answer* answer) { answer->motors_on = state.on; });
  return call;
}

Call callToHold(const std::vector<int>& joints) {
  Call call = makeCall(version2::HOLD);
  call.joints = joints;
  call.id = joints.empty() ? version2::HOLD_EVERYTHING : version2::HOLD_JOINTS;
  call.payload.assign(joints.begin(), joints.end());
  return call;
}

Call callForPosture(version2::Posture posture) {
  Call call = makeCall(version2::TAKE_POSTURE, version2::postureName(posture));
  call.id = posture;
  call.payload = encoded(version2::PostureOrder{0});
  return call;
}

Call callToPlay(const std::string& name, int repetitions, int bits) {
  Call call = makeNamedCall(version2::PLAY_MOTION,
                            version2::MotionOrder{0, static_cast<unsigned short>(repetitions), ""}, name);
  call.id = bits;
  call.version1 = fileRequest(version2::REQUEST_PLAY, name, repetitions);
  call.read_answer = readAs<version2::MotionChanges>([](const version2::MotionChanges& changes, Answer* answer) {
    answer->changes.assign(changes.text, changes.text_size);
  });
  return call;
}

Call callToStop(const std::string& name) {
  Call call =
      makeNamedCall(name.empty() ? version2::STOP_ALL_MOTIONS : version2::STOP_MOTION, version2::MotionOrder{}, name);
  call.version1 = fileRequest(version2::REQUEST_PLAY, name);
  return call;
}

Call callToStore(const std::string& name, const Call::Bytes& content, int bits) {
  Call call = makeNamedCall(version2::STORE_MOTION, version2::MotionUpload{"", content.data(), content.size()}, name);
  call.id = bits;
  call.version1 = fileRequest(version2::REQUEST_UPLOAD, name, 0, content);
  return call;
}

Call callToDelete(const std::string& name) {
  Call call = makeNamedCall(version2::DELETE_MOTION, version2::MotionToDelete{}, name);
  call.version1 = fileRequest(version2::REQUEST_DELETE, name);
  return call;
}

Call callForMotions() {
  Call call = makeCall(version2::LIST_MOTIONS);
  call.read_answer = readNames(protocol::readMotionName);
  return call;
}

Call callToSavePicture(int quality) {
  Call call = makeCall(version2::SAVE_PICTURE);
  call.id = quality;
  call.read_answer = readAs<version2::StickPicture>(
      [](const version2::StickPicture& picture, Answer* answer) { answer->names.emplace_back(picture.name); });
  return call;
}

Call callForStickPictures() {
  Call call = makeStickCall(version2::LIST_STICK_PICTURES, version2::LIST_PICTURES, "");
  call.read_answer = readNames(protocol::readPictureName);
  return call;
}

Call callToFetchPicture(const std::string& name) {
  Call call = makeStickCall(version2::FETCH_STICK_PICTURE, version2::FETCH_PICTURE, name);
  call.read_answer = readAs<version2::FetchedPicture>([](const version2::FetchedPicture& picture, Answer* answer) {
    answer->file.assign(picture.content, picture.content + picture.size);
  });
  return call;
}

Call callToDeletePicture(const std::string& name) {
  return makeStickCall(version2::DELETE_STICK_PICTURE, version2::DELETE_PICTURE, name);
}

Call callToPlaySamples(const SoundPart& part, const std::vector<std::int16_t>& samples) {
  Call call = makeCall(version2::PLAY_SOUND);
  setSamples(part, samples, &call);
  return call;
}

void setSamples(const SoundPart& part, const std::vector<std::int16_t>& samples, Call* call) {
  Call::Bytes bytes(samples.size() * version2::BYTES_PER_SAMPLE);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    protocol::encodeBigEndian16(static_cast<unsigned short>(samples[i]), &bytes[i * version2::BYTES_PER_SAMPLE]);
  }
  call->id = version2::SOUND_SPEAKER;
  call->payload = encoded(version2::PlayedSound{part.position, part.is_last, bytes.data(), bytes.size()});
  call->sound_part = part;
  call->read_answer =
      readAs<version2::SpeakerRoom>([sound = part.sound](const version2::SpeakerRoom& room, Answer* answer) {
        answer->sound = {sound, std::min(room.samples, version2::SPEAKER_CAPACITY)};
      });
}

Call callForVolume(int volume) {
  Call call = makeCall(version2::SET_VOLUME);
  call.id = version2::SOUND_VOLUME;
  call.payload = encoded(version2::Volume{static_cast<unsigned char>(volume)});
  call.read_answer = [](const unsigned char* payload, std::size_t size, Answer* answer) {
    version2::Volume in_force;
    const char* const problem = version2::decode(payload, size, &in_force);
    answer->volume = in_force.step;
    return problem != nullptr || in_force.step <= version2::MAX_VOLUME ? problem
                                                                       : "it does not say the volume in force";
  };
  return call;
}

Call callToGoOff(const version2::Request& request) {
  Call call = makeCall(request);
  call.version1 = {static_cast<std::uint8_t>(request.letter), 0, 0, 0};
  return call;
}

template <typename Condition>
Call* PendingCalls::nextUnsent(const Condition& condition) {
  const auto found = std::find_if(calls_.begin(), calls_.end(),
                                  [&](const Call& call) { return call.request_number == 0 && condition(call); });
  return found == calls_.end() ? nullptr : &*found;
}

Call* PendingCalls::nextForPicture() {
  return nextUnsent([](const Call& call) { return call.isForPicture(); });
}

Call* PendingCalls::nextStop() {
  return nextUnsent([](const Call& call) { return call.has(version2::STOPS_ROBOT); });
}

Call* PendingCalls::nextForRobot(bool with_orders) {
  const bool is_at_work = std::any_of(calls_.begin(), calls_.end(), [](const Call& call) {
    return call.request_number != 0 && call.has(version2::NEEDS_MEMORY_STICK);
  });
  return nextUnsent([=](const Call& call) {
    return !call.isForPicture() && !(is_at_work && call.has(version2::NEEDS_MEMORY_STICK)) &&
           (with_orders || !call.terms);
  });
}

Call* PendingCalls::find(int request_number) {
  const auto found = std::find_if(calls_.begin(), calls_.end(), [request_number](const Call& call) {
    return call.request_number != 0 && call.request_number == request_number;
  });
  return found == calls_.end() ? nullptr : &*found;
}

void PendingCalls::answer(int request_number, Answer answer) {
  endIf([request_number](const Call& call) { return call.request_number == request_number; },
        [&answer](const Call&) { return std::move(answer); });
}

void PendingCalls::answerFromStream(const PicturePtr& picture, int quality) {
  if (calls_.empty()) {
    return;
  }
  Answer answer;
  answer.picture = picture;
  answer.stream_quality = quality;
  endIf(
      [&picture](const Call& call) {
        return call.request_number == 0 && call.isForPicture() && call.since < picture->first_byte_time;
      },
      [&answer](const Call&) { return answer; });
}

PendingCalls::TimePoint PendingCalls::nextDeadline() const {
  TimePoint earliest = TimePoint::max();
  for (const Call& call : calls_) {
    earliest = std::min(earliest, call.deadline);
  }
  return earliest;
}

void PendingCalls::failAll(const Answer& failure) {
  endIf([](const Call&) { return true; }, [&failure](const Call&) { return failure; });
}

void PendingCalls::transferBegins(std::size_t size, TimePoint now) {
  transfer_end_ = std::max(transfer_end_, now) + std::chrono::milliseconds(size * 1000 / kSlowestTransfer);
}

}  // namespace aibo_client
