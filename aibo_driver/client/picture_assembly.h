/// @file picture_assembly.h
#ifndef AIBO_DRIVER_CLIENT_PICTURE_ASSEMBLY_H
#define AIBO_DRIVER_CLIENT_PICTURE_ASSEMBLY_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "protocol/picture_datagram.h"

namespace aibo_client {

/// Puts the parts of pictures together. Only as many pictures as the robot keeps may be incomplete at a time. A newer
/// picture takes the place of the oldest one, and a whole picture replaces all older ones. The robot can be asked for a
/// lost part.
///
/// Datagrams can be forged. So only a good picture makes earlier ones too late.
class PictureAssembly {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// A picture of which parts have come.
  struct Begun {
    std::int64_t number;
    protocol::version2::ImageHeader header;
    std::vector<std::uint8_t> jpeg;
    std::vector<bool> has_part;
    std::size_t missing;   ///< how many parts are missing
    TimePoint began;       ///< when its first datagram came
    std::size_t sent = 0;  ///< the robot has sent at least this many parts
  };

  /// Adds a part, unless a newer picture has made it too late.
  /// @param bytes the bytes of the part, as many as the datagram says
  /// @return false if the picture cannot have this part, because other parts describe it differently
  bool add(const protocol::version2::PictureDatagram& datagram, const unsigned char* bytes, TimePoint now);

  /// Takes the oldest whole picture. It is newer than all that were settled. Call settle() if it is good.
  /// @return empty if there is none
  std::optional<Begun> takeWhole();

  /// The status to send to the robot.
  /// @param all_sent false: parts that may still be on their way are not asked for
  protocol::version2::DatagramStatus status(bool all_sent) const;

  /// True if a part is missing from a picture that was begun, or from one before it.
  bool isIncomplete() const { return newest_ >= nextWanted(); }

  /// Call this when a picture is good or too old. It settles this picture and all before it.
  void settle(std::int64_t number);

  /// The number of the newest settled picture; -1 if there is none.
  std::int64_t lastSettled() const { return last_settled_; }

  /// How many pictures before the last settled one were not whole. This includes pictures of which nothing came.
  std::uint64_t lost() const { return lost_; }

  /// How many pictures in a row were begun and given up since the last settled one.
  int givenUpInARow() const { return given_up_in_a_row_; }

 private:
  std::int64_t nextWanted() const;
  Begun& findOrBegin(const protocol::version2::PictureDatagram& datagram, TimePoint now);
  void giveUpOldest();

  std::map<std::int64_t, Begun> begun_;  // by the picture's number
  std::int64_t last_settled_ = -1;       // the number of the newest settled picture
  std::int64_t newest_ = -1;             // the newest picture of which a part has come
  std::uint64_t lost_ = 0;
  int given_up_in_a_row_ = 0;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_PICTURE_ASSEMBLY_H
