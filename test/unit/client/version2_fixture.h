/// @file version2_fixture.h
#ifndef TEST_UNIT_CLIENT_VERSION2_FIXTURE_H
#define TEST_UNIT_CLIENT_VERSION2_FIXTURE_H

#include "client/version2_session.h"
#include "session_fixture.h"
#include "support/version2_frames.h"

/// The robot's end of a session of version 2.
class Version2SessionFixture : public SessionFixture {
 public:
  aibo_client::Session& session() override { return session_; }

  /// The robot says hello. Then it is told the settings of its camera.
  void begin(const std::string& capabilities = "") {
    sayHello(capabilities);
    for (int i = 0; i < protocol::version2::NUMBER_OF_CAMERA_SETTINGS; ++i) {
      EXPECT_EQ('G', request()[0]);
      answer(frame_.payload);
    }
  }
  void sayHello(const std::string& capabilities = "") {
    capabilities_ = capabilities;
    EXPECT_EQ("H 0", request());
    answer(version2_frames::makeHello(capabilities_, kFrame));
  }

  /// What the session sends now: kind, id and the beginning of the payload, as in "W 73 1 0 0 1"; "" if nothing.
  std::string request(std::size_t longest = 256) {
    const Bytes bytes = session_.nextRequest(wanted_, now_);
    if (bytes.empty()) {
      return "";
    }
    frame_ = version2_frames::split(bytes);
    return version2_frames::describe(frame_, longest);
  }

  /// The kinds of all requests that the session sends now.
  std::string requests() {
    std::string kinds;
    for (std::string each = request(); !each.empty(); each = request()) {
      kinds += each[0];
    }
    return kinds;
  }

  using Frame = version2_frames::Frame;

  /// The robot's frame if it had kFrame at the beginning.
  unsigned robotsFrame() const { return kFrame + static_cast<unsigned>((now_ - began_) / milliseconds(8)); }

  /// Answers the last request, or this one.
  void answer(const Bytes& payload) { answer(frame_, payload); }
  void answer(const Frame& request, const Bytes& payload) {
    Bytes reply = version2_frames::makeFrame(protocol::version2::replyKind(request.header.kind),
                                             request.header.request_number, payload);
    reply[1] = request.header.id;
    receive(reply);
  }
  void refuse(const std::string& reason, int code = 0) { refuse(frame_, reason, code); }
  void refuse(const Frame& request, const std::string& reason, int code = 0) {
    receive(version2_frames::makeFrame('e', request.header.request_number, version2_frames::makeError(code, reason)));
  }
  void push(char kind, const Bytes& payload) { receive(version2_frames::makeFrame(kind, 0, payload)); }
  void pushPicture(unsigned seed, unsigned frame_number = 0) {
    push('f', version2_frames::makePicture(test_pictures::makeNumbered(seed), frame_number));
  }

  /// Has the stream, which the robot agrees to.
  void stream() {
    wanted_.streaming = true;
    EXPECT_EQ('W', request()[0]);
    answer(frame_.payload);
  }

  /// Lets time pass, and answers the heartbeat.
  void live(milliseconds time) {
    const TimePoint end = now_ + time;
    while (true) {
      for (std::string each = request(); !each.empty(); each = request()) {
        ASSERT_EQ("H 0", each);
        answer(version2_frames::makeHello(capabilities_, kFrame));
      }
      if (now_ >= end) {
        return;
      }
      pass(std::min(end, session_.nextDeadline()) - now_);
    }
  }

  const TimePoint began_ = now_;
  std::string capabilities_;
  Frame frame_;  // that was sent last
  aibo_client::Version2Session session_{connection_, now_};
};

#endif  // TEST_UNIT_CLIENT_VERSION2_FIXTURE_H
