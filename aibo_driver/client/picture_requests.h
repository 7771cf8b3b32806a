/// @file picture_requests.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
#define AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H

#include <chrono>
#include <deque>
#include <exception>
#include <future>
#include <string>

#include "aibo_driver/picture.h"

namespace aibo_driver {

/// What RcServerClient::takePicture() waits for.
struct PictureAnswer {
  PicturePtr picture;
  bool from_stream = false;
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

  /// The first request has been refused or has failed.
  void failFront(const std::exception_ptr& why);

  /// Nobody will be answered any more.
  void failAll(const std::exception_ptr& why);

  /// Ends the requests whose deadline has passed, with a TimeoutException.
  /// @param remark added to its message; may be empty
  void expire(TimePoint now, const std::string& remark);

 private:
  std::deque<PictureRequest> requests_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_REQUESTS_H
