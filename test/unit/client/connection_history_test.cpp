// A client that has had other connections before does over the next one what a new client does.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "client_fixture.h"
#include "protocol/color_requests.h"
#include "protocol/sound_requests.h"
#include "support/version2_frames.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using version2_frames::Frame;

namespace version2 = protocol::version2;

namespace connection_history {

constexpr milliseconds kTimeout{20000};
constexpr char kEnded[] = "ended";
constexpr char kWait[] = "WAIT";  // at this end, the client's thread waits for commands

/// What the client tells, by the kind of news. It can be waited for.
class Diary {
 public:
  void write(const std::string& kind, const std::string& line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    lines_[kind] += line + "\n";
    changed_.notify_all();
  }

  bool waitFor(const std::string& kind, const std::string& text) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kTimeout, [&] { return lines_[kind].find(text) != std::string::npos; });
  }

  /// @param port any port is as good as another
  std::string take(int port) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string text;
    for (const auto& [kind, lines] : std::exchange(lines_, {})) {
      text += "# " + kind + "\n" + lines;
    }
    const std::string number = std::to_string(port);
    for (std::size_t at = text.find(number); at != std::string::npos; at = text.find(number)) {
      text.replace(at, number.size(), "PORT");
    }
    return text;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::string> lines_;
};

template <typename Number>
std::string numberOf(Number number) {
  return std::to_string(static_cast<int>(number));
}

std::string textOf(const ConnectionStatus& status) {
  return numberOf(status.state) + numberOf(status.protocol_version) + numberOf(status.fault) + "|" + status.reason +
         "|" + status.advice + "|" + status.robot.design + "|" + std::to_string(status.robot.capabilities.size()) +
         "|" + status.robot_message + "|" + numberOf(status.transport) + numberOf(status.wanted_transport) + "|" +
         status.transport_problem;
}

/// A client and the robots that it meets, one after the other.
class Life {
 public:
  Life() : client_(options(), callbacks()), state_before_(state()) { client_.start(); }

  /// A connection with much under way, which ends.
  using End = std::function<void(Life&)>;
  void meetOldRobot(int number, const End& end);

  /// @return all that the client sends and tells over the next connection, which breaks in the end
  std::string meetRobot();

  void wishFor(int value);
  void reset() { peer_->reset(); }
  void close() { peer_->close(); }
  void breakProtocol();

 private:
  ClientOptions options() const {
    ClientOptions options;
    options.port = server_.port();
    options.connect_timeout = options.read_timeout = kTimeout;
    options.reconnect_wait_min = milliseconds(10);
    options.reconnect_wait_max = milliseconds(10);
    return options;
  }
  Callbacks callbacks();

  std::string state() const;
  void accept();
  void serve(const Frame& request);
  Frame serveUntil(char kind);
  void push(char kind, const Bytes& payload, int id = 0, int number = 0);
  void pushEverything(int value);
  template <typename Ask>
  std::future<void> inBackground(const std::string& name, Ask ask);
  template <typename Ask>
  void ask(char kind, const std::string& name, const Ask& ask);
  void command(int value);
  void waitForEnd(std::vector<std::future<void>>* pending);

  ScriptedServer server_;
  Diary diary_;
  std::optional<ScriptedPeer> peer_;
  char refuses_ = 0;
  std::future<void> commanded_;
  RcServerClient client_;
  const std::string state_before_;
  std::atomic<std::uint64_t> sound_{0};
};

Callbacks Life::callbacks() {
  Callbacks callbacks;
  callbacks.on_status = [this](const ConnectionStatus& status) {
    if (status.state != ConnectionState::kConnecting) {
      diary_.write("status", textOf(status));
    }
  };
  callbacks.on_streaming = [this](bool streaming) { diary_.write("streaming", streaming ? "on" : "off"); };
  callbacks.on_telemetry = [this](const Telemetry& telemetry) {
    diary_.write("telemetry", std::to_string(telemetry.joints.at(0).position));
  };
  callbacks.on_joints_accepted = [this](const std::vector<JointTarget>& targets) {
    diary_.write("joints", std::to_string(targets.at(0).position));
  };
  callbacks.on_leds_accepted = [this](const std::vector<LedCommand>& leds) {
    diary_.write("LEDs", std::to_string(leds.at(0).intensity));
  };
  callbacks.on_steered = [this](const WalkVelocity& velocity, std::uint64_t order) {
    diary_.write("walk", std::to_string(velocity.left) + " " + std::to_string(order));
  };
  callbacks.on_ended = [this](const MotionEnd& end) {
    diary_.write(kEnded, end.name + numberOf(end.how));
    if (end.name == kWait) {
      commanded_.wait();
    }
  };
  callbacks.on_refused = [this](const Refusal& refusal) {
    diary_.write("refused", numberOf(refusal.request) + refusal.reason + std::to_string(refusal.order));
  };
  callbacks.on_motors_and_posture = [this](const MotorsAndPosture& state) {
    diary_.write("motors", numberOf(state.motors) + numberOf(state.posture));
  };
  callbacks.on_colors = [this](const DetectedColors& colors) {
    diary_.write("colours", colors.regions.at(0).name + std::to_string(colors.regions.at(0).pixels));
  };
  callbacks.on_heard = [this](const HeardSound& sound) {
    diary_.write("heard", std::to_string(sound.missing) + " " + std::to_string(sound.samples.at(0)));
  };
  callbacks.on_sound_ended = [this](const SoundEnd& end) {
    diary_.write("sound", std::to_string(end.sound - sound_) + " " + numberOf(end.how));
  };
  callbacks.log = [this](LogLevel level, const std::string& line) { diary_.write("log", numberOf(level) + line); };
  return callbacks;
}

/// What is said of the robot.
std::string Life::state() const {
  const ConnectionStatus status = client_.status();
  return status.robot.design + numberOf(status.robot.capabilities.size()) + numberOf(status.protocol_version) +
         numberOf(status.transport) + numberOf(client_.streaming()) + numberOf(client_.motorsAndPosture().motors) +
         numberOf(client_.motorsAndPosture().posture) + client_.robotDesign();
}

// Commands come when the client has read the nonsense, but not yet noticed it. They are not for the next robot.
void Life::breakProtocol() {
  std::promise<void> commanded;
  commanded_ = commanded.get_future();
  Bytes bytes = version2_frames::makeFrame(version2::END_PUSH, 0, version2_frames::makeEnd(1, 2, kWait, ""));
  bytes.resize(bytes.size() + 20);
  peer_->send(bytes);
  EXPECT_TRUE(diary_.waitFor(kEnded, kWait));
  command(8);
  commanded.set_value();
}

void Life::accept() {
  refuses_ = 0;
  peer_ = server_.accept();
  diary_.take(server_.port());
  const protocol::BasicGetCommand question = peer_->readCommand();
  EXPECT_EQ(protocol::REQUEST_NEWER_VERSION, question.command);
  peer_->send({'x', 2, 0, 0});
}

void Life::serve(const Frame& request) {
  const char kind = request.header.kind;
  if (kind != version2::REQUEST_HELLO) {
    // The numbers of datagrams are random.
    diary_.write(std::string("> ") + kind, version2_frames::textOf(request, kind == 'X' ? 0 : 80));
  }
  Bytes payload = request.payload;
  if (kind == version2::REQUEST_HELLO) {
    payload = version2_frames::makeHello("F W J V T O I L K B X U D P N S E G Z A");
  } else if (kind == refuses_) {
    return push(version2::ERROR_MESSAGE, version2_frames::makeError(3, "not now"), 0, request.header.request_number);
  } else if (kind == version2::REQUEST_PICTURE) {
    payload = version2_frames::makePicture(test_pictures::makeNumbered(1), 7);
  } else if (kind == version2::REQUEST_LIST || kind == version2::REQUEST_PLAY) {
    payload = {'A', '.', 'M', 'T', 'N'};
  } else if (kind == version2::REQUEST_SOUND && request.header.id == version2::SOUND_SPEAKER) {
    payload = version2_frames::encoded(version2::SpeakerRoom{77});
  } else if (kind == version2::REQUEST_MOTORS && payload.empty()) {
    payload = {0};
  } else if (kind == version2::REQUEST_HOLD || kind == version2::REQUEST_UPLOAD) {
    payload.clear();
  }
  push(version2::replyKind(kind), payload, request.header.id, request.header.request_number);
}

/// Answers until a request of this kind has come, which is not answered.
Frame Life::serveUntil(char kind) {
  for (const auto end = std::chrono::steady_clock::now() + kTimeout; std::chrono::steady_clock::now() < end;) {
    Frame request = peer_->readFrame();
    if (request.header.kind == kind) {
      return request;
    }
    serve(request);
  }
  throw std::runtime_error(std::string("the client has not sent the request ") + kind);
}

void Life::push(char kind, const Bytes& payload, int id, int number) {
  Bytes frame = version2_frames::makeFrame(kind, number, payload);
  frame[1] = static_cast<std::uint8_t>(id);
  peer_->send(frame);
}

/// One at a time, because only the newest colours are told.
void Life::pushEverything(int value) {
  push(version2::TELEMETRY_PUSH, version2_frames::makeTelemetry(7, {{version2::GROUP_JOINT, 1, -value}}));
  version2::ColorRegions colors = {400, 7, 104, 80, 1, false, {}, nullptr, 0};
  colors.regions[0] = {2, static_cast<unsigned>(value), 64 * 50, 64 * 40 + 32, 45, 36, 11, 10};
  push(version2::COLORS_PUSH, version2_frames::encoded(colors));
  for (const unsigned frame : {10U, 14U}) {
    Bytes samples(512, static_cast<std::uint8_t>(value));
    push(version2::SOUND_PUSH,
         version2_frames::encoded(version2::HeardSound{frame, 128, 2, samples.data(), samples.size()}),
         version2::SOUND_MICROPHONE);
  }
  push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_JOINT_FAULT, "head_tilt is stuck"));
  push(version2::MOTORS_AND_POSTURE_PUSH,
       version2_frames::encoded(version2::MotorsAndPosture{true, static_cast<std::uint8_t>(value % 4)}));
  push(version2::END_PUSH, version2_frames::makeEnd(version2::ENDED_MOTION, 2, "LAST" + std::to_string(value), ""));
  EXPECT_TRUE(diary_.waitFor(kEnded, "LAST" + std::to_string(value)));
}

void Life::wishFor(int value) {
  ColorTable table;
  table.name = "colour " + std::to_string(value);
  client_.setColorTable(2, std::make_shared<ColorTable>(table));
  client_.setColorDetection({true, value, false});
  client_.setMicrophone({true, 2, 16000, value == 1});
  client_.setTelemetryPeriod(4 * value);
  client_.setCameraSettings({value, 3, 1, false, true});
  client_.setStreamFormat({Resolution::kMiddle, value});
  client_.setJpegQuality(10 * value);
  client_.setStreaming(true);
}

template <typename Ask>
std::future<void> Life::inBackground(const std::string& name, Ask ask) {
  return std::async(std::launch::async, [this, name, ask] {
    try {
      ask();
      diary_.write("answer to " + name, "good");
    } catch (const TimeoutException& error) {
      diary_.write("answer to " + name, std::string("late: ") + error.what());
    } catch (const Exception& error) {
      diary_.write("answer to " + name, error.what());
    }
  });
}

template <typename Ask>
void Life::ask(char kind, const std::string& name, const Ask& ask) {
  auto answer = inBackground(name, ask);
  serve(serveUntil(kind));
  answer.get();
}

void Life::command(int value) {
  const auto never = std::chrono::steady_clock::time_point::max();
  client_.commandJoints({{1, value / 10.0, value + 1.0}, {2, -value / 20.0}}, milliseconds(value), {never, 1});
  client_.steer({0, -value / 100.0, 0}, {never, 2});
  client_.commandLeds({{7, value, LedMode::kB}});
  client_.commandEars(value % 2 == 0, value % 2 == 1);
}

std::string Life::meetRobot() {
  client_.setPictureTransport(PictureTransport::kTcp);
  client_.setPictureTransport(PictureTransport::kUdp);
  accept();
  refuses_ = 'X';
  serve(serveUntil(version2::REQUEST_HELLO));
  serve(serveUntil(version2::REQUEST_SOUND));  // it is the last of the wishes
  EXPECT_TRUE(diary_.waitFor("log", "Connected"));
  client_.waitForConnection(kTimeout);
  diary_.write("connected", client_.robotDesign() + numberOf(client_.motorsAndPosture().posture));
  ask('O', "motors", [&] { client_.setMotors(true, kTimeout); });
  ask('N', "motions", [&] { client_.listMotions(kTimeout); });
  ask('P', "play", [&] {
    client_.playMotion("A.MTN", 3, kTimeout, {std::chrono::steady_clock::time_point::max(), 3});
  });
  ask('I', "hold", [&] { client_.hold({1}, kTimeout); });
  const std::uint64_t old_sound = std::max<std::uint64_t>(sound_, 1);
  inBackground("an old sound", [&] { client_.playSamples(old_sound, {1}, false, kTimeout); }).get();
  std::uint64_t sound = 0;
  for (int part = 0; part < 2; ++part) {
    ask('A', "sound", [&] { sound = client_.playSamples(sound, {1, 2, 3}, false, kTimeout).sound; });
  }
  sound_ = sound;
  for (const int value : {4, 7}) {
    command(value);
    serve(serveUntil('K'));
    EXPECT_TRUE(diary_.waitFor("LEDs", std::to_string(value)));
  }
  pushEverything(9);
  EXPECT_TRUE(diary_.waitFor("status", "head_tilt"));
  std::vector<std::future<void>> pending;
  pending.push_back(inBackground("upload", [&] { client_.uploadMotion("B.MTN", Bytes(9, 1), kTimeout); }));
  serveUntil('U');
  pending.push_back(inBackground("volume", [&] { client_.setVolume(2, kTimeout); }));
  serveUntil('A');
  reset();
  waitForEnd(&pending);
  EXPECT_TRUE(diary_.waitFor("sound", "0 " + numberOf(EndedHow::kLost)));
  return diary_.take(server_.port());
}

// Calls have ended when the end of the connection has been told.
void Life::waitForEnd(std::vector<std::future<void>>* pending) {
  EXPECT_TRUE(diary_.waitFor("status", "\n0"));
  for (std::future<void>& each : *pending) {
    each.get();
  }
  EXPECT_EQ(state_before_, state()) << "of the robot nothing is left";
  diary_.write("lost", client_.status().reason + client_.status().advice);
  for (const std::uint64_t sound : {sound_.load(), std::uint64_t{0}}) {
    inBackground("lost", [&, sound] { client_.playSamples(sound, {1, 2}, true, kTimeout); }).get();
  }
}

void Life::meetOldRobot(int number, const End& end) {
  client_.setPictureTransport(static_cast<PictureTransport>(number % 3));
  wishFor(number % 2 + 1);
  accept();
  serve(serveUntil(version2::REQUEST_HELLO));
  serve(serveUntil(version2::REQUEST_SOUND));
  client_.waitForConnection(kTimeout);
  pushEverything(number);
  refuses_ = number % 2 == 0 ? 'X' : 'L';
  command(number);
  serve(serveUntil('K'));
  ask('A', "sound", [&] { sound_ = client_.playSamples(0, {1}, number % 3 == 0, kTimeout).sound; });
  std::vector<std::future<void>> pending;
  for (int i = 0; i < 3; ++i) {
    pending.push_back(inBackground("play", [&] {
      client_.playMotion("B.MTN", 2, kTimeout, {std::chrono::steady_clock::time_point::max(), 3});
    }));
    pending.push_back(inBackground("picture", [&] { client_.takePicture(9, kTimeout); }));
    command(number + i);
  }
  serveUntil(number % 2 == 0 ? 'P' : 'F');
  end(*this);
  waitForEnd(&pending);
}

TEST(ConnectionHistoryTest, EarlierConnectionsDoNotShow) {
  Life fresh;
  fresh.wishFor(3);
  const std::string expected = fresh.meetRobot();
  EXPECT_THAT(expected, testing::HasSubstr("# walk\n-0.040000 2\n-0.070000 2\n"));
  const std::vector<std::pair<std::string, Life::End>> ends = {
      {"reset", [](Life& life) { life.reset(); }},
      {"closed", [](Life& life) { life.close(); }},
      {"nonsense", [](Life& life) { life.breakProtocol(); }},
  };
  for (int number = 1; number <= 6; ++number) {
    Life life;  // a new one each time, because the log is limited
    const auto& [name, end] = ends.at(static_cast<std::size_t>(number) % ends.size());
    life.meetOldRobot(number, end);
    life.meetOldRobot(number + 1, end);
    life.wishFor(3);
    EXPECT_EQ(expected, life.meetRobot()) << "after connections " << number << " and the next, " << name;
  }
}

}  // namespace connection_history
