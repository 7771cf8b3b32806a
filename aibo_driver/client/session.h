/// @file session.h
#ifndef AIBO_DRIVER_CLIENT_SESSION_H
#define AIBO_DRIVER_CLIENT_SESSION_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/counters.h"
#include "client/notifier.h"
#include "client/picture_requests.h"
#include "client/reply_parser.h"
#include "client/stall_detector.h"
#include "client/stream_control.h"
#include "protocol/version1.h"

namespace aibo_driver {

/// What the user wants of the stream, connected or not.
struct StreamWish {
  bool streaming = false;
  int jpeg_quality = 0;  ///< 1..100
};

/// One connection to a version 1 server, from its beginning to its end: what to send, what to make of what arrives, and
/// when to give up. It does no I/O and reads no clock: bytes and times are handed in. Used by one thread.
class Session final : private ReplyHandler {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param address of the server, for messages
  /// @param read_timeout a server that owes a picture and is silent for so long is given up
  Session(std::string address, std::chrono::milliseconds read_timeout, const Notifier& notifier, Counters& counters,
          TimePoint connected);

  /// Takes over a call of takePicture().
  void add(PictureRequest request, TimePoint now);

  /// Ends all calls of takePicture().
  void failRequests(PictureAnswer::Outcome outcome, const std::string& problem) { requests_.failAll(outcome, problem); }

  /// The command to send now, if any; taken for sent. Asked for whenever anything may have changed.
  std::optional<protocol::BasicGetCommand> nextCommand(const StreamWish& wish, TimePoint now);

  /// Bytes were read at this time.
  /// @throw Fault the peer has broken the protocol
  void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now);

  /// Nothing was left to read at this time.
  void foundEmpty(TimePoint now) { stall_detector_.foundEmpty(now); }

  /// To be called when nextDeadline() has passed and what had arrived until then has been handed in.
  /// @throw Fault a picture was due and did not come
  void checkDeadlines(TimePoint now);

  /// When to call foundEmpty() or bytesArrived(), checkDeadlines() and nextCommand() again at the latest.
  TimePoint nextDeadline() const;

  /// True while the server has been told to stream.
  bool streaming() const { return stream_.on(); }

  /// True once the connection is known to work: it has delivered, or it stands for a while with nothing due.
  bool settled() const { return settled_; }

  /// True if the server has never sent anything.
  bool silentSoFar() const { return !heard_; }

 private:
  void onPicture(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time) override;
  void onValueReply(const protocol::ValueReply& reply) override;
  void onDamagedPicture(const std::string& problem);
  void deliver(const PicturePtr& picture);
  bool pictureDue() const;
  TimePoint silenceLimit() const;
  bool mayRequestPicture(TimePoint now) const;

  const std::string address_;
  const std::chrono::milliseconds read_timeout_;
  const Notifier& notifier_;
  Counters& counters_;
  const TimePoint connected_;

  ReplyParser parser_;
  StreamControl stream_;
  StallDetector stall_detector_;
  PictureRequests requests_;
  bool picture_owed_ = false;  // `F` has been sent for the first request and not been answered
  TimePoint last_sign_;        // when the server last sent something, or was last asked for pictures
  TimePoint now_;              // of the bytes that are being parsed
  bool heard_ = false;
  bool settled_ = false;
  std::string last_damage_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_SESSION_H
