/// @file link.h
#ifndef TEST_SUPPORT_PROXY_LINK_H
#define TEST_SUPPORT_PROXY_LINK_H

#include <poll.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/fault.h"
#include "support/proxy/scanners.h"

namespace test_support {

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

  explicit Pipe(Direction direction) : direction_(direction) {}

  /// Takes the next bytes of the stream.
  /// @param faults faults that take place are removed
  /// @return how many faults took place
  std::size_t take(const std::uint8_t* data, std::size_t size, TimePoint now, const Conditions& conditions,
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

/// Called on the proxy's thread with what one side has sent, before it is passed on.
using Tap =
    std::function<void(std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size)>;

/// One connection through the proxy: two sockets, and a pipe in each direction. Never blocks. Only for the proxy's
/// thread.
class Link {
 public:
  /// @param server a socket that is connected, or being connected
  Link(std::size_t number, host_files::FileDescriptor client, host_files::FileDescriptor server);

  /// What to wait for: an entry for each socket, the client's first; -1 for a socket that need not be waited for.
  std::array<pollfd, 2> interests(TimePoint now, const Conditions& conditions);

  /// When serve() has to be called at the latest.
  TimePoint nextDue() const;

  /// Does what can be done now.
  /// @param polled the entries of interests(), after poll()
  /// @return how many faults took place
  std::size_t serve(const std::array<pollfd, 2>& polled, TimePoint now, const Conditions& conditions,
                    FaultQueue* faults, const Tap& tap);

  /// Ends the connection now.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void end(Action end, Direction direction);

  /// True when the connection has ended.
  bool isOver() const { return over_; }
  bool isSilent() const { return silent_; }

 private:
  struct Side {
    host_files::FileDescriptor socket;
    Pipe out;              // towards this side
    bool ended = false;    // this side sends no more
    bool told = false;     // this side has got a FIN
    bool blocked = false;  // the kernel's buffer for this side is full
  };

  bool mayRead(const Side& from, const Side& to, const Conditions& conditions) const;
  std::size_t receive(Side* from, Side* to, Direction direction, TimePoint now, const Conditions& conditions,
                      FaultQueue* faults, const Tap& tap);
  void send(Side* side, Direction direction, TimePoint now);
  bool sendFront(Side* side);

  const std::size_t number_;
  Side client_;
  Side server_;
  bool connecting_ = true;  // to the server
  bool draining_ = false;   // the client has got a FIN, and has yet to close
  bool silent_ = false;
  bool over_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_LINK_H
