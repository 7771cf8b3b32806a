/// @file picture_intake.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
#define AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aibo_client/camera.h"
#include "client/notifier.h"
#include "client/stall_detector.h"

namespace aibo_client {

/// Checks and delivers the pictures of one connection. It knows whether a stream is on, and which pictures are good and
/// fresh.
///
/// A version 1 server starts and stops the stream by the same request, and never acknowledges it. So the client knows
/// only how often it has sent this request. A new connection begins without a stream.
class PictureIntake {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// After a stream was stopped, its pictures may still arrive. If they do after this time, it has not been stopped.
  static constexpr std::chrono::milliseconds kStopTime{1000};

  /// The longest time between two images of a camera. An ERS-210 takes 25 a second, some of them a frame of 8 ms late.
  static constexpr std::chrono::milliseconds kLongestImageInterval{48};

  PictureIntake(const ConnectionContext& context, TimePoint connected);

  bool streaming() const { return streaming_; }
  /// The quality of the stream's pictures, 1..100. It is 0 if there has been no stream.
  int streamQuality() const { return quality_; }
  const StreamFormat& streamFormat() const { return format_; }

  /// Call this when the stream is switched on or off, or gets another quality or format.
  void streamRequested(bool on, int quality, TimePoint now, const StreamFormat& format = {});

  /// Call this when bytes of any kind were read.
  void bytesArrived(TimePoint now);
  /// Call this when nothing was left to read.
  void foundEmpty(TimePoint now) { stall_detector_.foundEmpty(now); }
  /// The latest time to look at the socket again, so that stale pictures can be told from fresh ones.
  TimePoint nextLook() const { return streaming_ ? stall_detector_.nextLook() : TimePoint::max(); }

  /// Call this when a picture is arriving or has just been requested.
  void signOfPicture(TimePoint now) { last_sign_ = now; }
  TimePoint lastSign() const { return last_sign_; }
  /// How much longer the next picture may take than it would if the stream had every image.
  std::chrono::milliseconds extraInterval() const { return (format_.every_nth_image - 1) * kLongestImageInterval; }

  /// While the stream is off, a picture that comes after this time can only be the answer to a request.
  TimePoint drainedAt() const { return quality_ == 0 ? off_since_ : off_since_ + kStopTime; }

  /// Turns the robot's bytes into a picture.
  /// @return null if it is damaged, which is counted and logged
  std::shared_ptr<Picture> inspect(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time);

  /// Gives a picture to the client's user.
  void deliver(const PicturePtr& picture);

  /// Gives a picture of the stream to the client's user, unless the stream is off or the picture has waited unread for
  /// too long.
  /// @return false if the picture was dropped, which is counted
  /// @throw ProtocolException the stream should have ended long ago
  bool deliverFromStream(const PicturePtr& picture, TimePoint now);

  /// Says at the end of a sentence how the last picture was damaged. It is "." if that one was good.
  std::string damageRemark() const;

 private:
  const ConnectionContext& context_;
  StallDetector stall_detector_;
  bool streaming_ = false;
  int quality_ = 0;
  StreamFormat format_;
  TimePoint off_since_;  // when the stream was switched off
  TimePoint last_sign_;
  TimePoint last_first_byte_;
  std::string last_damage_;
  bool last_is_damaged_ = false;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
