/// @file faults.h
/// What a FaultProxy can do to a connection.
#ifndef TEST_SUPPORT_PROXY_FAULTS_H
#define TEST_SUPPORT_PROXY_FAULTS_H

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "support/sockets.h"

namespace test_support {

enum class Direction { kToClient, kToServer };

/// A single fault in the bytes of one direction.
enum class Action {
  kClose,      ///< the connection is closed for both sides (FIN)
  kReset,      ///< it is reset for both sides (RST)
  kHalfClose,  ///< it is closed for the receiver (FIN), and the other direction goes on
  kSilence,    ///< it stays open, but no more bytes get through in either direction
  kDrop,       ///< as many bytes are lost as `bytes` has
  kInsert,     ///< `bytes` are inserted
  kFlip,       ///< the next byte is combined with the first of `bytes` by exclusive or
  kPause       ///< the next bytes are delayed by `time`
};

/// Where a fault takes place.
enum class Place {
  kByte,    ///< before the connection's byte number `offset`, or before the next one if that has passed
  kPicture  ///< before byte number `offset` of a picture, counted from its header; only on the way to the client
};

struct Fault {
  Action action = Action::kClose;
  Place place = Place::kByte;
  std::uint64_t offset = 0;
  Direction direction = Direction::kToClient;
  Bytes bytes{};
  std::chrono::microseconds time{0};
};

/// Lasting properties of the way, in both directions. The defaults are those of a perfect one.
struct Conditions {
  std::chrono::microseconds delay{0};   ///< of all bytes
  std::chrono::microseconds jitter{0};  ///< largest random addition to the delay
  std::size_t bytes_per_second = 0;     ///< 0 = no limit
  std::size_t largest_piece = 0;        ///< bytes come in pieces of random sizes, 1 to this; 0 = as they were sent
  bool paused = false;                  ///< nothing gets through from the server, so that its window closes
};

/// What happens to a client that connects.
enum class Welcome {
  kServe,    ///< it is connected to the server
  kReset,    ///< it is accepted, and the connection is reset at once
  kSilence,  ///< it is accepted, and then hears nothing (a black hole)
  kRefuse    ///< it is refused, because nobody listens
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_FAULTS_H
