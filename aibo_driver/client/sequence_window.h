/// @file sequence_window.h
#ifndef AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H
#define AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H

#include <bitset>
#include <cstdint>

namespace aibo_client {

/// Finds out which datagrams were lost, late or sent twice, from their numbers. A datagram counts as lost if it has not
/// come when kSize later ones could have come.
class SequenceWindow {
 public:
  static constexpr std::int64_t kSize = 64;
  /// How far ahead a number can be. At 31 pictures a second with 4 datagrams each, a number this far ahead would be
  /// sent nine minutes later.
  static constexpr std::int64_t kFarthest = 65536;

  enum class Verdict { kNext, kReordered, kDuplicate, kImpossible };

  /// Call this when a datagram has come.
  /// @param sequence the datagram's number; the first one that was sent has 0
  Verdict add(std::uint32_t sequence) {
    const std::int64_t ahead = sequence - highest_;
    if (ahead > kFarthest) {
      return Verdict::kImpossible;
    }
    if (ahead > 0) {
      moveOn(ahead);
      return Verdict::kNext;
    }
    if (-ahead >= kSize) {
      return Verdict::kReordered;  // it already counts as lost
    }
    const auto bit = static_cast<std::size_t>(-ahead);
    if (seen_[bit]) {
      return Verdict::kDuplicate;
    }
    seen_[bit] = true;
    return Verdict::kReordered;
  }

  /// The number of the next datagram if none is lost.
  std::int64_t next() const { return highest_ + 1; }

  /// How many datagrams have been lost.
  std::uint64_t lost() const { return lost_; }

 private:
  // Datagrams that leave the window without having been seen are lost.
  void moveOn(std::int64_t ahead) {
    if (ahead >= kSize) {
      lost_ += static_cast<std::uint64_t>(kSize) - seen_.count() + static_cast<std::uint64_t>(ahead - kSize);
      seen_.reset();
    } else {
      const std::bitset<kSize> leaving = seen_ >> static_cast<std::size_t>(kSize - ahead);
      lost_ += static_cast<std::uint64_t>(ahead) - leaving.count();
      seen_ <<= static_cast<std::size_t>(ahead);
    }
    highest_ += ahead;
    seen_[0] = true;
  }

  std::int64_t highest_ = -1;
  // Bit i is the datagram highest_ - i. Datagrams before the first one count as seen.
  std::bitset<kSize> seen_ = std::bitset<kSize>().set();
  std::uint64_t lost_ = 0;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H
