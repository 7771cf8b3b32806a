/// @file version1_session.h
#ifndef AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
#define AIBO_DRIVER_CLIENT_VERSION1_SESSION_H

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "aibo_client/parts.h"
#include "client/connection.h"
#include "client/reply_parser.h"
#include "client/session.h"
#include "client/version1_requests.h"
#include "protocol/version1.h"

namespace aibo_client {

/// A session with a version 1 server.
///
/// At most one request is unanswered at any time. Replies have no numbers, so the client could not tell which request a
/// reply belongs to. Moreover, TCP may join two requests, and the server may take them for another request: two
/// requests to read a joint have the same bytes as one that moves it. If a request is not answered, the connection
/// ends, because its answer could still come.
class Version1Session final : public Session {
 public:
  using TimePoint = Session::TimePoint;

  /// The time between two requests for values. A request and its answer are six bytes in two packets. That makes 80
  /// small packets a second, beside about 120 full packets for 30 pictures. On a wireless link of 11 Mbit/s a small
  /// packet takes about 0.75 ms, so the requests take 6 % of the link's time.
  static constexpr std::chrono::milliseconds kPollPeriod{25};
  /// Commands are sent before a request for a value that is due, but they delay it for this long at most.
  static constexpr std::chrono::milliseconds kLongestPollWait{250};

  /// @param answer not kVersion2
  Version1Session(Connection& connection, VersionAnswer answer, TimePoint connected);

  int protocolVersion() const override { return 1; }
  bool ready() const override { return ready_; }
  Bytes nextRequest(const Settings& wanted, TimePoint now) override;
  void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) override;
  bool datagramArrived(const std::uint8_t*, std::size_t, TimePoint) override { return false; }  // it has none
  Bytes takeReply(TimePoint) override { return {}; }
  void checkDeadlines(TimePoint now) override;
  TimePoint nextDeadline() const override;

 private:
  /// A value to ask for. Such a server sends values only when it is asked.
  struct PolledValue {
    char letter;  ///< of the request
    int id;
  };

  /// A request whose answer is a value.
  struct ValueRequest {
    char letter = 0;
    int id = 0;
    bool set = false;  ///< true: set the value; false: read it
    TimePoint sent;
    std::uint64_t order = 0;  ///< OrderTerms::number
  };

  // The call that was sent and has not been answered, or null. pendingPicture() returns only calls for a picture.
  Call* pendingCall() const { return connection_.calls.find(kPendingNumber); }
  Call* pendingPicture() const;
  bool isAnswerPending() const { return pending_value_ || is_trial_pending_ || pendingCall() != nullptr; }
  Bytes requestTrial(const Settings& wanted, TimePoint now);
  bool mayRequestPicture(TimePoint now) const;
  bool mayPoll() const { return poll_wanted_ && !polled_.empty(); }
  Bytes requestPicture(const Settings& wanted, Call* call, TimePoint now);
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
  void endJointOrders();
  void onValue(const protocol::ValueReply& reply);
  void onError(int code);
  void onValueRefused(int code);

  bool isPictureDue() const;
  TimePoint silenceLimit() const;
  TimePoint valueDeadline() const;
  void checkCalls(TimePoint now);

  static constexpr int kPendingNumber = 1;  // the request number of the call that was sent and has not been answered

  Connection& connection_;
  ReplyParser parser_;
  TimePoint now_;  // when the bytes that are being parsed were read
  std::optional<ValueRequest> pending_value_;
  bool is_version_answer_pending_;
  /// Commands to joints of which at least one target was sent, by OrderTerms::number: why the robot has refused a
  /// target; empty if it has not.
  std::map<std::uint64_t, std::string> joint_orders_;
  int last_target_ = 0;             // the id of the joint that was commanded last
  bool joints_turn_ = true;         // true: joints are next; false: waiting LEDs and ears are next
  std::deque<PolledValue> polled_;  // the values to ask for; the next one is first
  TimePoint poll_due_;
  std::set<int> measured_joints_;  // joints that were polled successfully and have had no fault since
  bool poll_wanted_ = false;
  bool ready_;                     // the server has answered
  bool is_trial_pending_ = false;  // the picture of requestTrial() is still to come
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION1_SESSION_H
