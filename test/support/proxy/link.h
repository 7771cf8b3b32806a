/// @file link.h
#ifndef TEST_SUPPORT_PROXY_LINK_H
#define TEST_SUPPORT_PROXY_LINK_H

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/scanners.h"
#include "support/sockets.h"

namespace test_support {

enum class Direction { kToClient, kToServer };

/// A single fault in the bytes of one direction.
enum class Action {
  kClose,      ///< the connection is closed for both sides (FIN)
  kReset,      ///< it is reset for both sides (RST)
  kHalfClose,  ///< it is closed for the receiver (FIN), and the other direction goes on
  kSilence,    ///< it stays open, but no more bytes get through in either direction
  kDrop,       ///< `count` bytes are lost
  kInsert,     ///< `bytes` are inserted
  kOverwrite,  ///< `bytes` replace as many others
  kFlip,       ///< the next bytes are combined with `bytes` by exclusive or
  kPause,      ///< the next bytes are delayed by `time`
  kSplit       ///< one piece becomes two, the second delayed by `time`
};

/// Where a fault takes place.
enum class Place {
  kHere,     ///< at the next byte
  kByte,     ///< before the connection's byte number `offset`
  kPicture,  ///< before byte number `offset` of the next picture, counted from its header; only on the way to the
             ///< client
};

struct Fault {
  Action action = Action::kClose;
  Place place = Place::kHere;
  std::uint64_t offset = 0;
  Direction direction = Direction::kToClient;
  std::size_t count = 0;
  Bytes bytes{};
  std::chrono::microseconds time{0};
};

/// Lasting properties of the way, in both directions. The defaults are those of a perfect one.
struct Conditions {
  std::chrono::microseconds delay{0};
  std::chrono::microseconds jitter{0};  ///< largest random addition to the delay; bytes stay in order
  std::size_t bytes_per_second = 0;     ///< 0 = no limit
  std::size_t largest_piece = 0;        ///< bytes come in pieces of random sizes, 1 to this; 0 = as they were sent
  std::chrono::microseconds join{0};    ///< bytes that are sent within this time come together
  bool paused = false;                  ///< the proxy does not read from the server, so that its window closes
};

/// What happens to a client that connects.
enum class Welcome {
  kServe,    ///< it is connected to the server
  kReset,    ///< it is accepted, and the connection is reset at once
  kSilence,  ///< it is accepted, and then hears nothing (a black hole)
  kRefuse    ///< it is refused, because nobody listens
};

/// Faults that have not taken place yet, in their order.
struct FaultQueue {
  std::deque<Fault> faults{};
  std::uint64_t turn = 0;  ///< changes whenever another fault comes to the front
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
                   FaultQueue* faults) {
    const std::vector<std::uint64_t> begins =
        direction_ == Direction::kToClient ? scanner_.feed(data, size) : std::vector<std::uint64_t>();
    std::size_t done = 0;
    const std::uint64_t end = offset_ + size;
    for (; findPlace(*faults, begins) && *fault_at_ < end; ++done) {
      const std::size_t before = static_cast<std::size_t>(*fault_at_ - offset_);
      pass(data, before, now, conditions);
      data += before;
      carryOut(faults->faults.front(), now);
      faults->faults.pop_front();
      ++faults->turn;
    }
    pass(data, static_cast<std::size_t>(end - offset_), now, conditions);
    return done;
  }

  /// Ends the stream after the pieces so far.
  void end(Action end, TimePoint now) { pieces_.push_back({{}, std::max(now, not_before_), end}); }

  /// The pieces in their order. The sender removes what it has sent.
  std::deque<Piece>& pieces() { return pieces_; }
  const std::deque<Piece>& pieces() const { return pieces_; }

  /// True if no more bytes should be taken for now.
  // A slow way holds little, or bytes would wait in it for seconds. A way with a delay holds all bytes under way.
  bool isFull(const Conditions& conditions) const {
    const bool slow = conditions.largest_piece > 0 || conditions.bytes_per_second > 0;
    return waiting_ > (slow ? 4 : 64) * std::size_t{1024};
  }

  /// Reports that bytes have been sent.
  void sent(std::size_t size) { waiting_ -= size; }

 private:
  /// Finds out where the next fault takes place.
  /// @return false if that is not known yet
  bool findPlace(const FaultQueue& queue, const std::vector<std::uint64_t>& picture_begins) {
    if (queue.faults.empty() || queue.faults.front().direction != direction_) {
      return false;
    }
    if (std::exchange(fault_turn_, queue.turn) != queue.turn) {
      fault_at_.reset();
    }
    const Fault& fault = queue.faults.front();
    if (!fault_at_ && fault.place == Place::kPicture) {
      const auto begin = std::lower_bound(picture_begins.begin(), picture_begins.end(), offset_);
      if (begin != picture_begins.end()) {
        fault_at_ = *begin + fault.offset;
      }
    } else if (!fault_at_) {
      fault_at_ = std::max(offset_, fault.place == Place::kByte ? fault.offset : 0);
    }
    return fault_at_.has_value();
  }

  void carryOut(const Fault& fault, TimePoint now) {
    switch (fault.action) {
      case Action::kDrop:
        drop_ += fault.count;
        break;
      case Action::kOverwrite:
        drop_ += fault.bytes.size();
        addPiece(fault.bytes, now, Conditions());
        break;
      case Action::kInsert:
        addPiece(fault.bytes, now, Conditions());
        break;
      case Action::kFlip:
        masks_.assign(fault.bytes.begin(), fault.bytes.end());
        break;
      case Action::kPause:
      case Action::kSplit:
        not_before_ = std::max(not_before_, now) + fault.time;
        split_ = true;
        break;
      default:
        end(fault.action, now);
    }
  }

  void pass(const std::uint8_t* data, std::size_t size, TimePoint now, const Conditions& conditions) {
    offset_ += size;
    const std::size_t dropped = std::min(drop_, size);
    drop_ -= dropped;
    Bytes bytes(data + dropped, data + size);
    for (std::size_t i = 0; i < bytes.size() && !masks_.empty(); ++i) {
      bytes[i] ^= masks_.front();
      masks_.pop_front();
    }
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t part = std::min(pieceSize(conditions), bytes.size() - begin);
      const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(begin);
      addPiece(Bytes(from, from + static_cast<std::ptrdiff_t>(part)), now, conditions);
      begin += part;
    }
  }

  void addPiece(Bytes bytes, TimePoint now, const Conditions& conditions) {
    const TimePoint due = dueTime(bytes.size(), now, conditions);
    waiting_ += bytes.size();
    const bool alone = conditions.join.count() == 0 || std::exchange(split_, false);
    if (!alone && !pieces_.empty() && !pieces_.back().end && pieces_.back().due == due) {
      pieces_.back().bytes.insert(pieces_.back().bytes.end(), bytes.begin(), bytes.end());
    } else {
      pieces_.push_back({std::move(bytes), due, std::nullopt});
    }
  }

  TimePoint dueTime(std::size_t size, TimePoint now, const Conditions& conditions) {
    using std::chrono::microseconds;
    TimePoint due = now + conditions.delay;
    if (conditions.jitter.count() > 0) {
      due += microseconds(std::uniform_int_distribution<microseconds::rep>(0, conditions.jitter.count())(random_));
    }
    if (conditions.join.count() > 0) {
      due += conditions.join - (due.time_since_epoch() % conditions.join);
    }
    due = std::max(due, not_before_);
    not_before_ = due;
    if (conditions.bytes_per_second > 0) {
      not_before_ += microseconds(size * 1000000 / conditions.bytes_per_second);
    }
    return due;
  }

  std::size_t pieceSize(const Conditions& conditions) {
    constexpr std::size_t kPacket = 1460;  // the unit to which a rate applies
    if (conditions.largest_piece == 0) {
      return conditions.bytes_per_second == 0 ? SIZE_MAX : kPacket;
    }
    return std::uniform_int_distribution<std::size_t>(1, conditions.largest_piece)(random_);
  }

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
  Link(std::size_t number, host_files::FileDescriptor client, host_files::FileDescriptor server)
      : number_(number),
        client_{std::move(client), Pipe(Direction::kToClient)},
        server_{std::move(server), Pipe(Direction::kToServer)} {}

  /// Adds the sockets to wait for.
  /// @return true if serve() has to be called soon, whatever happens
  bool prepare(const Conditions& conditions, std::vector<pollfd>* polled) const {
    const auto add = [&](const Side& side, const Side& other) {
      const bool reads = draining_ ? &side == &client_ : !connecting_ && mayRead(side, other, conditions);
      const int events = silent_ ? POLLRDHUP : reads ? POLLIN : 0;
      polled->push_back({events == 0 ? -1 : side.socket.get(), static_cast<short>(events), 0});
    };
    add(client_, server_);
    add(server_, client_);
    const bool has_pieces = !client_.out.pieces().empty() || !server_.out.pieces().empty();
    return connecting_ || (has_pieces && !draining_ && !silent_);
  }

  /// Does what can be done now.
  /// @return how many faults took place
  std::size_t serve(TimePoint now, const Conditions& conditions, FaultQueue* faults, const Tap& tap) {
    std::size_t done = 0;
    if (draining_) {
      std::array<std::uint8_t, 4096> ignored;
      const ssize_t count = ::recv(client_.socket.get(), ignored.data(), ignored.size(), 0);
      over_ = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
    } else if (silent_) {
      if (isReady(client_, POLLRDHUP)) {
        client_.socket.close();  // the server does not notice
      }
      over_ = isReady(server_, POLLRDHUP);
    } else if (connecting_) {
      int error = 0;
      socklen_t size = sizeof error;
      connecting_ = !isReady(server_, POLLOUT);
      ::getsockopt(server_.socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
      over_ = !connecting_ && error != 0;
    } else {
      done += receive(&server_, &client_, Direction::kToClient, now, conditions, faults, tap);
      done += receive(&client_, &server_, Direction::kToServer, now, conditions, faults, tap);
      const TimePoint sending = std::chrono::steady_clock::now();
      send(&client_, Direction::kToClient, sending);
      send(&server_, Direction::kToServer, sending);
    }
    return done;
  }

  /// Ends the connection now.
  /// @param end kClose, kReset, kHalfClose or kSilence
  void end(Action end, Direction direction) {
    Side& receiver = direction == Direction::kToClient ? client_ : server_;
    switch (end) {
      case Action::kClose:
        // A close() with unread bytes would be a reset. So the client gets a FIN first, and closes its side.
        ::shutdown(client_.socket.get(), SHUT_WR);
        server_.socket.close();
        draining_ = true;
        break;
      case Action::kHalfClose:
        ::shutdown(receiver.socket.get(), SHUT_WR);
        receiver.told = true;
        over_ = client_.told && server_.told;
        break;
      case Action::kSilence:
        silent_ = true;
        break;
      default:
        resetWhenClosed(client_.socket);
        resetWhenClosed(server_.socket);
        over_ = true;
    }
  }

  /// True when the connection has ended.
  bool isOver() const { return over_; }
  bool isSilent() const { return silent_; }

 private:
  struct Side {
    host_files::FileDescriptor socket;
    Pipe out;            // towards this side
    bool ended = false;  // this side sends no more
    bool told = false;   // this side has got a FIN
  };

  static bool isReady(const Side& side, short events) {
    pollfd polled = {side.socket.get(), events, 0};
    return ::poll(&polled, 1, 0) > 0;
  }

  bool mayRead(const Side& from, const Side& to, const Conditions& conditions) const {
    const bool paused = conditions.paused && &from == &server_;
    return !from.ended && !to.out.isFull(conditions) && !paused;
  }

  std::size_t receive(Side* from, Side* to, Direction direction, TimePoint now, const Conditions& conditions,
                      FaultQueue* faults, const Tap& tap) {
    if (over_ || !mayRead(*from, *to, conditions)) {
      return 0;
    }
    std::array<std::uint8_t, 4096> buffer;
    const ssize_t count = ::recv(from->socket.get(), buffer.data(), buffer.size(), 0);
    if (count > 0) {
      const auto size = static_cast<std::size_t>(count);
      if (tap) {
        tap(number_, direction, buffer.data(), size);
      }
      return to->out.take(buffer.data(), size, now, conditions, faults);
    }
    if (count == 0) {
      from->ended = true;
      to->out.end(Action::kHalfClose, now);
    } else if (errno != EAGAIN && errno != EINTR) {
      end(Action::kReset, direction);
    }
    return 0;
  }

  void send(Side* side, Direction direction, TimePoint now) {
    std::deque<Pipe::Piece>& pieces = side->out.pieces();
    while (!pieces.empty() && pieces.front().due <= now && !over_ && !draining_ && !silent_) {
      Pipe::Piece& piece = pieces.front();
      // What comes for a side that has got a FIN is lost.
      const ssize_t count = piece.end || side->told
                                ? static_cast<ssize_t>(piece.bytes.size())
                                : ::send(side->socket.get(), piece.bytes.data(), piece.bytes.size(), MSG_NOSIGNAL);
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
        return;
      }
      if (count < 0) {
        end(Action::kReset, direction);
        return;
      }
      side->out.sent(static_cast<std::size_t>(count));
      piece.bytes.erase(piece.bytes.begin(), piece.bytes.begin() + count);
      if (piece.bytes.empty()) {
        const std::optional<Action> action = piece.end;
        pieces.pop_front();
        if (action) {
          end(*action, direction);
        }
      }
    }
  }

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
