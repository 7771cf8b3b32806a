/// @file call.h
/// Requests of RcServerClient whose caller waits for the robot's answer.
#ifndef AIBO_DRIVER_CLIENT_CALL_H
#define AIBO_DRIVER_CLIENT_CALL_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/exceptions.h"
#include "aibo_client/orders.h"
#include "client/command_outbox.h"
#include "client/sound_intake.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace aibo_client {

/// How a call has ended. A failure is passed to the caller's thread as a value and thrown there.
enum class CallOutcome { kDone, kTimeout, kRefused, kConnectionLost, kStopped };

/// The result of a call.
struct Answer {
  CallOutcome outcome = CallOutcome::kDone;
  std::string problem;                 ///< empty if done
  bool was_sent = false;               ///< the request had been sent when the call ended
  FaultKind fault = FaultKind::kNone;  ///< the fault of the connection, if that is why the call failed

  PicturePtr picture;
  int stream_quality = 0;  ///< the quality of the stream that the picture is from; 0 if it is from none
  bool motors_on = false;
  std::vector<std::string> names;  ///< the names of motions or pictures
  std::vector<std::uint8_t> file;  ///< a picture that was fetched
  std::string changes;             ///< what the robot plays differently from the file
  SoundProgress sound;
  int volume = 0;
};

/// The answer of a call that has failed.
Answer makeFailure(CallOutcome outcome, const std::string& problem, FaultKind fault = FaultKind::kNone);

/// One call in progress: a request that is sent once, and what to do at its end.
struct Call {
  using Bytes = std::vector<std::uint8_t>;
  using TimePoint = std::chrono::steady_clock::time_point;
  /// Reads the payload of an answer.
  /// @return nullptr, or what is wrong
  using ReadAnswer = std::function<const char*(const unsigned char* payload, std::size_t size, Answer* answer)>;

  protocol::version2::Request request = {};
  std::string object;  ///< what the request is for; it follows the request's words in a message; may be empty
  int id = 0;          ///< the id in the frame of version 2
  Bytes payload;       ///< the payload of the frame of version 2; that of an order begins with 4 bytes for its expiry
  Bytes version1;      ///< the whole request of version 1; empty if version 1 does not have it
  ReadAnswer read_answer;  ///< reads the answer of version 2; empty if that answer has no content

  int quality = 0;                       ///< the quality of the picture; 0 means the stream's
  std::optional<Resolution> resolution;  ///< the resolution of the picture; empty means the stream's
  std::optional<SoundPart> sound_part;   ///< the samples that the call sends
  std::vector<int> joints;               ///< the ids of the joints to hold; empty means everything that moves

  std::chrono::milliseconds timeout{0};  ///< the time that the caller allowed, for messages
  TimePoint deadline;                    ///< when the caller stops waiting
  std::optional<OrderTerms> terms;       ///< of a request that can be too old; otherwise empty
  TimePoint since;                       ///< a picture of the stream answers the call only if it began later
  int request_number = 0;                ///< the number of the request; 0 if it has not been sent
  std::function<void(Answer)> end;       ///< called once, with the answer, by the client's thread

  bool isForPicture() const { return request.letter == protocol::version2::REQUEST_PICTURE; }
  bool has(protocol::version2::Trait trait) const { return request.has(trait); }

  /// True if `other` must not be sent any more. `other` was made before this call and has not been sent.
  bool cancels(const Call& other) const;

  /// The order's OrderTerms::number. It is 0 if this call is no order, or if the order has no number.
  std::uint64_t order() const { return terms ? terms->number : 0; }

  /// Drops the commands that must not be sent any more, because they are older than this call.
  void dropFrom(CommandOutbox* commands) const;
};

/// How the refusal of such a request is told, in both versions of the protocol.
/// @param letter the letter of the request
/// @return empty if its refusal is only logged, or only told to its caller
std::optional<RefusedRequest> refusedRequest(char letter);

/// Describes the request in words that follow "refused to ".
std::string describe(const Call& call);

/// Why a version 1 server answered this call with an error code, and what the user can do.
std::string explainRefusal(const Call& call, int code);

/// True if version 1 of the protocol has this request.
bool isKnownToVersion1(const Call& call);

/// Encodes a payload of version 2.
template <typename Payload>
Call::Bytes encoded(const Payload& payload) {
  Call::Bytes bytes(protocol::version2::encodedSize(payload));
  protocol::version2::encode(payload, bytes.data());
  return bytes;
}

/// A Call::read_answer for an answer with this payload of version 2.
/// @param take called with the decoded payload and the Answer, unless the payload is malformed
template <typename Payload, typename Take>
Call::ReadAnswer readAs(const Take& take) {
  return [take](const unsigned char* bytes, std::size_t size, Answer* answer) {
    Payload payload;
    const char* const problem = protocol::version2::decode(bytes, size, &payload);
    if (problem == nullptr) {
      take(payload, answer);
    }
    return problem;
  };
}

/// Makes a call with an empty payload and an empty answer.
Call makeCall(const protocol::version2::Request& request, const std::string& object = "");

/// @name The calls of RcServerClient. Their names and numbers are valid
/// @{
Call callForPicture(int quality, std::optional<Resolution> resolution);
Call callForMotors(bool on);
/// @param joints empty means everything that moves
Call callToHold(const std::vector<int>& joints);
Call callForPosture(protocol::version2::Posture posture);
/// @param bits see motion_requests.h
Call callToPlay(const std::string& name, int repetitions, int bits);
/// @param name empty means all motions
Call callToStop(const std::string& name);
Call callToStore(const std::string& name, const Call::Bytes& content, int bits);
Call callToDelete(const std::string& name);
Call callForMotions();
Call callToSavePicture(int quality);
Call callForStickPictures();
Call callToFetchPicture(const std::string& name);
Call callToDeletePicture(const std::string& name);
/// @param samples the samples to play; an empty list stops the sound
Call callToPlaySamples(const SoundPart& part, const std::vector<std::int16_t>& samples);
/// Makes a call of PLAY_SOUND send these samples. An empty list stops the sound.
void setSamples(const SoundPart& part, const std::vector<std::int16_t>& samples, Call* call);
Call callForVolume(int volume);
/// @param request SHUT_DOWN or REBOOT
Call callToGoOff(const protocol::version2::Request& request);
/// @}

/// The calls of one connection, in the order in which they were made.
class PendingCalls {
 public:
  using TimePoint = Call::TimePoint;

  void add(Call call) { calls_.push_back(std::move(call)); }

  /// The oldest call for a picture that has not been sent; null if there is none.
  Call* nextForPicture();
  /// The oldest unsent call that stops the robot, or null.
  Call* nextStop();
  /// The oldest other unsent call, or null. While the robot works on its memory stick, calls that need the stick wait
  /// here, not in the robot.
  /// @param with_orders true: also calls that have terms
  Call* nextForRobot(bool with_orders);

  /// The call whose request was sent with this number; null if there is none. A request of number 0 was never sent.
  Call* find(int request_number);
  const Call* find(int request_number) const { return const_cast<PendingCalls*>(this)->find(request_number); }

  /// Ends the call whose request was sent with this number, if there is one.
  void answer(int request_number, Answer answer);

  /// Answers the unsent calls for a picture that were made before this picture of the stream began.
  void answerFromStream(const PicturePtr& picture, int quality);

  /// The earliest deadline; TimePoint::max() if no call waits.
  TimePoint nextDeadline() const;

  /// Ends the calls that meet the condition.
  /// @param make_answer called with the call before it ends
  template <typename Condition, typename MakeAnswer>
  void endIf(const Condition& condition, const MakeAnswer& make_answer) {
    calls_.remove_if([&](Call& call) {
      const bool ends = condition(call);
      if (ends) {
        Answer answer = make_answer(call);
        answer.was_sent = call.request_number != 0;
        call.end(std::move(answer));
      }
      return ends;
    });
  }

  /// Ends all calls.
  void failAll(const Answer& failure);

  /// Call this when a request is sent. While a large request or a large answer is on its way, pictures and other
  /// answers are late.
  /// @param size the bytes of the request and its answer together
  void transferBegins(std::size_t size, TimePoint now);
  /// The request has been answered. Only those that need the memory stick are large, and one of them is sent at a time.
  void transferEnds(TimePoint now) { transfer_end_ = std::min(transfer_end_, now); }
  /// When the last transfer has ended, or will have ended at the latest.
  TimePoint transferEnd() const { return transfer_end_; }

 private:
  /// The oldest unsent call that meets the condition, or null.
  template <typename Condition>
  Call* nextUnsent(const Condition& condition);

  std::list<Call> calls_;
  TimePoint transfer_end_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CALL_H
