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

/// Compares the pictures that a driver publishes with those that the robot has sent, by what the robot's picture log
/// tells. No picture may be published twice, nor after a newer one, nor with a stamp that is not after the last one's;
/// none that the robot has not sent; what is left out while all is calm is counted. No I/O. Not thread-safe.
class PictureAudit {
 public:
  using Time = std::chrono::system_clock::time_point;

  /// The robot is about to send a picture.
  /// @param line of the picture log: the camera's time in nanoseconds since 1970, bytes of the JPEG, its CRC-32
  void sent(const std::string& line);

  /// The driver has published a picture, all of whose lines were told before.
  /// @param stamp in nanoseconds
  /// @return what was not as it has to be
  std::vector<std::string> published(const std::vector<std::uint8_t>& jpeg, std::uint64_t stamp);

  /// Bytes are changed on the way from now on, or no more: then pictures that the robot has not sent are only counted.
  void setDamaging(bool damaging) { damaging_ = damaging; }

  /// From the picture on that was published last, all is calm; or not any more.
  void setCalm(bool calm) { calm_ = calm; }

  /// The number of the picture that was sent last, 1 and up; 0 if there was none.
  std::uint64_t lastSent() const { return last_sent_; }

  /// The number of the picture that was published last; 0 if there was none.
  std::uint64_t lastPublished() const { return last_published_; }

  /// When the camera saw the picture that was published last.
  Time lastPublishedTime() const { return last_published_time_; }

  /// Pictures published so far.
  std::uint64_t count() const { return count_; }

  /// Of these, pictures that were published in calm stretches.
  std::uint64_t calmCount() const { return calm_count_; }

  /// Pictures that the robot sent in calm stretches and that were left out.
  std::uint64_t lostInCalm() const { return lost_in_calm_; }

  /// Of those published, pictures that were changed on the way.
  std::uint64_t damagedCount() const { return damaged_count_; }

 private:
  struct Sent {
    std::uint64_t number;
    Time time;
    std::size_t bytes;
    std::uint32_t checksum;
  };

  const Sent* find(const std::vector<std::uint8_t>& jpeg) const;

  std::deque<Sent> sent_;  // the oldest first
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
