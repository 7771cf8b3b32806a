#include "client/call.h"

#include <algorithm>

#include "client/fault.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/walk_requests.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// The lowest rate of a transfer. A weak wireless link of 1 Mbit/s has this much left beside a stream, and a memory
// stick is about as fast.
constexpr std::size_t kSlowestTransfer = 32 * 1024;  // bytes/s

}  // namespace

bool Call::cancels(const Call& other) const {
  const bool stops_it = has(version2::STOPS_MOTIONS) && other.request.letter == version2::REQUEST_PLAY &&
                        (object.empty() || object == other.object);
  return other.terms && (has(version2::STOPS_ROBOT) || stops_it);
}

void Call::dropFrom(CommandOutbox* commands) const {
  const std::string reason = "the robot was told to " + describe(*this) + " before this request was sent";
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

template <typename Condition>
Call* PendingCalls::nextUnsent(const Condition& condition) {
  const auto found =
      std::find_if(calls_.begin(), calls_.end(), [&](const Call& call) { return !call.wasSent() && condition(call); });
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
    return call.wasSent() && call.has(version2::NEEDS_MEMORY_STICK);
  });
  return nextUnsent([=](const Call& call) {
    return !call.isForPicture() && !(is_at_work && call.has(version2::NEEDS_MEMORY_STICK)) &&
           (with_orders || !call.terms);
  });
}

Call* PendingCalls::find(int request_number) {
  const auto found = std::find_if(calls_.begin(), calls_.end(), [request_number](const Call& call) {
    return call.wasSent() && call.request_number == request_number;
  });
  return found == calls_.end() ? nullptr : &*found;
}

void PendingCalls::answer(int request_number, const unsigned char* payload, std::size_t size) {
  const Call& call = *find(request_number);
  if (const char* const problem = call.answer(payload, size)) {
    throw ProtocolException("bad answer to the request to " + describe(call) + ": " + problem);
  }
  remove(request_number);
}

void PendingCalls::answer(int request_number, const PicturePtr& picture) {
  find(request_number)->answer_with_picture(picture);
  remove(request_number);
}

void PendingCalls::remove(int request_number) {
  calls_.remove_if([request_number](const Call& call) { return call.request_number == request_number; });
}

void PendingCalls::answerFromStream(const PicturePtr& picture) {
  endIf(
      [&picture](const Call& call) {
        return !call.wasSent() && call.isForPicture() && call.deadline - call.timeout < picture->first_byte_time;
      },
      [&](const Call& call) { call.answer_with_picture(picture); });
}

PendingCalls::TimePoint PendingCalls::nextDeadline() const {
  TimePoint earliest = TimePoint::max();
  for (const Call& call : calls_) {
    earliest = std::min(earliest, call.deadline);
  }
  return earliest;
}

void PendingCalls::failAll(const std::string& problem, FaultKind fault) {
  for (const Call& call : calls_) {
    switch (fault) {
      case FaultKind::kNone:
        call.fail(std::make_exception_ptr(StoppedException(problem)));
        break;
      case FaultKind::kSilent:
        call.fail(std::make_exception_ptr(TimeoutException(problem, fault, call.wasSent())));
        break;
      default:
        call.fail(std::make_exception_ptr(NetworkException(problem, fault, call.wasSent())));
    }
  }
  calls_.clear();
}

void PendingCalls::transferBegins(std::size_t size, TimePoint now) {
  transfer_end_ = std::max(transfer_end_, now) + std::chrono::milliseconds(size * 1000 / kSlowestTransfer);
}

}  // namespace aibo_client
