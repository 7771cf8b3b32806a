/// @file picture_requests.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
#define AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H

#include <chrono>
#include <deque>
#include <future>
#include <string>

#include "aibo_driver/picture.h"
#include "client/call_outcome.h"

namespace aibo_driver {

/// What RcServerClient::takePicture() waits for: a picture, or why there is none.
struct PictureAnswer {
  CallOutcome outcome = CallOutcome::kDone;
  PicturePtr picture;      ///< null unless done
  int stream_quality = 0;  ///< that of the running stream from which it was taken; 0 = taken for this call alone
  std::string problem;     ///< empty if done
};

/// A call of RcServerClient::takePicture() that is in progress.
struct PictureRequest {
  using Answer = PictureAnswer;
  using TimePoint = std::chrono::steady_clock::time_point;

  int quality = 0;                       ///< 0..100; 0 = the stream's
  std::chrono::milliseconds timeout{0};  ///< what the caller allowed, for messages
  TimePoint since;                       ///< pictures of the stream that began before are too old for it
  TimePoint deadline;                    ///< the caller waits no longer
  std::promise<Answer> promise;

  void answer(const PicturePtr& picture, int stream_quality) {
    promise.set_value({CallOutcome::kDone, picture, stream_quality, ""});
  }
  void fail(CallOutcome outcome, const std::string& problem) { promise.set_value({outcome, nullptr, 0, problem}); }
};

/// The requests that wait for a version 1 server, first come first served: its pictures do not say what they answer.
class PictureRequests {
 public:
  using TimePoint = PictureRequest::TimePoint;

  bool empty() const { return requests_.empty(); }
  const PictureRequest& front() const { return requests_.front(); }
  void add(PictureRequest request) { requests_.push_back(std::move(request)); }

  /// The deadline that passes first; TimePoint::max() if nobody waits.
  TimePoint nextDeadline() const;

  /// Gives a picture that the first request alone has asked for.
  void answerFront(const PicturePtr& picture);

  /// Gives a picture of the stream to everybody whose request is older than it.
  /// @param quality the stream's
  void answerFromStream(const PicturePtr& picture, int quality);

  /// The first request will not be answered.
  void failFront(CallOutcome outcome, const std::string& problem);

  /// None of the requests will be answered.
  void failAll(CallOutcome outcome, const std::string& problem);

  /// Ends the requests whose deadline has passed.
  /// @param remark added to the problem; may be empty
  void expire(TimePoint now, const std::string& remark);

 private:
  std::deque<PictureRequest> requests_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
