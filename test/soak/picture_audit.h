/// @file picture_audit.h
#ifndef TEST_SOAK_PICTURE_AUDIT_H
#define TEST_SOAK_PICTURE_AUDIT_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace soak {

/// Compares the pictures that a driver publishes with those that the robot has sent. No picture may come twice, after a
/// newer one, or without having been sent, and stamps must increase. In calm periods, pictures that are left out are
/// counted. No I/O. Not thread-safe.
class PictureAudit {
 public:
  /// @param complain is called with each violation
  explicit PictureAudit(const std::function<void(const std::string&)>& complain) : complain_(complain) {}

  /// The robot sends a picture.
  void sent(const std::uint8_t* jpeg, std::size_t size);

  /// The driver has published a picture.
  /// @param stamp in nanoseconds
  void published(const std::vector<std::uint8_t>& jpeg, std::uint64_t stamp);

  /// Begins or ends a calm period, with the picture after the last published one.
  void setCalm(bool calm) { calm_ = calm; }

  std::uint64_t count() const { return count_; }              ///< of pictures published
  std::uint64_t calmCount() const { return calm_count_; }     ///< of those in calm periods
  std::uint64_t lostInCalm() const { return lost_in_calm_; }  ///< sent in calm periods, and not published

 private:
  struct Sent {
    std::uint64_t number;
    std::size_t bytes;
    std::uint32_t checksum;
  };

  const std::function<void(const std::string&)> complain_;
  std::deque<Sent> sent_;  // oldest first
  std::uint64_t last_sent_ = 0;
  std::uint64_t last_published_ = 0;
  std::uint64_t last_stamp_ = 0;
  bool calm_ = false;
  std::uint64_t count_ = 0;
  std::uint64_t calm_count_ = 0;
  std::uint64_t lost_in_calm_ = 0;
};

}  // namespace soak

#endif  // TEST_SOAK_PICTURE_AUDIT_H
