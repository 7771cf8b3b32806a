/// @file version2_session.h
#ifndef AIBO_DRIVER_CLIENT_VERSION2_SESSION_H
#define AIBO_DRIVER_CLIENT_VERSION2_SESSION_H

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/connection.h"
#include "client/datagram_intake.h"
#include "client/robot_frames.h"
#include "client/session.h"
#include "client/transport_choice.h"
#include "protocol/frame_reader.h"
#include "protocol/version2.h"

namespace aibo_client {

/// A session with a version 2 server. It begins with a hello. Requests are numbered, so several may be unanswered at a
/// time.
class Version2Session final : public Session {
 public:
  /// The time between two hellos. The protocol asks for one a second.
  static constexpr std::chrono::seconds kHelloPeriod{1};
  /// How many commands to the joints may be unanswered. Further commands wait. Without this limit, a link that stands
  /// still would fill up with commands that are old when they arrive.
  static constexpr int kMostJointCommandsOutstanding = 4;
  /// A robot has at most 23 orders that have not ended: 18 joints, four motions, and a walk or a posture. A server that
  /// never ends its orders must not use up all numbers. The value is our choice.
  static constexpr std::size_t kMostOpenRequests = 1000;

  Version2Session(Connection& connection, TimePoint connected);

  int protocolVersion() const override { return 2; }
  bool ready() const override { return ready_; }
  Bytes nextRequest(const Settings& wanted, TimePoint now) override;
  void bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) override;
  bool datagramArrived(const std::uint8_t* data, std::size_t size, TimePoint now) override;
  Bytes takeReply(TimePoint now) override { return datagrams_.takeStatus(now); }
  void checkDeadlines(TimePoint now) override;
  TimePoint nextDeadline() const override;

 private:
  /// The payload of the frame that has arrived.
  struct Payload {
    const unsigned char* data;
    std::size_t size;
  };

  /// Handles an answer. It is null if the answer only confirms the request.
  using OnAnswer = void (Version2Session::*)(const Payload& payload);

  /// A request that was sent and is not over: its answer is still to come, or it is an order that goes on after it.
  struct OpenRequest {
    protocol::version2::Request request;
    std::vector<int> ids{};   ///< the ids of the joints, LEDs or ears
    std::uint64_t order = 0;  ///< OrderTerms::number
    /// When the answer is overdue. It is TimePoint::max() if a call waits for it, or if the request was answered.
    TimePoint deadline = TimePoint::max();
    OnAnswer on_answer = nullptr;
    bool is_for_double_resolution = false;  ///< true: the request is for the stream in double resolution
  };

  /// A report that the robot sent without a request.
  struct Report {
    std::string text;
    bool joint_fault;
    bool about_body;  ///< such as that it lies on its side; over when it walks or takes a posture again
  };

  Bytes requestHello(TimePoint now);
  StreamFormat possibleFormat(const Settings& wanted) const;
  // These requests for settings are empty if the robot has been asked for what the user wants.
  Bytes requestCameraSetting(const Settings& wanted, TimePoint now);
  Bytes requestTransport(const Settings& wanted, TimePoint now);
  Bytes requestStream(const Settings& wanted, TimePoint now);
  Bytes requestTelemetry(const Settings& wanted, TimePoint now);
  Bytes requestColorTable(const Settings& wanted, TimePoint now);
  Bytes requestColors(const Settings& wanted, TimePoint now);
  Bytes requestMicrophone(const Settings& wanted, TimePoint now);
  Bytes requestPicture(const Settings& wanted, Call* call);
  Bytes requestCall(Call* call, TimePoint now);
  Bytes nextCommand(TimePoint now);
  Bytes requestSpeedLimits(TimePoint now);
  Bytes requestTargets(TimePoint now);
  Bytes requestSteering(std::optional<SteeringCommand>* command, TimePoint now);
  Bytes requestLeds(TimePoint now);
  Bytes requestEars(TimePoint now);
  Bytes request(const protocol::version2::Request& request, int id, const Bytes& payload, TimePoint now,
                OnAnswer on_answer = nullptr, const std::vector<int>& ids = {}, std::uint64_t order = 0);
  void remember(const OpenRequest& request);
  Bytes makeFrame(char kind, int id, const Bytes& payload);
  int nextNumber();

  void onFrame();
  void onPush(char kind, const Payload& payload);
  void onReply(char kind, int number, const Payload& payload);
  void onAnswered(int number);
  void onHello(const Payload& payload);
  void onStreamPicture(const Payload& payload);
  void onRequestedPicture(int number, const Payload& payload);
  void onTelemetry(const Payload& payload);
  void onColors(const Payload& payload);
  void onJointsAccepted(const Payload& payload);
  void onLedsAccepted(const Payload& payload);
  void onSound(const Payload& payload);
  void onMicrophone(const Payload& payload);
  void onSteered(const Payload& payload);
  void onCallAnswered(const Call& call, const Payload& payload);
  void onError(int number, const Payload& payload);
  void onRefusal(const OpenRequest& request, RefusalCause cause, const std::string& problem);
  void onEnded(const Payload& payload);
  void onReport(const Payload& payload);
  void onMotorsAndPosture(const Payload& payload);
  void jointFollowsAgain(const std::string& joint);
  void bodyMovesAgain();
  std::shared_ptr<Picture> takePictureFrom(const Payload& payload);
  std::shared_ptr<Picture> inspect(Bytes jpeg, const protocol::version2::ImageHeader& header, TimePoint began);
  void deliverFromStream(const PicturePtr& picture);
  bool isOfTheFuture(std::uint32_t frame_number) const;
  bool isOvertaken(const Picture& picture) const;
  void onDatagrams(const Payload& payload);

  std::optional<char> kindOf(int number) const;
  std::uint64_t orderOf(int number) const;
  long outstanding(char kind) const;
  bool mayCommandJoints() const;
  TimePoint answerDeadline() const;
  TimePoint pictureDeadline() const;

  Connection& connection_;
  Bytes buffer_;  // the payload of the frame that is arriving
  protocol::version2::FrameReader reader_;
  TimePoint frame_began_;  // when the first byte of that frame was read
  TimePoint now_;          // when the bytes that are being parsed were read

  int last_number_ = 0;
  std::map<int, OpenRequest> open_;  // by request number
  RobotFrames frames_;

  bool ready_ = false;
  TimePoint next_hello_;
  bool lacks_double_resolution_ = false;                                   // the robot has refused double resolution
  std::array<int, protocol::version2::NUMBER_OF_CAMERA_SETTINGS> camera_;  // as last requested; kNotRequested
  ColorTables color_tables_;                                               // as last requested
  int telemetry_period_ = 0;                                               // as last requested
  DatagramIntake datagrams_;
  TransportChoice transport_;
  std::optional<std::uint32_t> newest_frame_;  // of the newest delivered picture; empty until UDP was possible
  std::vector<Report> reports_;                // the reports that still hold; the newest is last
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION2_SESSION_H
