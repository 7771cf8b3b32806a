/// @file pipe.h
#ifndef TEST_SUPPORT_PROXY_PIPE_H
#define TEST_SUPPORT_PROXY_PIPE_H

#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <utility>

#include "support/proxy/fault.h"
#include "support/proxy/scanners.h"

namespace test_support {

/// A fault that has taken place.
struct FaultReport {
  Fault fault;
  std::size_t connection = 0;  ///< the first is 0
  std::uint64_t offset = 0;    ///< before this byte of the connection, as it was sent
  TimePoint time;              ///< when this byte arrived at the proxy
};

/// Faults that have not taken place yet, in their order.
class FaultQueue {
 public:
  void add(const Fault& fault) { faults_.push_back(fault); }
  void clear() {
    ++turn_;
    faults_.clear();
  }
  bool empty() const { return faults_.empty(); }
  const Fault& front() const { return faults_.front(); }
  Fault take() {
    ++turn_;
    Fault fault = std::move(faults_.front());
    faults_.pop_front();
    return fault;
  }
  /// Changes whenever another fault comes to the front.
  std::uint64_t turn() const { return turn_; }

 private:
  std::deque<Fault> faults_;
  std::uint64_t turn_ = 0;
};

/// One direction of a connection: turns the bytes that were sent into the pieces that arrive, each with its time. Does
/// no I/O and reads no clock.
class Pipe {
 public:
  /// Bytes to send at a certain time; or, with `end`, what to do then.
  struct Piece {
    Bytes bytes;
    TimePoint due;
    std::optional<Action> end;  ///< kClose, kReset, kHalfClose or kSilence
  };

  Pipe(Direction direction, unsigned seed) : direction_(direction), random_(seed) {}

  /// Takes the next bytes of the stream.
  /// @param faults faults that take place are removed
  /// @return the faults that took place
  std::vector<FaultReport> take(const std::uint8_t* data, std::size_t size, TimePoint now, const Conditions& conditions,
                                FaultQueue* faults);

  /// Ends the stream after the pieces so far.
  void end(Action end, TimePoint now);

  /// The pieces in their order. The sender removes what it has sent.
  std::deque<Piece>& pieces() { return pieces_; }
  const std::deque<Piece>& pieces() const { return pieces_; }

  /// True if no more bytes should be taken for now.
  bool isFull(const Conditions& conditions) const;

  /// Reports that bytes have been sent.
  void sent(std::size_t size) { waiting_ -= size; }

 private:
  bool findPlace(const FaultQueue& faults, const std::vector<std::uint64_t>& picture_begins);
  void carryOut(const Fault& fault, TimePoint now);
  void pass(const std::uint8_t* data, std::size_t size, TimePoint now, const Conditions& conditions);
  void addPiece(Bytes bytes, TimePoint now, const Conditions& conditions);
  TimePoint dueTime(std::size_t size, TimePoint now, const Conditions& conditions);
  std::size_t pieceSize(const Conditions& conditions);

  const Direction direction_;
  std::minstd_rand random_;
  ReplyScanner scanner_;
  std::deque<Piece> pieces_;
  std::size_t waiting_ = 0;                // bytes in pieces_
  std::uint64_t offset_ = 0;               // of the next byte of the stream
  std::optional<std::uint64_t> fault_at_;  // where the next fault takes place, if known
  std::uint64_t fault_turn_ = 0;           // of the fault at fault_at_
  std::size_t drop_ = 0;                   // bytes still to drop
  std::deque<std::uint8_t> masks_;         // for the bytes still to flip
  TimePoint not_before_;                   // the earliest arrival of the next piece
  bool split_ = false;                     // the next bytes begin a new piece
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_PIPE_H
