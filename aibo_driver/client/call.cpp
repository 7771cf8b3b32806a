#include "client/call.h"

#include <algorithm>
#include <utility>

#include "protocol/motion_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace aibo_driver {

namespace version2 = protocol::version2;

namespace {

// What a weak wireless link of 1 Mbit/s leaves beside a stream, and a memory stick takes.
constexpr std::size_t kSlowestTransfer = 32 * 1024;  // bytes/s

std::string allowedBy(const std::string& setting) {
  return "is it allowed? OPEN-R/MW/CONF/RCSERVER.CFG on the robot's memory stick needs a line " + setting +
         "=yes; it is read when the robot starts";
}

/// @param name of a file, or empty
void copyName(const std::string& name, protocol::FileName& out) {
  name.copy(out, protocol::MAX_FILE_NAME_SIZE);
  out[name.size()] = '\0';
}

Call::Bytes encodeFileRequest(const Call& call) {
  protocol::FileRequest file = {};
  copyName(call.name, file.name);
  file.a = static_cast<unsigned short>(call.number);
  if (!call.content.empty()) {
    protocol::announceContent(call.content.size(), &file);
  }
  Call::Bytes bytes(protocol::FILE_REQUEST_SIZE);
  bytes[0] = static_cast<std::uint8_t>(call.letter);
  protocol::encodeFileRequest(file, bytes.data() + protocol::BASIC_COMMAND_SIZE);
  bytes.insert(bytes.end(), call.content.begin(), call.content.end());
  return bytes;
}

std::size_t encodeUpload(const Call& call, unsigned char* out) {
  version2::MotionUpload upload = {};
  copyName(call.name, upload.name);
  upload.content = call.content.data();
  upload.content_size = call.content.size();
  return version2::encodeMotionUpload(upload, out);
}

std::size_t encodeJoints(const Call& call, unsigned char* out) {
  version2::JointIds joints = {};
  for (const int id : call.joints) {
    joints.ids[joints.count++] = static_cast<unsigned char>(id);
  }
  return version2::encodeJointIds(joints, out);
}

std::size_t encodeName(const Call& call, unsigned char* out) {
  protocol::MotionName name;
  copyName(call.name, name);
  return version2::encodeMotionName(name, out);
}

std::size_t encodeOrder(const Call& call, unsigned char* out) {
  version2::MotionOrder order = {};
  copyName(call.name, order.name);
  order.repetitions = static_cast<unsigned short>(call.number);
  return version2::encodeMotionOrder(order, out);
}

// Without a name for a list.
std::size_t encodePicture(const Call& call, unsigned char* out) {
  protocol::PictureName name;
  copyName(call.name, name);
  return version2::encodePictureName(name, out);
}

std::string describeStickPictures(const Call& call) {
  switch (call.id) {
    case version2::LIST_PICTURES:
      return "list the pictures on its memory stick";
    case version2::FETCH_PICTURE:
      return "send the picture " + call.name;
    default:
      return "delete the picture " + call.name;
  }
}

std::string explain(const Call& call, int code) {
  switch (code) {
    case protocol::ERROR_FILE_MISSING:
      return "there is no such file in OPEN-R/MW/DATA/P on its memory stick, or it cannot be read";
    case protocol::ERROR_NOT_A_MOTION:
      return "it does not accept this as the name of a motion";
    default:
      break;
  }
  switch (call.letter) {
    case version2::REQUEST_UPLOAD:
      return allowedBy("ALLOW_UPLOAD");
    case version2::REQUEST_DELETE:
      return allowedBy("ALLOW_DELETE");
    case version2::REQUEST_PLAY:
      return "are its motors on, and is the file a motion for this robot?";
    case version2::REQUEST_SHUT_DOWN:
      return allowedBy("ALLOW_SHUT_DOWN");
    case version2::REQUEST_REBOOT:
      return allowedBy("ALLOW_REBOOT");
    default:
      return "";
  }
}

}  // namespace

Answer makeFailure(CallOutcome outcome, const std::string& problem, FaultKind fault) {
  Answer answer;
  answer.outcome = outcome;
  answer.problem = problem;
  answer.fault = fault;
  return answer;
}

bool Call::isForPicture() const {
  return letter == version2::REQUEST_PICTURE;
}

bool Call::stopsRobot() const {
  return letter == version2::REQUEST_HOLD || (letter == version2::REQUEST_MOTORS && number == 0);
}

bool Call::stopsMotions() const {
  return letter == version2::REQUEST_PLAY && number == 0;
}

bool Call::cancels(const Call& other) const {
  if (other.letter == version2::REQUEST_POSTURE) {
    return stopsRobot();
  }
  return other.letter == version2::REQUEST_PLAY && other.number > 0 &&
         (stopsRobot() || (stopsMotions() && (name.empty() || name == other.name)));
}

bool Call::needsMemoryStick() const {
  return letter == version2::REQUEST_UPLOAD || letter == version2::REQUEST_DELETE || letter == version2::REQUEST_LIST ||
         letter == version2::REQUEST_SAVE_PICTURE || letter == version2::REQUEST_PICTURES ||
         (letter == version2::REQUEST_PLAY && number > 0);
}

std::size_t Call::largestAnswer() const {
  const bool fetches = letter == version2::REQUEST_PICTURES && id == version2::FETCH_PICTURE;
  return fetches ? version2::MAX_STICK_PICTURE_SIZE : 0;
}

bool Call::takesOverJoints() const {
  return letter == version2::REQUEST_MOTORS || letter == version2::REQUEST_POSTURE ||
         (letter == version2::REQUEST_PLAY && number > 0);
}

bool Call::endsWalk() const {
  if (letter == version2::REQUEST_HOLD) {
    return joints.empty() || std::any_of(joints.begin(), joints.end(), isOfLeg);
  }
  return letter == version2::REQUEST_POSTURE || stopsRobot();
}

void Call::dropFrom(CommandOutbox* commands, bool is_sent) const {
  if (is_sent != needsMemoryStick()) {
    return;
  }
  const std::string reason = "the robot was told to " + describe(*this) + " before it was sent";
  if (stopsRobot() || takesOverJoints()) {
    commands->stopJoints(joints, reason);
  }
  if (endsWalk()) {
    commands->stopWalk(reason);
  }
}

std::string describe(const Call& call) {
  switch (call.letter) {
    case version2::REQUEST_PICTURE:
      return !call.resolution || *call.resolution == Resolution::kHigh ? "take a picture"
                                                                       : "take a picture of this resolution";
    case version2::REQUEST_MOTORS:
      return call.number != 0 ? "switch the motors on" : "switch the motors off";
    case version2::REQUEST_HOLD:
      return "hold its joints";
    case version2::REQUEST_POSTURE:
      return std::string("take the posture ") + version2::postureName(static_cast<version2::Posture>(call.id));
    case version2::REQUEST_UPLOAD:
      return "store the motion " + call.name;
    case version2::REQUEST_DELETE:
      return "delete the motion " + call.name;
    case version2::REQUEST_PLAY:
      return (call.number != 0 ? "play " : "stop ") + (call.name.empty() ? "all motions" : "the motion " + call.name);
    case version2::REQUEST_LIST:
      return "list its motions";
    case version2::REQUEST_SAVE_PICTURE:
      return "take a picture onto its memory stick";
    case version2::REQUEST_PICTURES:
      return describeStickPictures(call);
    case version2::REQUEST_SHUT_DOWN:
      return "shut down";
    default:
      return "reboot";
  }
}

std::string explainRefusal(const Call& call, int code) {
  const std::string code_text = "error code " + std::to_string(code);
  const std::string hint = call.isForPicture() ? "" : explain(call, code);
  return hint.empty() ? code_text : hint + " (" + code_text + ")";
}

bool isKnownToVersion1(const Call& call) {
  if (call.resolution && *call.resolution != Resolution::kHigh) {
    return false;
  }
  return call.letter != version2::REQUEST_MOTORS && call.letter != version2::REQUEST_HOLD &&
         call.letter != version2::REQUEST_LIST && call.letter != version2::REQUEST_POSTURE &&
         call.letter != version2::REQUEST_SAVE_PICTURE && call.letter != version2::REQUEST_PICTURES;
}

Call::Bytes encodeForVersion1(const Call& call) {
  const bool about_motion = call.letter != protocol::REQUEST_SHUT_DOWN && call.letter != protocol::REQUEST_REBOOT;
  if (about_motion) {
    return encodeFileRequest(call);
  }
  return {static_cast<std::uint8_t>(call.letter), 0, 0, 0};
}

std::size_t largestPayload(const Call& call) {
  // No other request of these is longer than one about a file.
  return call.letter == version2::REQUEST_HOLD ? version2::MAX_JOINT_IDS_SIZE
                                               : protocol::FILE_REQUEST_SIZE + call.content.size();
}

int idForVersion2(const Call& call) {
  if (call.letter == version2::REQUEST_SAVE_PICTURE) {
    return call.number;
  }
  return call.letter == version2::REQUEST_HOLD && !call.joints.empty() ? version2::HOLD_JOINTS : call.id;
}

std::size_t encodeForVersion2(const Call& call, unsigned char* out) {
  switch (call.letter) {
    case version2::REQUEST_MOTORS:
      return version2::encodeMotorState(call.number != 0, out);
    case version2::REQUEST_HOLD:
      return encodeJoints(call, out);
    case version2::REQUEST_UPLOAD:
      return encodeUpload(call, out);
    case version2::REQUEST_DELETE:
      return encodeName(call, out);
    case version2::REQUEST_PLAY:
      return encodeOrder(call, out);
    case version2::REQUEST_PICTURES:
      return encodePicture(call, out);
    default:
      return 0;
  }
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
  return nextUnsent([](const Call& call) { return call.stopsRobot(); });
}

Call* PendingCalls::nextForRobot() {
  const bool is_at_work = std::any_of(calls_.begin(), calls_.end(), [](const Call& call) {
    return call.request_number != 0 && !call.is_late && call.needsMemoryStick();
  });
  return nextUnsent(
      [is_at_work](const Call& call) { return !call.isForPicture() && !(is_at_work && call.needsMemoryStick()); });
}

Call* PendingCalls::find(int request_number) {
  const auto found = std::find_if(calls_.begin(), calls_.end(), [request_number](const Call& call) {
    return call.request_number != 0 && call.request_number == request_number;
  });
  return found == calls_.end() ? nullptr : &*found;
}

template <typename Condition, typename MakeAnswer>
void PendingCalls::endIf(const Condition& condition, const MakeAnswer& make_answer) {
  calls_.remove_if([&](Call& call) {
    const bool ends = condition(call);
    if (ends && !call.is_late) {
      Answer answer = make_answer(call);
      answer.was_sent = call.request_number != 0;
      call.promise.set_value(std::move(answer));
    }
    return ends;
  });
}

std::optional<LateAnswer> PendingCalls::answer(int request_number, Answer answer) {
  std::optional<LateAnswer> late;
  if (const Call* const call = find(request_number); call != nullptr && call->is_late) {
    late = {call->order, answer.outcome == CallOutcome::kDone, answer.problem, answer.changes};
  }
  endIf([request_number](const Call& call) { return call.request_number == request_number; },
        [&answer](const Call&) { return std::move(answer); });
  return late;
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
    earliest = call.is_late ? earliest : std::min(earliest, call.deadline);
  }
  return earliest;
}

void PendingCalls::expire(TimePoint now, const std::string& remark) {
  const auto is_over = [now](const Call& call) { return call.deadline <= now && !call.is_late; };
  const auto make_answer = [&remark](const Call& call) {
    const std::string time = " within " + std::to_string(call.timeout.count()) + " ms";
    if (call.isForPicture()) {
      return makeFailure(CallOutcome::kTimeout, "no picture" + time + remark);
    }
    return makeFailure(CallOutcome::kTimeout,
                       call.request_number != 0
                           ? "no answer" + time + ". The robot may or may not " + describe(call) + "."
                           : "the request could not be sent" + time + ".");
  };
  for (Call& call : calls_) {
    if (is_over(call) && call.request_number != 0 && call.order != 0) {
      Answer answer = make_answer(call);
      answer.was_sent = true;
      call.promise.set_value(std::move(answer));
      call.is_late = true;
    }
  }
  endIf(is_over, make_answer);
  const auto is_late = [](const Call& call) { return call.is_late; };
  if (std::count_if(calls_.begin(), calls_.end(), is_late) > kMostLate) {
    calls_.erase(std::find_if(calls_.begin(), calls_.end(), is_late));
  }
}

void PendingCalls::dropTooOld(TimePoint now, const std::string& address) {
  endIf([now](const Call& call) { return call.request_number == 0 && call.not_after <= now; },
        [&address](const Call& call) {
          return makeFailure(
              CallOutcome::kRefused,
              "The order to " + describe(call) + " is too old: it could not be sent to " + address + " in time.");
        });
}

PendingCalls::TimePoint PendingCalls::nextTooOld() const {
  TimePoint earliest = TimePoint::max();
  for (const Call& call : calls_) {
    earliest = call.request_number == 0 ? std::min(earliest, call.not_after) : earliest;
  }
  return earliest;
}

void PendingCalls::failCancelledBy(const Call& stop, const std::string& address) {
  endIf([&stop](const Call& call) { return call.request_number == 0 && stop.cancels(call); },
        [&](const Call& call) {
          return makeFailure(CallOutcome::kRefused, address + " was told to " + describe(stop) +
                                                        " before it was asked to " + describe(call) + ".");
        });
}

void PendingCalls::failAll(const Answer& failure) {
  endIf([](const Call&) { return true; }, [&failure](const Call&) { return failure; });
}

void PendingCalls::transferBegins(std::size_t size, TimePoint now) {
  transfer_end_ = std::max(transfer_end_, now) + std::chrono::milliseconds(size * 1000 / kSlowestTransfer);
}

}  // namespace aibo_driver
