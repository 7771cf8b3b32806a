/// @file picture_requests.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
#define AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H

#include <chrono>
#include <deque>
#include <future>
#include <string>

#include "aibo_driver/picture.h"

namespace aibo_driver {

/// What RcServerClient::takePicture() waits for: a picture, or why there is none. A failure is a value until it has
/// reached the caller's thread, and is thrown there.
struct PictureAnswer {
  enum class Outcome { kTaken, kTimeout, kRefused, kConnectionLost, kStopped };

  Outcome outcome = Outcome::kTaken;
  PicturePtr picture;        ///< null unless taken
  bool from_stream = false;  ///< taken from the running stream
  std::string problem;       ///< empty if taken
};

/// A call of RcServerClient::takePicture() that is in progress.
struct PictureRequest {
  using TimePoint = std::chrono::steady_clock::time_point;

  int quality = 0;                       ///< 0..100; 0 = the stream's
  std::chrono::milliseconds timeout{0};  ///< what the caller allowed, for messages
  TimePoint since;                       ///< pictures of the stream that began before are too old for it
  TimePoint deadline;                    ///< the caller waits no longer
  std::promise<PictureAnswer> promise;
};

/// The requests that are waiting, first come first served.
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
  void answerFromStream(const PicturePtr& picture);

  /// The first request will not be answered.
  void failFront(PictureAnswer::Outcome outcome, const std::string& problem);

  /// None of the requests will be answered.
  void failAll(PictureAnswer::Outcome outcome, const std::string& problem);

  /// Ends the requests whose deadline has passed.
  /// @param remark added to the problem; may be empty
  void expire(TimePoint now, const std::string& remark);

 private:
  std::deque<PictureRequest> requests_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
