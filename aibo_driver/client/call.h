/// @file call.h
/// Requests of RcServerClient whose caller waits for the robot's answer.
#ifndef AIBO_DRIVER_CLIENT_CALL_H
#define AIBO_DRIVER_CLIENT_CALL_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/exceptions.h"
#include "aibo_client/orders.h"
#include "client/command_outbox.h"
#include "client/sound_intake.h"
#include "protocol/fields.h"
#include "protocol/request.h"
#include "protocol/version2.h"

namespace aibo_client {

/// One call in progress: a request that is sent once, and what to do at its end.
struct Call {
  using Bytes = std::vector<std::uint8_t>;
  using TimePoint = std::chrono::steady_clock::time_point;

  protocol::version2::Request request = {};
  std::string object;  ///< what the request is for; it follows the request's words in a message; may be empty
  int id = 0;          ///< the id in the frame of version 2
  Bytes payload;       ///< the payload of the frame of version 2; that of an order begins with 4 bytes for its expiry

  int quality = 0;                       ///< the quality of the picture; 0 means the stream's
  std::optional<Resolution> resolution;  ///< the resolution of the picture; empty means the stream's
  std::optional<SoundPart> sound_part;   ///< the samples that the call sends
  std::vector<int> joints;               ///< the ids of the joints to hold; empty means everything that moves

  std::chrono::milliseconds timeout{0};  ///< the time that the caller allowed, for messages
  TimePoint deadline;                    ///< when the caller stops waiting
  std::optional<OrderTerms> terms;       ///< the terms of a request that can become too old; otherwise empty
  int request_number = 0;                ///< the number of the request; 0 if it has not been sent

  /// @name How the call ends. The client's thread calls one of these functions, once
  /// @{
  /// Gives the caller the answer of version 2.
  /// @return nullptr, or what is wrong with the payload; the call then keeps waiting
  std::function<const char*(const unsigned char* payload, std::size_t size)> answer;
  /// Gives the caller the picture that answers the call.
  std::function<void(const PicturePtr& picture)> answer_with_picture;
  /// Throws this exception in the caller's thread.
  std::function<void(const std::exception_ptr& failure)> fail;
  /// @}

  bool isForPicture() const { return request.letter == protocol::version2::REQUEST_PICTURE; }
  bool has(protocol::version2::Trait trait) const { return request.has(trait); }
  bool wasSent() const { return request_number != 0; }

  /// True if this call keeps `other` from being sent. `other` was made before this call and has not been sent.
  bool cancels(const Call& other) const;

  /// The order's OrderTerms::number. It is 0 if this call is no order, or if the order has no number.
  std::uint64_t order() const { return terms ? terms->number : 0; }

  /// Drops the commands that must not be sent any more, because they are older than this call.
  void dropFrom(CommandOutbox* commands) const;
};

/// The kind under which a refusal of such a request is reported, in both versions of the protocol.
/// @param letter the letter of the request
/// @return empty if its refusal is only logged, or only thrown to its caller
std::optional<RefusedRequest> refusedRequest(char letter);

/// Describes the request in words to put after "refused to ".
std::string describe(const Call& call);

/// Encodes a payload of version 2.
template <typename Payload>
Call::Bytes encoded(const Payload& payload) {
  Call::Bytes bytes(protocol::version2::encodedSize(payload));
  protocol::version2::encode(payload, bytes.data());
  return bytes;
}

/// Makes a call.
/// @param object see Call::object
template <typename Payload = protocol::version2::NoPayload>
Call makeCall(const protocol::version2::Request& request, const Payload& payload = {}, const std::string& object = "",
              int id = 0) {
  Call call;
  call.request = request;
  call.object = object;
  call.id = id;
  call.payload = encoded(payload);
  return call;
}

/// A reply whose payload does not matter.
struct AnyReply {};
inline const char* decode(const unsigned char* /*payload*/, std::size_t /*size*/, AnyReply* /*reply*/) {
  return nullptr;
}

/// Lets a call end with what its reply means to the caller.
/// @tparam Reply a payload of version 2, or something else that decode() knows
/// @param read makes the caller's result from the reply
template <typename Reply, typename Read, typename Result = std::invoke_result_t<Read, const Reply&>>
std::future<Result> expectReply(Call* call, const Read& read) {
  const auto promise = std::make_shared<std::promise<Result>>();
  call->answer = [promise, read](const unsigned char* payload, std::size_t size) {
    Reply reply;
    const char* const problem = decode(payload, size, &reply);
    if (problem == nullptr) {
      if constexpr (std::is_void_v<Result>) {
        promise->set_value();
      } else {
        promise->set_value(read(reply));
      }
    }
    return problem;
  };
  call->fail = [promise](const std::exception_ptr& failure) { promise->set_exception(failure); };
  return promise->get_future();
}

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

  /// Ends the call whose request was sent with this number. There must be one.
  /// @throw ProtocolException the payload is no answer to this request; the call then keeps waiting
  void answer(int request_number, const unsigned char* payload, std::size_t size);
  void answer(int request_number, const PicturePtr& picture);

  /// Answers calls for a picture by this picture of the stream, if they are unsent and were made before it began.
  void answerFromStream(const PicturePtr& picture);

  /// The earliest deadline; TimePoint::max() if no call waits.
  TimePoint nextDeadline() const;

  /// Ends the calls that meet the condition with an exception.
  /// @param make_failure makes the exception from the call
  template <typename Condition, typename MakeFailure>
  void failIf(const Condition& condition, const MakeFailure& make_failure) {
    endIf(condition, [&](const Call& call) { call.fail(std::make_exception_ptr(make_failure(call))); });
  }

  /// Ends all calls, because the connection has ended.
  /// @param problem the text of their exceptions
  /// @param fault why it has ended; kNone if the client was stopped
  void failAll(const std::string& problem, FaultKind fault);

  /// Call this when a request is sent. While a large request or a large answer is on its way, pictures and other
  /// answers are late.
  /// @param size the bytes of the request and its answer together
  void transferBegins(std::size_t size, TimePoint now);
  /// Call this when a request was answered. Only transfers with the memory stick are large, and they go one at a time.
  void transferEnds(TimePoint now) { transfer_end_ = std::min(transfer_end_, now); }
  /// When the last transfer ended, or the latest time at which it will have ended.
  TimePoint transferEnd() const { return transfer_end_; }

 private:
  /// The oldest unsent call that meets the condition, or null.
  template <typename Condition>
  Call* nextUnsent(const Condition& condition);

  void remove(int request_number);

  template <typename Condition, typename End>
  void endIf(const Condition& condition, const End& end) {
    calls_.remove_if([&](const Call& call) {
      const bool ends = condition(call);
      if (ends) {
        end(call);
      }
      return ends;
    });
  }

  std::list<Call> calls_;
  TimePoint transfer_end_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_CALL_H
