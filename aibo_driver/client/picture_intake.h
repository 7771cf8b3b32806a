/// @file picture_intake.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
#define AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aibo_driver/picture.h"
#include "client/counters.h"
#include "client/notifier.h"
#include "client/stall_detector.h"

namespace aibo_driver {

/// What the parts of a connection need to know of the client that they belong to.
struct ConnectionContext {
  std::string address;                     ///< of the server, for messages
  std::chrono::milliseconds read_timeout;  ///< a server that owes a picture and is silent for longer is given up
  const Notifier& notifier;
  Counters& counters;
  std::uint64_t number = 0;  ///< of the connection: 1 for the client's first

  /// Logs what the server did, as in "ADDRESS sent something strange.".
  void warn(const std::string& what) const { notifier.log(LogLevel::kWarn, address + " " + what + "."); }
};

/// The pictures of one connection: whether a stream is on, and which pictures are good and fresh.
///
/// For a version 1 server the number of toggles sent is all that is known of the stream: the same request starts and
/// stops it, and is never acknowledged. A new connection begins without a stream.
class PictureIntake {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Pictures of a stopped stream may still arrive until this long after the last one.
  static constexpr std::chrono::milliseconds kDrainTime{200};
  /// A stopped stream that still delivers after this time has not been stopped.
  static constexpr std::chrono::milliseconds kStopTime{1000};

  /// From one image of a camera to the next: 25 a second on an ERS-210, some of them a frame of 8 ms late.
  static constexpr std::chrono::milliseconds kLongestImageInterval{48};

  PictureIntake(const ConnectionContext& context, TimePoint connected);

  bool streaming() const { return streaming_; }
  /// Of the stream's pictures, 1..100; 0 = there has been no stream.
  int streamQuality() const { return quality_; }
  const StreamFormat& streamFormat() const { return format_; }

  /// To be called when the stream is switched on or off, or gets another quality or format.
  void streamRequested(bool on, int quality, TimePoint now, const StreamFormat& format = {});

  /// Bytes of any kind were read.
  void bytesArrived(TimePoint now);
  /// Nothing was left to read.
  void foundEmpty(TimePoint now) { stall_detector_.foundEmpty(now); }
  /// When to look at the socket again at the latest, so that stale pictures can be told from fresh ones.
  TimePoint nextLook() const { return streaming_ ? stall_detector_.nextLook() : TimePoint::max(); }

  /// A picture is arriving, or was asked for just now.
  void signOfPicture(TimePoint now) { last_sign_ = now; }
  TimePoint lastSign() const { return last_sign_; }
  /// How much longer than with every image of the camera the next picture may take.
  std::chrono::milliseconds extraInterval() const { return (format_.every_nth_image - 1) * kLongestImageInterval; }

  /// Bytes of a picture have come although the stream is off and none was asked for.
  void lateBytes(TimePoint now) { quiet_since_ = now; }
  /// From when on a picture can only be the answer to a request for one, if no more late bytes come.
  TimePoint drainedAt() const;

  /// Turns the robot's bytes into a picture.
  /// @return null if it is damaged, which is counted and logged
  std::shared_ptr<Picture> inspect(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time);

  /// Gives a picture to the client's user.
  void deliver(const PicturePtr& picture);

  /// The same with a picture of the stream, unless the stream is off or the picture has waited unread for too long.
  /// @return false if it was dropped, which is counted
  /// @throw ProtocolException the stream should have ended long ago
  bool deliverFromStream(const PicturePtr& picture, TimePoint now);

  /// What was wrong with the last damaged picture, as the end of a sentence; "." if there was none.
  std::string damageRemark() const;

 private:
  const ConnectionContext& context_;
  StallDetector stall_detector_;
  bool streaming_ = false;
  int quality_ = 0;
  StreamFormat format_;
  TimePoint off_since_;    // of the stream
  TimePoint quiet_since_;  // of the last late bytes; TimePoint::min() if there were none
  TimePoint last_sign_;
  TimePoint last_first_byte_;
  std::string last_damage_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_INTAKE_H
