/// @file rcserver_fixture.h
/// A robot with an RCServer. Time passes only when the test lets it pass.
#ifndef TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H
#define TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H

#include <TCPEndpointMsg.h>
#include <gmock/gmock.h>

#include <cctype>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "fake_robot.h"
#include "objects/HostSettings.h"
#include "protocol/hello.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "protocol/walk_requests.h"
#include "rcserver/settings/Settings.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"
#include "simulator/openr_host/virtual_robot.h"
#include "slow_object.h"
#include "support/memory_stick.h"
#include "support/raw_client.h"

using test_support::Frame;
using test_support::Reply;
using test_support::TestClient;

/// Frames until joints and sensors have been measured: they report every 4 frames, and two command vectors of 4 frames
/// may be waiting.
constexpr unsigned kUntilMeasured = 12;

constexpr unsigned kFramesASecond = 125;

/// Payloads of requests: for a picture of the highest layer, and that ends a stream of them.
inline const std::string kLayerHigh(1, '\0');
inline const std::string kStreamOff = {0, 0, 0, 1};

/// A request of version 1.
inline std::string request(char letter, int identifier) {
  return {letter, static_cast<char>(identifier)};
}

inline std::string request(char letter, int identifier, int value) {
  return request(letter, identifier) + static_cast<char>(value & 0xff) + static_cast<char>((value >> 8) & 0xff);
}

/// A request of version 1 that is answered at once by an error: for a version that nobody speaks.
inline const std::string kRefused = request('X', 9);

/// A request of version 1 that names a file.
inline std::string fileRequest(char letter, const std::string& name, unsigned short a, unsigned short b = 0) {
  protocol::FileRequest file = {};
  name.copy(file.name, protocol::MAX_MOTION_NAME_SIZE);
  file.a = a;
  file.b = b;
  unsigned char payload[protocol::FILE_PAYLOAD_SIZE];
  encodeFileRequest(file, payload);
  return request(letter, 7) + std::string(payload, payload + sizeof(payload));
}

/// A request of version 2.
inline std::string frame(char kind, int id, int request_number, const std::string& payload = {}) {
  const protocol::version2::FrameHeader header = {kind, static_cast<unsigned char>(id),
                                                  static_cast<unsigned short>(request_number),
                                                  static_cast<unsigned>(payload.size())};
  std::string bytes(protocol::version2::FRAME_HEADER_SIZE, '\0');
  encode(header, reinterpret_cast<unsigned char*>(bytes.data()));
  return bytes + payload;
}

/// A payload, encoded.
template <typename Payload>
std::string payloadOf(const Payload& payload) {
  std::string bytes(protocol::version2::encodedSize(payload), '\0');
  encode(payload, reinterpret_cast<unsigned char*>(bytes.data()));
  return bytes;
}

/// The payload of an order of version 2.
/// @param payload what follows not_after
inline std::string order(const std::string& payload = {}, unsigned not_after = protocol::version2::NEVER_TOO_OLD) {
  return payloadOf(protocol::version2::PostureOrder{not_after}) + payload;
}

/// Targets by the identifiers of joints, as in `J`.
inline std::string targetsOf(const std::vector<std::pair<int, int>>& joints, unsigned short duration_ms = 0) {
  protocol::version2::JointTargets targets = {duration_ms, static_cast<unsigned char>(joints.size()), {}};
  for (size_t i = 0; i < joints.size(); ++i) {
    targets.joints[i] = {static_cast<unsigned char>(joints[i].first), joints[i].second};
  }
  return payloadOf(targets);
}

/// The payload of `P` in version 2.
inline std::string playPayload(const std::string& name, int repetitions,
                               unsigned not_after = protocol::version2::NEVER_TOO_OLD) {
  return order(std::string{static_cast<char>(repetitions >> 8), static_cast<char>(repetitions)} + name, not_after);
}

/// The payload of `U` in version 2.
inline std::string uploadPayload(const std::string& name, const std::string& content) {
  return static_cast<char>(name.size()) + name + content;
}

/// The payload of `W` in version 2: a stream of every image, at full resolution.
inline const std::string kStreamOn = {1, 0, 0, 1};

inline std::string textOf(const Frame& frame) {
  return {frame.payload.begin(), frame.payload.end()};
}

/// A picture of version 2.
struct Picture {
  protocol::version2::FrameHeader frame{};
  protocol::version2::ImageHeader image{};
  std::vector<uint8_t> jpeg;
};

/// What is in a frame; it points into the frame.
template <typename Payload>
Payload payloadIn(const Frame& frame) {
  Payload payload = {};
  EXPECT_EQ(decode(frame.payload.data(), frame.payload.size(), &payload), nullptr);
  return payload;
}

/// The values of a group in telemetry, by their ids.
inline std::map<int, int> valuesIn(const Frame& frame, int group) {
  const auto telemetry = payloadIn<protocol::version2::Telemetry>(frame);
  std::map<int, int> values;
  for (size_t i = 0; i < telemetry.count; ++i) {
    if (telemetry.entries[i].group == group) {
      values[telemetry.entries[i].id] = telemetry.entries[i].value;
    }
  }
  return values;
}

inline Picture pictureIn(const Frame& frame) {
  Picture picture;
  const auto payload = payloadIn<protocol::version2::PicturePayload>(frame);
  picture.frame = frame.header;
  picture.image = payload.header;
  picture.jpeg.assign(payload.jpeg, payload.jpeg + payload.jpeg_size);
  return picture;
}

class RCServerFixture : public ::testing::Test {
 protected:
  RCServerFixture() {
    host_.memory_stick = MEMORY_STICK;
    clock_.step(FakeRobot::kFirstFrame);
  }

  // The machine uses the robot until its end.
  void TearDown() override { machine_.reset(); }

  void boot(openr_host::VirtualRobot& robot) {
    openr_host::MachineOptions options;
    options.ports = {{protocol::RCSERVER_PORT, 0}, {openr_host::kConsolePort, 0}};
    options.memory_stick = host_.memory_stick;
    options.catalog = objectCatalog();
    auto& send_cont = options.catalog.at("RCSERVER.BIN").extra_entries.at(1);  // in stub.cfg
    send_cont = [this, original = send_cont](OObject& object, ANTENVMSG message) {
      sends_.push_back(static_cast<size_t>(static_cast<TCPEndpointSendMsg*>(message)->size));
      original(object, message);
    };
    encoder_.intercept(options.catalog.at("ENCODER.BIN"));
    file_keeper_.intercept(options.catalog.at("FILES.BIN"));
    options.console = &console_;
    options.handler_time = handler_time_;
    setHostSettings(host_);
    machine_ = std::make_unique<openr_host::Machine>(options, clock_, robot);
    machine_->boot();
    machine_->runPending();
  }

  /// @param from the client's address
  std::unique_ptr<TestClient> connect(int receive_buffer = 0, const char* from = "127.0.0.1") {
    auto client = std::make_unique<TestClient>(machine_->hostPort(protocol::RCSERVER_PORT), receive_buffer, from);
    machine_->runPending();
    return client;
  }

  /// Connects a client and waits until the server answers it.
  std::unique_ptr<TestClient> connectServed() {
    auto client = connect();
    ask(*client, "");
    return client;
  }

  /// Sends requests of version 1 and waits until all have been handled: the last one is answered at once.
  void ask(TestClient& client, const std::string& requests) {
    client.send(requests + kRefused);
    ASSERT_EQ(awaitLetter(client), protocol::REPLY_ERROR) << "no answer to the last request";
    machine_->runPending();
  }

  /// Waits for the next reply; empty if the server closes instead.
  std::optional<Reply> await(TestClient& client) {
    std::optional<Reply> reply;
    EXPECT_TRUE(machine_->runUntil([&] { return (reply = client.next()).has_value() || client.ended(); }))
        << "neither a reply nor an end";
    return reply;
  }

  /// The letter of the next reply; 0 if the server closes instead.
  char awaitLetter(TestClient& client) {
    const std::optional<Reply> reply = await(client);
    return reply ? reply->letter : '\0';
  }

  bool awaitEnd(TestClient& client) {
    return machine_->runUntil([&] { return client.ended(); });
  }

  void passFrames(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      clock_.step();
      encoder_.obey();
      file_keeper_.obey();
      machine_->runPending();
    }
  }

  HostSettings host_;
  openr_host::HandlerTime handler_time_;
  SlowObject encoder_;
  SlowObject file_keeper_;
  std::vector<size_t> sends_;  ///< bytes of each send by TCP that has ended
  std::ostringstream console_;
  openr_host::SteppedClock clock_;
  std::unique_ptr<openr_host::Machine> machine_;
};

/// An RCServer on a FakeRobot, with a memory stick of its own, and one client.
class FakeRobotFixture : public RCServerFixture {
 protected:
  using RCServerFixture::ask;

  FakeRobotFixture() { host_.memory_stick = stick_.path().c_str(); }

  /// Boots the robot, and waits until its joints and sensors have been measured.
  virtual void start() {
    machine_.reset();
    console_.str("");
    boot(robot_);
    passFrames(kUntilMeasured);
  }

  /// @param settings content of RCSERVER.CFG
  void startWith(const std::string& settings) {
    stick_.write(SETTINGS_FILE, settings);
    start();
  }

  void takeImage() { passFrames(FakeRobot::kFramesPerImage); }

  std::vector<int> positions() const {
    std::vector<int> all;
    for (const FakeRobot::FakeJoint& joint : robot_.joints) {
      all.push_back(joint.position);
    }
    return all;
  }

  /// Passes frames. @return true if the joint has moved
  bool moves(const std::string& joint, unsigned frames = 400) {
    std::vector<int>& path = robot_.joint(joint).path;
    path.clear();
    passFrames(frames);
    return std::any_of(path.begin(), path.end(), [&](int position) { return position != path.front(); });
  }

  bool isLimp() const {
    return std::none_of(robot_.joints.begin(), robot_.joints.end(),
                        [](const FakeRobot::FakeJoint& joint) { return joint.gain; });
  }

  void disconnect() {
    client_->close();
    machine_->runPending();
  }

  void connectVersion2(int receive_buffer = 0) {
    client_ = connect(receive_buffer);
    client_->send(request('X', 2));
    const std::optional<Reply> reply = await(*client_);
    ASSERT_TRUE(reply && protocol::version2::agreesToVersion2(reply->value));
    machine_->runPending();
  }

  void reconnect() {
    disconnect();
    connectVersion2();
  }

  /// The answer to a request of version 1 that has four bytes.
  protocol::ValueReply answerTo(const std::string& bytes) {
    client_->send(bytes);
    const std::optional<Reply> reply = await(*client_);
    machine_->runPending();
    return reply ? reply->value : protocol::ValueReply{};
  }

  void expectAnswer(const std::string& bytes, char letter, int identifier, int value) {
    const protocol::ValueReply reply = answerTo(bytes);
    EXPECT_EQ(reply.letter, letter) << bytes;
    EXPECT_EQ(reply.identifier, identifier) << bytes;
    EXPECT_EQ(reply.value, value) << bytes;
  }

  void expectError(const std::string& bytes) { expectAnswer(bytes, 'e', 0, protocol::ERROR_REFUSED); }

  void send(const std::string& bytes) {
    client_->send(bytes);
    machine_->runPending();
  }

  /// Sends more than the kernel may take at once.
  void sendAll(const std::string& bytes) {
    for (size_t sent = 0; sent < bytes.size(); machine_->runPending()) {
      sent += client_->send(bytes.substr(sent));
    }
  }

  /// A client of version 2 that does not read a large picture yet, so that everything else waits.
  void connectBehindAPicture() {
    disconnect();
    robot_.showNoise();
    connectVersion2(4096);
    send(frame('F', 100, 999, kLayerHigh));
    takeImage();
  }

  /// The next frame, if it is here. Pushed reports of the motors and the posture are skipped.
  std::optional<Frame> frameThatIsHere() {
    std::optional<Frame> next = client_->nextFrame();
    while (next && next->header.kind == protocol::version2::MOTORS_AND_POSTURE_PUSH &&
           next->header.request_number == 0) {
      next = client_->nextFrame();
    }
    return next;
  }

  /// Waits for a frame.
  std::optional<Frame> nextFrame() {
    std::optional<Frame> next;
    EXPECT_TRUE(machine_->runUntil([&] { return (next = frameThatIsHere()).has_value() || client_->ended(); }));
    machine_->runPending();
    return next;
  }

  /// The frames that have arrived. @param kind of them; 0: of all kinds
  std::vector<Frame> arrived(char kind = '\0') {
    std::vector<Frame> frames;
    machine_->runPending();
    while (const std::optional<Frame> next = frameThatIsHere()) {
      if (kind == '\0' || next->header.kind == kind) {
        frames.push_back(*next);
      }
      machine_->runPending();
    }
    return frames;
  }

  /// What has come: a reply as "s3", a refusal as "e3 5 too old...", an end as "i3 0".
  std::vector<std::string> heard() { return told(arrived()); }

  static std::vector<std::string> told(const std::vector<Frame>& frames) {
    std::vector<std::string> all;
    for (const Frame& next : frames) {
      const std::string payload = textOf(next);
      if (next.header.kind == 'i' && next.header.request_number == 0) {
        const int number = next.payload.at(2) * 256 + next.payload.at(3);
        all.push_back("i" + std::to_string(number) + " " + std::to_string(payload.at(1)));
      } else {
        all.push_back(next.header.kind + std::to_string(next.header.request_number));
        all.back() += next.header.kind == 'e' && !payload.empty()
                          ? " " + std::to_string(payload.at(1)) + " " + payload.substr(2)
                          : "";
      }
    }
    return all;
  }

  /// Waits for something that is pushed; what comes before it is skipped.
  Frame nextPush(char kind) {
    std::optional<Frame> next = nextFrame();
    while (next && (next->header.kind != kind || next->header.request_number != 0)) {
      next = nextFrame();
    }
    EXPECT_TRUE(next);
    return next.value_or(Frame{});
  }

  /// Sends a request of version 2 that is answered at once. Messages that are pushed meanwhile are skipped.
  Frame answerTo(char kind, int id, const std::string& payload = {}) {
    const int number = ++last_number_;
    send(frame(kind, id, number, payload));
    for (;;) {
      const std::optional<Frame> answer = nextFrame();
      if (!answer) {
        ADD_FAILURE() << "no answer to " << kind;
        return {};
      }
      if (answer->header.request_number != 0) {
        EXPECT_EQ(answer->header.request_number, number);
        EXPECT_TRUE(answer->header.kind == std::tolower(kind) || answer->header.kind == 'e') << kind;
        return *answer;
      }
    }
  }

  /// Sends a request of version 2 and passes time until it has been answered. Messages that are pushed meanwhile are
  /// skipped.
  Frame ask(char kind, int id, const std::string& payload = {}) {
    const int number = ++last_number_;
    sendAll(frame(kind, id, number, payload));
    for (int frames = 0; frames < 100; ++frames) {
      while (const std::optional<Frame> next = client_->nextFrame()) {
        if (next->header.request_number == number) {
          return *next;
        }
      }
      passFrames(1);
    }
    ADD_FAILURE() << "no answer to " << kind;
    return {};
  }

  protocol::version2::Hello hello() {
    protocol::version2::Hello hello = {};
    const Frame answer = answerTo('H', 0);
    EXPECT_EQ(answer.header.kind, 'h');
    EXPECT_EQ(decodeHello(answer.payload.data(), answer.payload.size(), &hello), nullptr);
    return hello;
  }

  void expectRefusal(const Frame& answer, int code, const std::string& text_in_it) {
    EXPECT_EQ(answer.header.kind, protocol::version2::ERROR_MESSAGE);
    const auto message = payloadIn<protocol::version2::ErrorMessage>(answer);
    EXPECT_EQ(message.code, code);
    EXPECT_THAT(std::string(message.text, message.text_size), ::testing::HasSubstr(text_in_it));
  }

  test_support::MemoryStick stick_;
  FakeRobot robot_;
  std::unique_ptr<TestClient> client_;
  int last_number_ = 0;  ///< of a request of version 2
};

/// The client speaks version 1. Each start() connects it.
class Version1Fixture : public FakeRobotFixture {
 protected:
  void SetUp() override { start(); }

  void start() override {
    FakeRobotFixture::start();
    client_ = connectServed();
  }
};

/// The client speaks version 2.
class Version2Fixture : public FakeRobotFixture {
 protected:
  void SetUp() override {
    start();
    connectVersion2();
  }
};

#endif  // TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H
