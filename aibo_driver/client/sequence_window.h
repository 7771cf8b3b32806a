/// @file sequence_window.h
#ifndef AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H
#define AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H

#include <bitset>
#include <cstdint>
#include <utility>

namespace aibo_driver {

/// Tells from the numbers of datagrams which are lost, late or there twice. A datagram counts as lost when kSize later
/// ones could have come and it has not.
class SequenceWindow {
 public:
  static constexpr std::int64_t kSize = 64;
  /// A number further ahead than this is impossible. At 31 pictures a second of 4 datagrams each, it would be nine
  /// minutes ahead.
  static constexpr std::int64_t kFarthest = 65536;

  /// A jump by more than kSize is believed when a second datagram, not far behind the first, says the same: anybody who
  /// can send in the robot's name could make all that follow look late otherwise.
  enum class Verdict { kNext, kReordered, kDuplicate, kUnbelieved, kImpossible };

  /// A datagram has come.
  /// @param sequence its number; the first one that was sent has 0
  Verdict add(std::uint32_t sequence) {
    const std::int64_t ahead = sequence - highest_;
    if (ahead > kFarthest) {
      return Verdict::kImpossible;
    }
    if (ahead > kSize && !isConfirmed(sequence)) {
      return Verdict::kUnbelieved;
    }
    if (ahead > 0) {
      moveOn(sequence - highest_);
      return Verdict::kNext;
    }
    if (-ahead >= kSize) {
      return Verdict::kReordered;  // it counts as lost already
    }
    const auto bit = static_cast<std::size_t>(-ahead);
    if (seen_[bit]) {
      return Verdict::kDuplicate;
    }
    seen_[bit] = true;
    return Verdict::kReordered;
  }

  /// The number of the next datagram, if none is lost.
  std::int64_t next() const { return highest_ + 1; }

  /// How many have been lost.
  std::uint64_t lost() const { return lost_; }

 private:
  // The first one of a jump counts as come.
  bool isConfirmed(std::int64_t sequence) {
    const std::int64_t first = std::exchange(jump_, sequence);
    if (first <= highest_ || sequence <= first || sequence > first + kSize) {
      return false;
    }
    moveOn(first - highest_);
    return true;
  }

  // Those that leave the window without having been seen are lost.
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
  std::int64_t jump_ = -1;                                // the last one that was not believed
  std::bitset<kSize> seen_ = std::bitset<kSize>().set();  // bit i: highest_ - i; those before the first are not missed
  std::uint64_t lost_ = 0;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_SEQUENCE_WINDOW_H
