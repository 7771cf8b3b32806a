/// @file session.h
#ifndef AIBO_DRIVER_CLIENT_SESSION_H
#define AIBO_DRIVER_CLIENT_SESSION_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "aibo_driver/robot_info.h"
#include "client/commands.h"
#include "client/counters.h"
#include "client/notifier.h"
#include "client/picture_requests.h"
#include "client/call.h"
#include "client/stall_detector.h"
#include "client/picture_intake.h"

namespace aibo_driver {

/// What the user wants all the time, connected or not.
struct Wish {
  bool streaming = false;
  int jpeg_quality = 0;      ///< 1..100, of the stream
  int telemetry_period = 0;  ///< OPEN-R frames of 8 ms; 0 = no telemetry
};

/// What sessions need to know of the client they belong to.
struct SessionContext {
  std::string address;                     ///< of the server, for messages
  std::chrono::milliseconds read_timeout;  ///< a server that owes a picture and is silent for so long is given up
  const Notifier& notifier;
  Counters& counters;
  std::uint64_t connection_number = 0;  ///< 1 for the client's first
};

/// One connection to a server, from the moment the version of the protocol is clear to its end: what to send, what to
/// make of what arrives, and when to give up. It does no I/O and reads no clock: bytes and times are handed in. Used by
/// one thread.
class Session {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes over a call of takePicture().
  virtual void add(PictureRequest request, TimePoint now) = 0;

  /// Takes over a call that has the robot do something.
  virtual void add(RobotRequest request) = 0;

  /// Takes over commands to the body.
  void add(const Commands& commands, TimePoint now) { commands_.append(commands, now); }

  /// Ends all calls that are waiting.
  virtual void failRequests(CallOutcome outcome, const std::string& problem) = 0;

  /// The request to send now, taken for sent; empty if there is none. To be asked for until there is none, whenever
  /// anything may have changed. A request is to be sent by one call: some servers tell requests apart by how many bytes
  /// come at once.
  virtual Bytes nextRequest(const Wish& wish, TimePoint now) = 0;

  /// Bytes were read at this time.
  /// @throw Fault the peer has broken the protocol
  void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now);

  /// Nothing was left to read at this time.
  void foundEmpty(TimePoint now) { stall_detector_.foundEmpty(now); }

  /// To be called when nextDeadline() has passed and what had arrived until then has been handed in.
  /// @throw Fault something was due and did not come
  virtual void checkDeadlines(TimePoint now) = 0;

  /// When to call foundEmpty() or bytesArrived(), checkDeadlines() and nextRequest() again at the latest.
  virtual TimePoint nextDeadline() const = 0;

  /// True while the server has been told to stream.
  bool streaming() const { return stream_.on(); }

  /// True once requests can be made, and robot() is known.
  virtual bool ready() const = 0;

  /// True once the connection is known to work: it has delivered, or it stands for a while with nothing due.
  virtual bool settled() const = 0;

  virtual int protocolVersion() const = 0;

  /// Who is there.
  const RobotInfo& robot() const { return robot_; }

  /// What the robot has last reported by itself; empty if nothing.
  const std::string& robotMessage() const { return robot_message_; }

 protected:
  using MutablePicturePtr = std::shared_ptr<Picture>;

  Session(const SessionContext& context, TimePoint connected);

  /// Takes the bytes apart.
  /// @throw ProtocolException no server of this version sends that
  virtual void parse(const std::uint8_t* data, std::size_t size) = 0;

  const std::string& address() const { return context_.address; }
  const Notifier& notifier() const { return context_.notifier; }
  Counters& counters() const { return context_.counters; }
  /// When the bytes that are being taken apart were read.
  TimePoint now() const { return now_; }

  /// The stream is told to start or to stop, whichever it has not been told last.
  void toggleStream(int quality, TimePoint now);
  const StreamControl& stream() const { return stream_; }
  StreamControl& stream() { return stream_; }

  /// Turns the robot's bytes into a picture.
  /// @return null if it is damaged, which is counted and logged
  MutablePicturePtr inspect(Bytes jpeg, TimePoint first_byte_time);

  /// Counts a picture that nobody has asked for.
  /// @throw Fault the stream should have ended long ago
  void dropUnexpected();

  /// Gives a picture to the client's owner.
  void publish(const PicturePtr& picture);

  /// The same with a picture of the stream, unless it has waited unread for too long.
  /// @return false if it has
  bool publishFromStream(const PicturePtr& picture);

  /// What was wrong with the last damaged picture, to be added to a message; "." if there was none.
  std::string damageRemark() const;

  /// A picture is coming, or was asked for just now.
  void signOfPicture(TimePoint now) { last_picture_sign_ = now; }

  /// A large request goes off: until it has gone through, pictures and answers take their time.
  void transferBegins(std::size_t size, TimePoint now);
  /// It has been answered.
  void transferEnds(TimePoint now) { transfer_end_ = std::min(transfer_end_, now); }

  /// When a picture is overdue that is due now.
  TimePoint pictureSilenceLimit() const { return std::max(last_picture_sign_, transfer_end_) + context_.read_timeout; }
  /// @throw Fault always
  [[noreturn]] void failSilent() const;

  /// An answer that takes longer will not come.
  std::chrono::milliseconds answerLimit() const;
  /// When the answer to a request that is sent now is overdue.
  TimePoint answerLimit(TimePoint now) const { return std::max(now, transfer_end_) + answerLimit(); }

  /// When the stall detector wants to look at the socket again.
  TimePoint nextLook() const { return stream_.on() ? stall_detector_.nextLook() : TimePoint::max(); }

  /// To be called whenever commands to the joints could be sent, before they are. If that was long ago, because the
  /// robot was busy or the link stood still, those of then are dropped: nobody expects them any more.
  void dropStaleJointCommands(TimePoint now);
  /// To be called when a request is sent: it may make out of date what the joints were told before it.
  void dropSupersededJointCommands(const RobotRequest& request);
  /// True if this request has to wait until the joints' speed limits have been sent, which hold for what it begins.
  bool mustWaitForSpeedLimits(const RobotRequest& request) const {
    return takesOverJoints(request) && !commands_.speed_limits.empty();
  }

  /// Counts a command or a poll that the robot refused, and logs it, but not again and again.
  /// @param letter of the request
  void noteRefusal(char letter, const std::string& problem);
  /// The robot took such a request: its next refusal is news.
  void noteAcceptance(char letter) { last_refusals_.erase(letter); }
  /// Gives the joints that were accepted to the client's owner.
  void publishAccepted(const std::vector<JointTarget>& targets);
  /// Gives telemetry to the client's owner.
  void publish(Telemetry telemetry);

  Commands commands_;
  RobotInfo robot_;
  std::string robot_message_;

 private:
  const SessionContext context_;
  StreamControl stream_;
  StallDetector stall_detector_;
  TimePoint last_picture_sign_;
  TimePoint transfer_end_;  // of a large request, at the latest
  TimePoint joints_turn_;   // when commands to the joints could be sent
  TimePoint now_;
  TimePoint last_first_byte_;  // of a picture
  std::string last_damage_;
  std::map<char, std::string> last_refusals_;  // by the request's letter
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_SESSION_H
