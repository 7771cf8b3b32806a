/// @file fault.h
/// What can go wrong on the way between a client and a server.
#ifndef TEST_SUPPORT_PROXY_FAULT_H
#define TEST_SUPPORT_PROXY_FAULT_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace test_support {

using Bytes = std::vector<std::uint8_t>;
using TimePoint = std::chrono::steady_clock::time_point;

enum class Direction { kToClient, kToServer };

/// What goes wrong once, amid the bytes of one direction.
enum class Action {
  kClose,      ///< the connection ends orderly, for both sides
  kReset,      ///< it ends abruptly, for both sides
  kHalfClose,  ///< no more bytes in this direction, and the receiver is told (FIN); the other direction goes on
  kSilence,    ///< no more bytes in either direction, and nobody is told
  kDrop,       ///< `count` bytes are lost
  kInsert,     ///< `bytes` come in between
  kOverwrite,  ///< `bytes` take the place of as many others
  kFlip,       ///< the next bytes are combined with `bytes`, by exclusive or
  kPause,      ///< the next bytes come later by `time`
  kSplit       ///< what was sent as one comes as two, the second by `time` later
};

/// Where it goes wrong.
enum class Place {
  kHere,     ///< where the stream is now
  kByte,     ///< before the connection's byte number `offset`
  kPicture,  ///< before byte number `offset` of the next picture, counted from its header; only towards the client
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

/// What the way is like all the time, in both directions. As it stands: as good as it can be.
struct Conditions {
  std::chrono::microseconds delay{0};
  std::chrono::microseconds jitter{0};     ///< up to so much is added to the delay; the order of the bytes stays
  std::size_t bytes_per_second = 0;        ///< 0 = no limit
  std::size_t largest_piece = 0;           ///< bytes come in pieces of at most so many; 0 = as they were sent
  bool random_pieces = false;              ///< pieces of 1..largest_piece bytes instead
  std::chrono::microseconds piece_gap{0};  ///< from one piece to the next
  std::chrono::microseconds join{0};       ///< what was sent within this time comes as one
  bool paused = false;                     ///< what the server sends is not read any more: its window closes
};

/// How a client is received.
enum class Welcome {
  kServe,       ///< it is connected with the server
  kClose,       ///< accepted, and the connection closed at once
  kReset,       ///< accepted, and the connection reset at once
  kSilence,     ///< accepted, and then nothing (a black hole)
  kRefuse,      ///< nobody listens
  kUnreachable  ///< the attempt to connect gets no answer at all
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_FAULT_H
