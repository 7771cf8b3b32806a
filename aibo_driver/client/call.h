/// @file call.h
/// Calls of RcServerClient that wait for the robot's answer.
#ifndef AIBO_DRIVER_CLIENT_CALL_H
#define AIBO_DRIVER_CLIENT_CALL_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/exceptions.h"
#include "aibo_client/orders.h"
#include "aibo_client/picture.h"
#include "client/command_outbox.h"
#include "client/sound_intake.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace aibo_client {

/// How a call has ended. A failure is a value until it has reached the caller's thread, and is thrown there.
enum class CallOutcome { kDone, kTimeout, kRefused, kConnectionLost, kStopped };

/// What a call waits for.
struct Answer {
  CallOutcome outcome = CallOutcome::kDone;
  std::string problem;                 ///< empty if done
  bool was_sent = false;               ///< the request had been sent when the call ended
  FaultKind fault = FaultKind::kNone;  ///< of the connection, if that is why the call failed

  PicturePtr picture;
  int stream_quality = 0;  ///< of the running stream that the picture is from; 0 = from none
  bool motors_on = false;
  std::vector<std::string> names;  ///< of motions or pictures
  std::vector<std::uint8_t> file;  ///< a picture that was fetched
  std::string changes;             ///< what the robot plays differently than the file says
  SoundProgress sound;
  int volume = 0;
};

/// The answer of a call that has failed.
Answer makeFailure(CallOutcome outcome, const std::string& problem, FaultKind fault = FaultKind::kNone);

/// One call in progress: a request that is sent once, and the caller's promise.
struct Call {
  using Bytes = std::vector<std::uint8_t>;
  using TimePoint = std::chrono::steady_clock::time_point;
  /// Reads the payload of an answer.
  /// @return nullptr, or what is wrong
  using ReadAnswer = std::function<const char*(const unsigned char* payload, std::size_t size, Answer* answer)>;

  protocol::version2::Request request = {};
  std::string object;      ///< what the request is for, as the words of the request go on; may be empty
  int id = 0;              ///< of the frame of version 2
  Bytes payload;           ///< of the frame of version 2
  Bytes version1;          ///< the whole request of version 1; empty: it has none
  ReadAnswer read_answer;  ///< of version 2; empty: it says nothing more

  int quality = 0;                       ///< of a picture; 0 = the stream's
  std::optional<Resolution> resolution;  ///< of a picture; none = the stream's
  std::optional<SoundPart> sound_part;   ///< that it sends
  std::vector<int> joints;               ///< to hold: identifiers; none = everything that moves

  std::chrono::milliseconds timeout{0};    ///< what the caller allowed, for messages
  TimePoint deadline;                      ///< when the caller stops waiting
  TimePoint not_after = TimePoint::max();  ///< when it becomes too old to be sent
  std::uint64_t order = 0;                 ///< OrderTerms::number
  bool is_late = false;                    ///< the caller has stopped waiting, and is told of the answer
  TimePoint since;                         ///< a picture of the stream answers only if it began later
  int request_number = 0;                  ///< of the request once it was sent; 0 = not sent
  std::promise<Answer> promise;

  bool isForPicture() const { return request.letter == protocol::version2::REQUEST_PICTURE; }
  bool has(protocol::version2::Trait trait) const { return request.has(trait); }

  /// True if `other`, which came before it and has not been sent, must not be sent any more.
  bool cancels(const Call& other) const;

  /// Drops the commands that came before it and must not be sent any more. To be called when the call is made, and when
  /// its request is sent: a motion may have to wait, and what is commanded meanwhile goes first.
  void dropFrom(CommandOutbox* commands, bool is_sent) const;
};

/// What is asked for, in words that follow "refused to ".
std::string describe(const Call& call);

/// Why a version 1 server answered this call with an error code, and what the user can do.
std::string explainRefusal(const Call& call, int code);

/// True if version 1 of the protocol has this request.
bool isKnownToVersion1(const Call& call);

/// A payload of version 2, encoded.
template <typename Payload>
Call::Bytes encoded(const Payload& payload) {
  Call::Bytes bytes(protocol::version2::encodedSize(payload));
  protocol::version2::encode(payload, bytes.data());
  return bytes;
}

/// A call with this request. Its payload is empty, and so is the answer's.
Call makeCall(const protocol::version2::Request& request, const std::string& object = "");

/// @name What RcServerClient asks for. Names and numbers are valid
/// @{
Call callForPicture(int quality, std::optional<Resolution> resolution);
Call callForMotors(bool on);
/// @param joints none = everything that moves
Call callToHold(const std::vector<int>& joints);
Call callForPosture(protocol::version2::Posture posture);
/// @param bits of motion_requests.h
Call callToPlay(const std::string& name, int repetitions, int bits);
/// @param name empty: all motions
Call callToStop(const std::string& name);
Call callToStore(const std::string& name, const Call::Bytes& content, int bits);
Call callToDelete(const std::string& name);
Call callForMotions();
Call callToSavePicture(int quality);
Call callForStickPictures();
Call callToFetchPicture(const std::string& name);
Call callToDeletePicture(const std::string& name);
/// @param samples none: the sound is stopped
Call callToPlaySamples(const SoundPart& part, const std::vector<std::int16_t>& samples);
Call callForVolume(int volume);
Call callToShutDown();
Call callToReboot();
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
  /// The oldest other unsent call, or null. While the robot is at work on its memory
  /// stick, calls that need it wait, so that the robot need not make one wait.
  Call* nextForRobot();

  /// The call whose request was sent with this number; null if there is none. A request of number 0 was never sent.
  Call* find(int request_number);
  const Call* find(int request_number) const { return const_cast<PendingCalls*>(this)->find(request_number); }

  /// Ends the call whose request was sent with this number, if there is one.
  /// @return the answer for a caller who has stopped waiting for it; none if there is no such caller
  std::optional<LateAnswer> answer(int request_number, Answer answer);

  /// Answers the unsent calls for a picture that were made before this picture of the stream began.
  void answerFromStream(const PicturePtr& picture, int quality);

  /// The deadline that passes first; TimePoint::max() if nobody waits.
  TimePoint nextDeadline() const;

  /// Ends the calls whose deadline has passed. Those that have been sent, and whose caller has given them a number, are
  /// kept for a late answer.
  /// @param remark added to the problem of those for a picture
  void expire(TimePoint now, const std::string& remark);

  /// Ends the unsent calls that are too old.
  /// @param address of the robot, for the message
  void dropTooOld(TimePoint now, const std::string& address);

  /// When dropTooOld() has something to end next; TimePoint::max() if nothing waits.
  TimePoint nextTooOld() const;

  /// Ends the calls that a stop cancels.
  /// @param address of the robot, for the message
  void failCancelledBy(const Call& stop, const std::string& address);

  /// Ends all calls.
  void failAll(const Answer& failure);

  /// A call's request is sent. A large one is an upload, a large answer a file: until it is through, pictures and
  /// answers are late.
  /// @param size of both
  void transferBegins(std::size_t size, TimePoint now);
  /// The request has been answered.
  void transferEnds(TimePoint now) { transfer_end_ = std::min(transfer_end_, now); }
  /// When the last transfer will be through at the latest, or was.
  TimePoint transferEnd() const { return transfer_end_; }

 private:
  /// The oldest unsent call that meets the condition, or null.
  template <typename Condition>
  Call* nextUnsent(const Condition& condition);

  /// Ends the calls that the condition holds for.
  template <typename Condition, typename MakeAnswer>
  void endIf(const Condition& condition, const MakeAnswer& make_answer);

  /// So many late calls are kept; a robot answers them sooner or later.
  static constexpr long kMostLate = 64;

  std::list<Call> calls_;
  TimePoint transfer_end_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CALL_H
