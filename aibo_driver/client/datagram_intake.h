/// @file datagram_intake.h
#ifndef AIBO_DRIVER_CLIENT_DATAGRAM_INTAKE_H
#define AIBO_DRIVER_CLIENT_DATAGRAM_INTAKE_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/picture_assembly.h"
#include "client/picture_intake.h"
#include "protocol/picture_datagram.h"

namespace aibo_client {

/// Receives the pictures of one connection that come by UDP, and tells the robot which are complete and which parts are
/// missing. It also notices when pictures should come by TCP instead. It does no I/O and reads no clock.
class DatagramIntake {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  /// The numbers of the first datagram and the first picture.
  struct Start {
    std::uint32_t sequence = 0;
    std::uint32_t picture = 0;
  };

  /// After this time without a datagram (our choice), pictures that were begun before are too old to be repeated.
  static constexpr std::chrono::milliseconds kOutage{200};

  /// If no good picture has come for this long, and in the time for kMostGivenUp pictures, although TCP works,
  /// something on the way swallows datagrams, most get lost, or somebody forges them.
  static constexpr std::chrono::milliseconds kSilence{1000};
  /// While the radio is out, TCP is silent, too. So the silence counts only if TCP has worked after pictures were
  /// missing for this long.
  static constexpr std::chrono::milliseconds kMissing{500};
  /// After an outage, an answer by TCP may come first. Then the next picture gets this much time.
  static constexpr std::chrono::milliseconds kGrace{200};
  /// After this many incomplete pictures in a row, the client goes back to TCP. If each picture has 4 datagrams and a
  /// tenth of them is lost, this happens by chance once in three years.
  static constexpr int kMostGivenUp = 20;
  /// The robot numbers the pictures that it sends, at most one in 32 ms, and has given up a client after 5 s of
  /// silence. So the number of a picture cannot be further ahead of the last good one.
  static constexpr std::int64_t kMostPicturesAhead = 256;
  /// Likewise, the number of a datagram cannot be further ahead of the last one. A picture has at most 98 datagrams.
  static constexpr std::int64_t kMostDatagramsAhead = 65536;

  /// A new status is sent at once. If nothing comes after it, datagrams or the status were lost. Then the status is
  /// repeated this often, at growing intervals.
  static constexpr int kMostRepeats = 4;
  /// If no part is missing, the next datagram belongs to the next picture. A camera needs up to 40 ms for it.
  static constexpr std::chrono::milliseconds kPictureInterval{50};
  /// If a part is missing, the next datagram is due after the time for kDatagrams, but not before kShortest. The radio
  /// itself takes a few milliseconds to repeat what it has lost.
  static constexpr int kDatagrams = 3;
  static constexpr std::chrono::milliseconds kShortest{8};

  explicit DatagramIntake(const ConnectionContext& context) : context_(&context) {}

  /// Call this when the robot is asked to send the stream's pictures as datagrams that count from this start.
  void begin(const Start& start, TimePoint now);
  /// Call this when the pictures come by TCP again.
  void end() { on_ = false; }
  bool on() const { return on_; }

  /// Call this when the robot has answered that request, and when the stream was switched on or changed: a picture is
  /// due from now on.
  void expectFrom(TimePoint now) {
    good_picture_ = now;
    tcp_worked_.reset();
  }

  /// Call this when something has come by TCP.
  void heardByTcp(TimePoint now);

  /// Call this when a datagram has come from the robot's address.
  /// @return true if the robot can have sent it
  bool arrived(const std::uint8_t* data, std::size_t size, TimePoint now);

  /// The next whole picture, in order. Call goodPicture() if its JPEG is good.
  /// @return empty if no picture is whole yet
  std::optional<PictureAssembly::Begun> takeWhole() { return on_ ? assembly_.takeWhole() : std::nullopt; }

  /// Call this when the JPEG of a whole picture is good.
  /// @param number PictureAssembly::Begun::number
  void goodPicture(std::int64_t number, TimePoint now);

  /// The status to send to the robot now.
  /// @return a datagram; empty if there is nothing new to say
  Bytes takeStatus(TimePoint now);

  /// The latest time to call takeStatus() again.
  TimePoint nextLook() const;

  /// The latest time to look at problem() again.
  /// @param extra_interval see PictureIntake::extraInterval()
  TimePoint deadline(std::chrono::milliseconds extra_interval) const;

  /// Why the pictures should come by TCP, in words that follow "pictures come by TCP: ". It is empty if all is well, or
  /// if they come by TCP already. Only call it while the stream is on.
  std::string problem(TimePoint now, std::chrono::milliseconds extra_interval) const;

  /// True if begin() was ever called.
  bool wereUsed() const { return used_; }

 private:
  using Status = protocol::version2::DatagramStatus;

  bool isPossible(const protocol::version2::PictureDatagram& datagram) const;
  bool isNew(const Status& status) const;
  void settle(std::int64_t number);
  void refuse(const std::string& problem);

  const ConnectionContext* context_;
  bool on_ = false;
  Start start_;
  bool used_ = false;
  TimePoint last_datagram_;  // when the last datagram came
  TimePoint good_picture_;   // when the last good picture came, or since when one is due
  /// When something first came by TCP while good pictures were missing for kMissing.
  std::optional<TimePoint> tcp_worked_;
  TimePoint::duration spacing_{0};  // the mean time between two datagrams of a picture; 0 until it is known
  std::int64_t last_picture_ = -1;  // the picture of the last datagram
  TimePoint last_exchange_;         // when a datagram last came or a status was sent
  int repeats_ = 0;                 // of the last status
  Status told_ = {};                // the last status
  std::int64_t next_sequence_ = 0;  // the number of the next datagram if none is lost
  PictureAssembly assembly_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_DATAGRAM_INTAKE_H
