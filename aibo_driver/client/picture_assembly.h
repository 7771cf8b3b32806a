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

namespace aibo_driver {

/// Puts the parts of pictures together. Few pictures are incomplete at a time, so that what a robot sends cannot fill
/// the memory: a newer picture takes the place of the oldest, and a good one of all that are older. A part that is
/// lost is made from the parity of its group, if that has come.
///
/// Datagrams can be forged. So only a good picture makes those before it too late, and one whose number is far ahead
/// has a place of its own until it is good.
class PictureAssembly {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Parts of two pictures can be on their way at the same time if a network changes their order.
  static constexpr std::size_t kMostIncomplete = 2;

  /// A picture is far ahead if it is more than this after the last one that was settled: 2 s. Few are sent while
  /// nothing comes back.
  static constexpr std::int64_t kFarAhead = 64;

  /// A whole picture.
  struct Whole {
    std::int64_t number;
    protocol::version2::ImageHeader header;
    std::vector<std::uint8_t> jpeg;
    TimePoint began;  ///< when its first datagram came
  };

  enum class Result {
    kTaken,
    kUseless,       ///< this part is there already, or a good picture has made its picture too late
    kContradiction  ///< the picture cannot have this part: other parts describe it differently
  };

  /// Adds a part, or a parity.
  /// @param bytes of the part or the parity, as many as the datagram says
  /// @param[out] whole the picture, if this completes it; it is newer than all before it
  Result add(const protocol::version2::PictureDatagram& datagram, const unsigned char* bytes, TimePoint now,
             std::optional<Whole>* whole);

  /// A whole picture is good: it and those before it are settled.
  void settle(std::int64_t number);

  bool isFarAhead(std::int64_t number) const { return number > last_settled_ + kFarAhead; }

  /// Pictures before the last good one that have not become good, also those of which nothing came.
  std::uint64_t lost() const { return lost_; }

  /// Parts that were made from parities.
  std::uint64_t repaired() const { return repaired_; }

  /// How many pictures in a row were begun and given up since the last good one.
  int givenUpInARow() const { return given_up_in_a_row_; }

 private:
  struct Incomplete {
    protocol::version2::ImageHeader header;
    std::vector<std::uint8_t> jpeg;
    std::vector<bool> has_part;
    std::vector<std::vector<std::uint8_t>> parities;  // of each group; empty until it has come
    std::size_t missing;
    TimePoint began;
  };

  static bool take(const protocol::version2::PictureDatagram& datagram, const unsigned char* bytes,
                   Incomplete& picture);
  void repair(Incomplete& picture, std::size_t group);
  Incomplete* find(const protocol::version2::PictureDatagram& datagram, TimePoint now);
  void giveUpOldest();

  std::map<std::int64_t, Incomplete> incomplete_;  // by the picture's number
  std::map<std::int64_t, Incomplete> far_ahead_;   // at most one
  std::int64_t last_settled_ = -1;                 // the newest good picture
  std::uint64_t lost_ = 0;
  std::uint64_t repaired_ = 0;
  int given_up_in_a_row_ = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_PICTURE_ASSEMBLY_H
