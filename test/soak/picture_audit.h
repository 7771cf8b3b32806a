/// @file picture_audit.h
#ifndef TEST_SOAK_PICTURE_AUDIT_H
#define TEST_SOAK_PICTURE_AUDIT_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace soak {

/// Compares the pictures that a driver publishes with those that the robot has sent, according to its picture log. No
/// picture may come twice, after a newer one, or without having been sent, and stamps must increase. In calm periods,
/// pictures that are left out are counted. No I/O. Not thread-safe.
///
/// Unlike fault_bench::Witness, it knows only what the robot's own server logs: size, checksum and time.
class PictureAudit {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// The robot sends a picture.
  /// @param line of the picture log: the time of the image in nanoseconds since 1970, size of the JPEG in bytes, its
  /// CRC-32
  void sent(const std::string& line);

  /// The driver has published a picture. Call sent() before for all lines that were logged until then.
  /// @param stamp in nanoseconds
  /// @return the violations
  std::vector<std::string> published(const std::vector<std::uint8_t>& jpeg, std::uint64_t stamp);

  /// While bytes are damaged on the way, pictures that the robot has not sent are counted, but are no violation.
  void setDamaging(bool damaging) { damaging_ = damaging; }

  /// Begins or ends a calm period, with the picture after the last published one.
  void setCalm(bool calm) { calm_ = calm; }

  /// The number of the last picture sent; the first is 1; 0 if there was none.
  std::uint64_t lastSent() const { return last_sent_; }

  /// The number of the last picture published; 0 if there was none.
  std::uint64_t lastPublished() const { return last_published_; }

  /// The time of the image of the last picture published.
  Time lastPublishedTime() const { return last_published_time_; }

  /// Pictures published so far.
  std::uint64_t count() const { return count_; }

  /// Pictures published in calm periods.
  std::uint64_t calmCount() const { return calm_count_; }

  /// Pictures sent in calm periods that were not published.
  std::uint64_t lostInCalm() const { return lost_in_calm_; }

  /// Published pictures that had been damaged on the way.
  std::uint64_t damagedCount() const { return damaged_count_; }

 private:
  struct Sent {
    std::uint64_t number;
    Time time;
    std::size_t bytes;
    std::uint32_t checksum;
  };

  const Sent* find(const std::vector<std::uint8_t>& jpeg) const;

  std::deque<Sent> sent_;  // oldest first
  std::uint64_t last_sent_ = 0;
  std::uint64_t last_published_ = 0;
  Time last_published_time_;
  std::uint64_t last_stamp_ = 0;
  bool damaging_ = false;
  bool calm_ = false;
  std::uint64_t count_ = 0;
  std::uint64_t calm_count_ = 0;
  std::uint64_t lost_in_calm_ = 0;
  std::uint64_t damaged_count_ = 0;
};

}  // namespace soak

#endif  // TEST_SOAK_PICTURE_AUDIT_H
