/// @file version1_session.h
#ifndef AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
#define AIBO_DRIVER_CLIENT_VERSION1_SESSION_H

#include <map>
#include <optional>
#include <string>

#include "client/numbered_calls.h"
#include "client/reply_parser.h"
#include "client/session.h"
#include "client/value_poll.h"
#include "protocol/version1.h"

namespace aibo_driver {

/// What is known of a version 1 server beyond one connection.
struct ServerHabits {
  /// A server that is this often in a row asked for a joint, or for a sensor, and does not answer, although it has sent
  /// something else, is not asked for any more.
  static constexpr int kUnansweredPollsLimit = 3;

  std::map<char, int> unanswered_polls;  ///< in a row, by the request's letter; each has cost a connection
};

/// A session with a version 1 server.
///
/// There is never more than one request that the server has not answered. Replies have no numbers, so nobody could tell
/// whose they are; and two requests that TCP joins may be taken for another one: the bytes of two requests to read a
/// joint are those of one that moves it. For the same reason a request without an answer ends the connection.
class Version1Session final : public Session, private ReplyHandler {
 public:
  using TimePoint = Session::TimePoint;
  /// What has become of the question for version 2 of the protocol.
  enum class VersionAnswer { kNotAsked, kRefused, kOwed };

  Version1Session(const SessionContext& context, ServerHabits& habits, VersionAnswer answer, TimePoint connected);

  using Session::add;
  void add(PictureRequest request, TimePoint now) override;
  void add(RobotRequest request) override;
  void failRequests(CallOutcome outcome, const std::string& problem) override;
  Bytes nextRequest(const Wish& wish, TimePoint now) override;
  void checkDeadlines(TimePoint now) override;
  TimePoint nextDeadline() const override;
  int protocolVersion() const override { return 1; }
  bool ready() const override { return true; }
  bool settled() const override { return settled_; }

 private:
  /// A request whose answer is a value.
  struct ValueRequest {
    char letter = 0;
    int id = 0;
    bool set = false;  ///< else it reads
    TimePoint sent;
  };

  void parse(const std::uint8_t* data, std::size_t size) override;
  void onPicture(Bytes jpeg, TimePoint first_byte_time) override;
  void deliver(const PicturePtr& picture);
  void onValueReply(const protocol::ValueReply& reply, TimePoint first_byte_time) override;
  void onAnswer(const protocol::ValueReply& reply, TimePoint first_byte_time);
  void onCallAnswered();
  void onValue(const protocol::ValueReply& reply, TimePoint first_byte_time);
  void onError(int code);
  void onCallRefused(int code);
  void onValueRefused(const std::string& code);

  bool mayRequestPicture(TimePoint now) const;
  bool mayPoll() const;
  bool isAnswerOwed() const { return picture_owed_ || value_owed_ || calls_.has(kCallOwed); }
  Bytes nextCall(const RobotRequest& call, TimePoint now);
  Bytes nextValueRequest(TimePoint now);
  Bytes nextCommand(TimePoint now);
  Bytes nextJointCommand(TimePoint now);
  Bytes nextLedOrEarCommand(TimePoint now);
  Bytes setValue(char letter, int id, short value, TimePoint now);

  bool pictureDue() const;
  TimePoint silenceLimit() const;
  TimePoint valueDeadline() const;
  void checkCall(TimePoint now);
  void failUnanswered();

  ServerHabits& habits_;
  const TimePoint connected_;
  bool heard_;  // the server has sent something
  ReplyParser parser_;
  PictureRequests requests_;
  bool picture_owed_ = false;  // `F` has been sent for the first request and not been answered
  std::optional<ValueRequest> value_owed_;
  static constexpr int kCallOwed = 1;  // the number of the call that has been sent and not been answered
  NumberedCalls<RobotRequest> calls_;
  bool version_answer_owed_;
  int last_target_ = 0;      // id of the joint that was sent somewhere last
  bool joints_turn_ = true;  // else that of LEDs and ears, if any wait
  ValuePoll poll_;
  bool poll_wanted_ = false;
  bool settled_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
