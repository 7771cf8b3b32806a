/// @file version1_session.h
#ifndef AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
#define AIBO_DRIVER_CLIENT_VERSION1_SESSION_H

#include <map>
#include <optional>
#include <set>
#include <string>

#include "aibo_client/leds.h"
#include "client/connection.h"
#include "client/reply_parser.h"
#include "client/session.h"
#include "client/value_poll.h"
#include "protocol/version1.h"

namespace aibo_client {

/// What is remembered of a version 1 server from one connection to the next.
struct ServerHabits {
  /// After this many unanswered polls in a row for joints, or for sensors, from a server that does send other things,
  /// it is not asked for them any more.
  static constexpr int kUnansweredPollsLimit = 3;

  std::map<char, int> unanswered_polls;  ///< in a row, by the request's letter; each has cost a connection
};

/// A session with a version 1 server.
///
/// At most one request is unanswered at any time. Replies have no numbers, so nothing would say which request a reply
/// belongs to; and two requests that TCP joins may be taken for another one: the bytes of two requests to read a joint
/// are those of one that moves it. For the same reason a request without an answer ends the connection.
class Version1Session final : public Session {
 public:
  using TimePoint = Session::TimePoint;
  /// What has become of the question for version 2 of the protocol.
  enum class VersionAnswer { kNotAsked, kRefused, kOwed };

  Version1Session(Connection& connection, ServerHabits& habits, VersionAnswer answer, TimePoint connected);

  int protocolVersion() const override { return 1; }
  bool ready() const override { return ready_; }
  void add(Call call) override;
  Bytes nextRequest(const Wish& wish, TimePoint now) override;
  void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) override;
  std::vector<Bytes> datagramArrived(const std::uint8_t*, std::size_t, TimePoint) override {
    return {};
  }  // none was asked for
  void checkDeadlines(TimePoint now) override;
  TimePoint nextDeadline() const override;

 private:
  /// A request whose answer is a value.
  struct ValueRequest {
    char letter = 0;
    int id = 0;
    bool set = false;  ///< else it reads
    TimePoint sent;
    std::uint64_t order = 0;  ///< OrderTerms::number
  };

  // The call that has been sent and not been answered, of any kind or for a picture; null if there is none:
  Call* owedCall() const { return connection_.calls.find(kOwed); }
  Call* owedPicture() const;
  bool isAnswerOwed() const { return value_owed_ || is_trial_owed_ || owedCall() != nullptr; }
  Bytes requestTrial(const Wish& wish, TimePoint now);
  bool mayRequestPicture(TimePoint now) const;
  bool mayPoll() const;
  Bytes requestPicture(const Wish& wish, Call* call, TimePoint now);
  Bytes requestCall(Call* call, TimePoint now);
  Bytes nextValueRequest(TimePoint now);
  Bytes nextCommand(TimePoint now);
  Bytes nextJointCommand(TimePoint now);
  Bytes nextLedOrEarCommand(TimePoint now);
  Bytes setValue(char letter, int id, short value, TimePoint now);

  void onPicture();
  void onValueReply();
  void onAnswer(const protocol::ValueReply& reply);
  void onCallAnswered();
  void onLedsAccepted(const protocol::ValueReply& reply);
  void onValue(const protocol::ValueReply& reply);
  void onError(int code);
  void onValueRefused(int code);

  bool isPictureDue() const;
  TimePoint silenceLimit() const;
  TimePoint valueDeadline() const;
  void checkCalls(TimePoint now);
  void failUnanswered();

  static constexpr int kOwed = 1;  // request number of the call that has been sent and not been answered

  Connection& connection_;
  ServerHabits& habits_;
  ReplyParser parser_;
  TimePoint now_;  // when the bytes were read that are being taken apart
  std::optional<ValueRequest> value_owed_;
  bool version_answer_owed_;
  int last_target_ = 0;             // id of the joint that was commanded last
  LedMode led_mode_ = LedMode::kA;  // of all LEDs, as last accepted
  bool joints_turn_ = true;         // else it is the turn of LEDs and ears, if any wait
  ValuePoll poll_;
  std::set<int> measured_joints_;  // polled successfully, with no fault since
  bool poll_wanted_ = false;
  bool ready_;                  // the server has answered
  bool is_trial_owed_ = false;  // the picture of requestTrial()
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
