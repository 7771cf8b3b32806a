// A session that has had a varied past, and is idle again, does the same as one that was idle from its beginning.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "client/fault.h"
#include "client/version2_session.h"
#include "protocol/color_requests.h"
#include "protocol/sound_requests.h"
#include "session_transcript.h"
#include "support/picture_datagrams.h"
#include "support/version2_frames.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using version2_frames::Frame;

namespace version2 = protocol::version2;

namespace session_history {

constexpr int kPort = 40000;
constexpr milliseconds kCameraPeriod{100};

Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

ColorTablePtr tableNamed(const std::string& name) {
  ColorTable table;
  table.name = name;
  table.segments[1] = ColorRange{1, 2, 3, 4};
  return std::make_shared<ColorTable>(table);
}

/// A robot that knows every request, and a client. Everything that the client sends and tells is written down.
class WholeRobot final : public SessionTranscript {
 public:
  enum class Will { kAnswer, kRefuse, kKeepSilent };

  /// @param is_older true: it does not repeat lost datagrams, and the client's user is told of refusals
  explicit WholeRobot(bool is_older) : SessionTranscript(is_older), is_older_(is_older) { serve(); }

  /// A random past.
  void experience(unsigned seed);
  /// Ends everything that may be under way, and wants nothing any more.
  void beIdle();
  /// Everything that a session can do.
  /// @return what the client sends and tells, and when
  std::string doEverything();
  /// The robot does not say anything any more.
  /// @return when and how the session gives it up
  std::string fallSilent(bool while_it_streams);

 private:
  enum class Damage { kNone, kCut, kNoJpeg };
  using MakeCall = std::function<Call(WholeRobot&)>;

  Session& session() override { return session_; }

  unsigned frame() const { return base_frame_ + static_cast<unsigned>((now_ - base_) / milliseconds(8)); }

  static const std::vector<MakeCall>& allCalls();
  SoundPart nextPart(unsigned size, bool is_last);
  void serve(Will will = Will::kAnswer);
  void reply(const Frame& request);
  void refuse(const Frame& request, const std::string& reason);
  Bytes answerTo(const Frame& request);
  void answerLate();
  void forgetCalls();
  void live(milliseconds time, Will will = Will::kAnswer);
  void sendPicture();
  void push(char kind, const Bytes& payload, int id = 0, int number = 0);
  void pushTelemetry(int value);
  void pushColors(unsigned pixels);
  void pushSound(unsigned frame_number, int sample);
  void pushSoundEnd(int how, unsigned samples);
  void wantUdp(PictureTransport transport);
  void commandBody(double value);

  Version2Session session_{connection_, now_};
  std::vector<Frame> unanswered_;

  const bool is_older_;
  TimePoint next_picture_ = now_;
  unsigned picture_ = 0;
  unsigned first_picture_ = 0;  // of the order of datagrams
  version2::DatagramOrder order_ = {};
  unsigned sequence_ = 0;
  int lost_part_ = -1;  // of the next picture by UDP
  bool lets_datagrams_through_ = true;
  Damage damage_ = Damage::kNone;  // of the next picture that is asked for
  bool said_hello_ = false;
  TimePoint last_hello_ = now_;
  bool is_silent_ = false;
  SoundPart next_part_;
};

const std::vector<WholeRobot::MakeCall>& WholeRobot::allCalls() {
  static const std::vector<MakeCall> kCalls = {
      [](WholeRobot&) { return callForPicture(30, Resolution::kLow); },
      [](WholeRobot&) { return callForPicture(0, std::nullopt); },
      [](WholeRobot&) { return callForMotors(true); },
      [](WholeRobot&) { return callToPlay("NOD.MTN", 2, version2::TELL_CHANGES); },
      [](WholeRobot&) { return callForPosture(version2::POSTURE_SIT); },
      [](WholeRobot&) { return callToStore("B.MTN", Bytes(40000, 3), 1); },
      [](WholeRobot&) { return callToDelete("B.MTN"); },
      [](WholeRobot&) { return callForMotions(); },
      [](WholeRobot&) { return callToSavePicture(40); },
      [](WholeRobot&) { return callForStickPictures(); },
      [](WholeRobot&) { return callToFetchPicture("MINE.JPG"); },
      [](WholeRobot&) { return callToDeletePicture("MINE.JPG"); },
      [](WholeRobot& robot) {
        return callToPlaySamples(robot.nextPart(5, false), {1, -2, 3, -4, 5});
      },
      [](WholeRobot&) { return callForVolume(2); },
      [](WholeRobot&) { return callToGoOff(version2::SHUT_DOWN); },
      [](WholeRobot&) { return callToStop("NOD.MTN"); },
      [](WholeRobot&) { return callToStop(""); },
      [](WholeRobot&) {
        return callToHold({4, 7});
      },
      [](WholeRobot&) { return callToHold({}); },
      [](WholeRobot&) { return callForMotors(false); },
  };
  return kCalls;
}

SoundPart WholeRobot::nextPart(unsigned size, bool is_last) {
  if (next_part_.is_last || next_part_.sound == 0) {
    next_part_ = {next_part_.sound + 1, 0, 0, false};
  }
  const SoundPart part = {next_part_.sound, next_part_.position, size, is_last};
  next_part_.position += size;
  next_part_.is_last = is_last;
  return part;
}

void WholeRobot::serve(Will will) {
  if (is_older_ && !connection_.transport_problem.empty()) {
    wish_.datagram_port = 0;  // as the client's loop does
  }
  for (Bytes bytes = session_.nextRequest(wish_, now_); !bytes.empty(); bytes = session_.nextRequest(wish_, now_)) {
    const Frame request = version2_frames::split(bytes);
    const char kind = request.header.kind;
    if (kind == version2::REQUEST_HELLO) {
      EXPECT_LE(now_, last_hello_ + Version2Session::kHelloPeriod);
      last_hello_ = now_;
      said_hello_ = true;
    } else {
      write("> " + version2_frames::textOf(request, kind == version2::REQUEST_REPEATED_DATAGRAMS ? 4 : 64));
    }
    tell();
    version2::DatagramOrder order = {};
    if (kind == version2::REQUEST_DATAGRAMS) {
      order.port = protocol::decodeBigEndian16(request.payload.data());
    }
    if (kind == version2::REQUEST_REPEATED_DATAGRAMS) {
      decode(request.payload.data(), request.payload.size(), &order);
    }
    if (order.is_test && lets_datagrams_through_) {
      Bytes datagram(version2::MAX_DATAGRAM_SIZE);
      encode(version2::TestDatagram{order.first_sequence, order.first_picture}, datagram.data());
      receiveDatagram(datagram);
    }
    const bool is_about_udp = kind == version2::REQUEST_DATAGRAMS || kind == version2::REQUEST_REPEATED_DATAGRAMS;
    if (is_about_udp && !order.is_test) {
      order_ = will == Will::kRefuse ? version2::DatagramOrder{} : order;
      sequence_ = order.first_sequence;
      first_picture_ = picture_;
    }
    if (is_silent_) {
      continue;
    }
    if (kind == version2::REQUEST_HELLO || kind == version2::REQUEST_STREAM || will == Will::kAnswer) {
      reply(request);
    } else if (will == Will::kRefuse) {
      refuse(request, "not now");
    } else {
      unanswered_.push_back(request);
    }
  }
}

void WholeRobot::reply(const Frame& request) {
  push(version2::replyKind(request.header.kind), answerTo(request), request.header.id, request.header.request_number);
}

void WholeRobot::refuse(const Frame& request, const std::string& reason) {
  push(version2::ERROR_MESSAGE, version2_frames::makeError(3, reason), 0, request.header.request_number);
}

Bytes WholeRobot::answerTo(const Frame& request) {
  switch (request.header.kind) {
    case version2::REQUEST_HELLO: {
      const std::string text = "robot=ERS-7\nserver=a test 1.0\nframe_number=" + std::to_string(frame()) +
                               "\ncapabilities=F W J V T O I L K B U D P N M Y S E Q R G Z A" +
                               (is_older_ ? "" : " X") +
                               "\n"
                               "limits=1:-1300000:0:3000000 2:-1500000:1600000:10000000\n"
                               "walk_limits=150:100:60:1200\n";
      return bytesOf(text);
    }
    case version2::REQUEST_PICTURE: {
      Bytes jpeg = jpegOf(++picture_);
      const Damage damage = std::exchange(damage_, Damage::kNone);
      jpeg.resize(jpeg.size() / (damage == Damage::kCut ? 2 : 1));
      jpeg[0] = damage == Damage::kNoJpeg ? 0 : jpeg[0];
      return version2_frames::makePicture(jpeg, frame());
    }
    case version2::REQUEST_MOTORS:
      return {request.payload.empty() ? std::uint8_t{1} : request.payload[0]};
    case version2::REQUEST_PLAY:
      return bytesOf(request.payload.at(0) == 0 && request.payload.at(1) == 0 ? "" : "clip");
    case version2::REQUEST_LIST:
      return bytesOf("A.MTN\nB.MTN");
    case version2::REQUEST_SAVE_PICTURE:
      return bytesOf("AIBO0042.JPG");
    case version2::REQUEST_PICTURES:
      return request.header.id == version2::LIST_PICTURES   ? bytesOf("MINE.JPG\nOURS.JPG")
             : request.header.id == version2::FETCH_PICTURE ? jpegOf(1)
                                                            : Bytes();
    case version2::REQUEST_SOUND:
      return request.header.id == version2::SOUND_SPEAKER ? version2_frames::encoded(version2::SpeakerRoom{77})
                                                          : request.payload;
    case version2::REQUEST_HOLD:
    case version2::REQUEST_POSTURE:
    case version2::REQUEST_UPLOAD:
    case version2::REQUEST_DELETE:
      return {};
    default:
      return request.payload;
  }
}

// The newest is answered first.
void WholeRobot::answerLate() {
  while (!unanswered_.empty()) {
    const Frame request = unanswered_.back();
    unanswered_.pop_back();
    const char kind = request.header.kind;
    const bool is_obeyed = kind == version2::REQUEST_DATAGRAMS || kind == version2::REQUEST_REPEATED_DATAGRAMS ||
                           unanswered_.size() % 2 == 0;
    is_obeyed ? reply(request) : refuse(request, "too late");
  }
}

/// Calls that were sent are never answered.
void WholeRobot::forgetCalls() {
  unanswered_.erase(std::remove_if(unanswered_.begin(), unanswered_.end(),
                                   [](const Frame& request) {
                                     return std::string("FPEUDNMYQI").find(request.header.kind) != std::string::npos;
                                   }),
                    unanswered_.end());
}

void WholeRobot::live(milliseconds time, Will will) {
  for (const TimePoint end = now_ + time; now_ < end && !HasFatalFailure();) {
    serve(will);
    pass(std::min({end, session_.nextDeadline(), std::max(next_picture_, now_)}) - now_);
    if (now_ >= next_picture_) {
      next_picture_ = now_ + kCameraPeriod;
      sendPicture();
    }
    tell();
  }
  serve(will);
}

void WholeRobot::sendPicture() {
  if (!connection_.pictures.streaming() || is_silent_) {
    return;
  }
  const Bytes& jpeg = jpegOf(++picture_);
  if (order_.port == 0) {
    return push(version2::PICTURE, version2_frames::makePicture(jpeg, frame()));
  }
  const auto datagrams = test_support::makeDatagrams(jpeg, order_.first_picture + picture_ - 1 - first_picture_,
                                                     frame(), &sequence_, lost_part_ % 2 == 0);
  for (std::size_t part = 0; part < datagrams.size() && lets_datagrams_through_; ++part) {
    if (static_cast<int>(part) != lost_part_) {
      receiveDatagram(datagrams[part]);
    }
  }
  tell();
}

void WholeRobot::push(char kind, const Bytes& payload, int id, int number) {
  Bytes bytes = version2_frames::makeFrame(kind, number, payload);
  bytes[1] = static_cast<std::uint8_t>(id);
  receive(bytes);
  tell();
}

void WholeRobot::pushTelemetry(int value) {
  push(version2::TELEMETRY_PUSH,
       version2_frames::makeTelemetry(frame(), {{version2::GROUP_JOINT, 1, -value},
                                                {version2::GROUP_JOINT, 2, 2 * value},
                                                {version2::GROUP_DUTY, 2, -value / 3},
                                                {version2::GROUP_SENSOR, 1, value},
                                                {version2::GROUP_WALK, version2::WALK_LEFT, -value},
                                                {version2::GROUP_WALK, version2::WALK_STATE, 2}}));
}

void WholeRobot::pushColors(unsigned pixels) {
  version2::ColorRegions colors = {400, frame(), 104, 80, 2, false, {}, nullptr, 0};
  colors.regions[0] =
      pixels == 0 ? version2::ColorRegion{} : version2::ColorRegion{0, pixels, 64 * 50, 64 * 40 + 32, 45, 36, 11, 10};
  colors.regions[1] = {3, 0, 0, 0, 0, 0, 0, 0};
  push(version2::COLORS_PUSH, version2_frames::encoded(colors));
}

void WholeRobot::pushSound(unsigned frame_number, int sample) {
  const unsigned channels = static_cast<unsigned>(wish_.microphone.channels);
  Bytes bytes;
  for (unsigned i = 0; i < 100 * channels; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(sample));
    bytes.push_back(static_cast<std::uint8_t>(i));
  }
  push(version2::SOUND_PUSH,
       version2_frames::encoded(
           version2::HeardSound{frame_number, 100, static_cast<std::uint8_t>(channels), bytes.data(), bytes.size()}),
       version2::SOUND_MICROPHONE);
}

void WholeRobot::pushSoundEnd(int how, unsigned samples) {
  push(version2::SOUND_PUSH,
       version2_frames::encoded(version2::SoundEnd{static_cast<std::uint8_t>(how), samples, 2, 1}),
       version2::SOUND_SPEAKER);
}

void WholeRobot::wantUdp(PictureTransport transport) {
  wish_.transport = transport;
  ++wish_.transport_changes;
  connection_.transport_problem.clear();  // as the client's loop does
  wish_.datagram_port = transport == PictureTransport::kTcp ? 0 : kPort;
}

void WholeRobot::commandBody(double value) {
  limitSpeed({{1, value}, {2, value / 2}});
  commandJoints({{1, -value / 10}, {2, value / 20}}, milliseconds(static_cast<int>(100 * value)));
  commandJoints({{3, value / 30}});
  steer({value / 50, -value / 100, value / 10});
  commandLeds({{7, static_cast<int>(10 * value), LedMode::kB}, {8, 0, LedMode::kA}});
  commandEars(value > 1, value < 2);
}

void WholeRobot::beIdle() {
  answerLate();
  wish_.color_tables = {};
  wish_.colors = {true, 3, false};
  wish_.microphone = {true, 1, 8000};
  wish_.telemetry_period = 4;
  wish_.streaming = true;
  wish_.format = {};
  wish_.jpeg_quality = 85;
  wish_.camera = {};
  lets_datagrams_through_ = true;
  lost_part_ = -1;
  wantUdp(PictureTransport::kTcp);
  live(milliseconds(1500));
  wantUdp(PictureTransport::kUdp);
  live(milliseconds(300));
  wantUdp(PictureTransport::kTcp);
  live(milliseconds(300));
  // Whatever was refused and is not logged again until it is accepted is accepted once.
  for (const MakeCall& make : allCalls()) {
    call(make(*this));
    live(milliseconds(8));
  }
  next_part_.is_last = true;
  call(callToPlaySamples({0, 0, 0, true}, {}));
  commandBody(0.5);
  live(milliseconds(500));
  steer({});
  damage_ = Damage::kCut;
  call(callForPicture(1, std::nullopt));
  live(milliseconds(10000));
  pushTelemetry(1);
  pushColors(3);
  pushSound(frame(), 1);
  push(version2::END_PUSH, version2_frames::makeEnd(version2::ENDED_JAM, 0, "head_tilt", ""));
  EXPECT_EQ("", connection_.robot_message);
  push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_REFUSED, "it lies on its side"));
  steer({});
  live(milliseconds(10));
  EXPECT_EQ("", connection_.robot_message);
  push(version2::MOTORS_AND_POSTURE_PUSH, version2_frames::encoded(version2::MotorsAndPosture{}));
  connection_.motors_and_posture = {};
  wish_.streaming = false;
  wish_.telemetry_period = 0;
  wish_.colors = {};
  wish_.microphone = {};
  live(milliseconds(30000));
  EXPECT_TRUE(calls_.empty());
}

void WholeRobot::experience(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&random](int lowest, int highest) {  // the same with every library
    return lowest + static_cast<int>(random() % static_cast<unsigned>(highest - lowest + 1));
  };
  const std::vector<std::function<void()>> changes = {
      [&] { wish_.streaming = !wish_.streaming; },
      [&] { wish_.streaming = true; },
      [&] { wish_.jpeg_quality = number(1, 100); },
      [&] {
        wish_.format = {static_cast<Resolution>(number(0, 2)), number(1, 3)};
      },
      [&] {
        wish_.camera = {number(1, 3), number(1, 3), number(1, 3), number(0, 1) == 1, number(0, 1) == 1};
      },
      [&] { wantUdp(static_cast<PictureTransport>(number(0, 2))); },
      [&] { lets_datagrams_through_ = !lets_datagrams_through_; },
      [&] { lost_part_ = number(-1, 4); },
      [&] { wish_.telemetry_period = number(0, 1) * 8; },
      [&] {
        wish_.colors = {number(0, 1) == 1, number(1, 3), number(0, 1) == 1};
      },
      [&] { wish_.color_tables.at(static_cast<std::size_t>(number(0, 7))) = tableNamed("an old one"); },
      [&] {
        wish_.microphone = {number(0, 2) > 0, number(1, 2), 8000 * number(1, 2), number(0, 1) == 1};
      },
      [&] { commandBody(number(1, 30) / 10.0); },
      [&] { commandBody(number(1, 30) / 10.0); },
      [&] { damage_ = Damage::kCut; },
      [&] { pushTelemetry(number(-100000, 100000)); },
      [&] { pushTelemetry(900000000); },  // impossible
      [&] { pushColors(static_cast<unsigned>(number(0, 100))); },
      [&] { pushSound(frame() + static_cast<unsigned>(number(0, 50)), number(0, 255)); },
      [&] { call(callToPlaySamples(nextPart(50, number(0, 1) == 1), std::vector<std::int16_t>(50, 3))); },
      [&] { pushSoundEnd(number(0, 4), static_cast<unsigned>(number(0, 2) * 50)); },
      [&] { push(version2::END_PUSH, version2_frames::makeEnd(number(1, 4), number(0, 6), "NOD.MTN", "so")); },
      [&] {
        push(version2::MOTORS_AND_POSTURE_PUSH, version2_frames::encoded(version2::MotorsAndPosture{true, 2}));
      },
      [&] {
        push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_JOINT_FAULT, "head_tilt is stuck"));
      },
      [&] { push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_REFUSED, "it lies on its side")); },
      [&] { call(allCalls().at(random() % allCalls().size())(*this), milliseconds(number(1, 3000))); },
      [&] { call(allCalls().at(random() % allCalls().size())(*this), milliseconds(number(1, 300))); },
  };
  for (int i = 0; i < 60; ++i) {
    changes.at(random() % changes.size())();
    tell();
    if (number(0, 3) > 0) {
      live(milliseconds(number(0, 400)), static_cast<Will>(number(0, 2)));
    }
    if (number(0, 3) == 0) {
      forgetCalls();
    }
    if (number(0, 1) == 1 || i % 4 == 3) {
      answerLate();
    }
  }
}

/// The requests among these lines, without their times.
std::string requestsIn(const std::string& text) {
  std::istringstream lines(text);
  std::string requests;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find(" > ");
    requests += begin == std::string::npos ? "" : line.substr(begin) + "\n";
  }
  return requests;
}

std::string WholeRobot::doEverything() {
  said_hello_ = false;
  for (int i = 0; i < 1000 && !said_hello_; ++i) {
    live(milliseconds(1));
  }
  base_frame_ = frame() + 1;
  beginTranscript(next_part_.sound);
  next_picture_ = now_ + milliseconds(50);
  picture_ = 0;

  const auto title = [this](const std::string& name) { text_ << "# " << name << "\n"; };
  title("camera and stream");
  wish_.camera = {1, 3, 1, true, false};
  wish_.jpeg_quality = 60;
  wish_.streaming = true;
  live(milliseconds(250));
  wish_.format = {Resolution::kMiddle, 2};
  live(milliseconds(250));
  damage_ = Damage::kNoJpeg;
  call(callForPicture(20, Resolution::kHigh));
  call(callForPicture(0, std::nullopt));
  live(milliseconds(150));

  title("pictures by UDP");
  wantUdp(is_older_ ? PictureTransport::kUdp : PictureTransport::kAuto);
  serve();
  const unsigned forged = order_.first_picture + 40;
  unsigned sequence = sequence_ + 45;
  for (const Bytes& datagram : test_support::makeDatagrams(jpegOf(2), forged, frame(), &sequence)) {
    receiveDatagram(datagram);
  }
  live(milliseconds(400));
  EXPECT_LT(counters_before_.bad_datagrams, counters_.bad_datagrams);
  lost_part_ = 1;
  live(milliseconds(400));
  lost_part_ = 2;
  live(milliseconds(300));
  lets_datagrams_through_ = false;
  live(milliseconds(15000));
  lets_datagrams_through_ = true;
  lost_part_ = -1;
  live(milliseconds(12000));
  wantUdp(PictureTransport::kUdp);
  live(milliseconds(300));
  wish_.streaming = false;
  live(milliseconds(500));

  title("telemetry");
  wish_.telemetry_period = 8;
  live(milliseconds(10));
  for (const int value : {100000, -200000}) {
    pushTelemetry(value);
    live(milliseconds(70));
  }
  title("colours");
  wish_.color_tables[0] = tableNamed("ball");
  wish_.color_tables[3] = tableNamed("goal");
  wish_.colors = {true, 2, false};
  live(milliseconds(10));
  for (const unsigned pixels : {100U, 50U, 0U}) {
    pushColors(pixels);
    live(milliseconds(70));
  }
  wish_.color_tables[3] = nullptr;
  live(milliseconds(10));
  pushColors(30);
  title("sound");
  wish_.microphone = {true, 2, 16000, true};
  pushSound(frame(), 1);  // nobody has asked for it
  live(milliseconds(10));
  const unsigned heard = frame();
  pushSound(heard, 2);
  live(milliseconds(40));
  pushSound(heard + 3, 3);
  for (const bool is_last : {false, true}) {
    call(callToPlaySamples(nextPart(50, is_last), std::vector<std::int16_t>(50, 3)));
    live(milliseconds(20));
  }
  pushSoundEnd(version2::END_DONE, 100);
  call(callToPlaySamples(nextPart(50, false), std::vector<std::int16_t>(50, 4)));
  live(milliseconds(20));
  call(callToPlaySamples({0, 0, 0, true}, {}));
  live(milliseconds(20));
  next_part_.is_last = true;

  title("commands to the body");
  std::vector<std::string> requests;
  for (const Will will :
       {Will::kRefuse, Will::kRefuse, Will::kAnswer, Will::kRefuse, Will::kKeepSilent, Will::kAnswer}) {
    const std::size_t begin = text_.str().size();
    for (const double value : {1.5, 2.5}) {
      commandBody(value);
      live(milliseconds(60), will);
    }
    commandBody(1.5);
    live(milliseconds(600), will);
    answerLate();
    serve(will);
    requests.push_back(requestsIn(text_.str().substr(begin)));
  }
  EXPECT_EQ(requests[0], requests[1]) << "after the robot has refused them";
  EXPECT_EQ(requests[0], requests[2]) << "after the robot has refused them";
  for (const Will will : {Will::kRefuse, Will::kAnswer, Will::kKeepSilent}) {
    title(will == Will::kRefuse ? "refused calls" : will == Will::kAnswer ? "calls" : "late answers");
    for (const MakeCall& make : allCalls()) {
      call(make(*this), milliseconds(200));
      live(milliseconds(150), will);
      live(milliseconds(100), will);
      answerLate();
    }
  }
  title("stops while much is under way");
  for (std::size_t stop = allCalls().size() - 5; stop < allCalls().size(); ++stop) {
    call(callToStore("B.MTN", Bytes(100, 3), 0));
    call(callToPlay("NOD.MTN", 1, 0));
    commandBody(1.0 + static_cast<double>(stop) / 10);
    live(milliseconds(5), Will::kKeepSilent);
    call(callForPosture(version2::POSTURE_STAND));
    commandBody(1.1 + static_cast<double>(stop) / 10);
    call(allCalls().at(stop)(*this));
    live(milliseconds(5), Will::kKeepSilent);
    answerLate();
    live(milliseconds(700));
  }
  title("reports");
  live(std::chrono::seconds(20));  // for the limit of the log
  for (const char* const text : {"head_tilt is stuck", "neck_pan and head_pan are stuck"}) {
    push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_JOINT_FAULT, text));
  }
  push(version2::ERROR_MESSAGE, version2_frames::makeError(version2::CODE_REFUSED, "it lies on its side"));
  push(version2::MOTORS_AND_POSTURE_PUSH, version2_frames::encoded(version2::MotorsAndPosture{true, 1}));
  push(version2::MOTORS_AND_POSTURE_PUSH, version2_frames::encoded(version2::MotorsAndPosture{false, 3}));
  steer({0.1, 0, 0});
  live(milliseconds(10));
  for (const char* const joint : {"head_pan", "head_tilt"}) {
    push(version2::END_PUSH, version2_frames::makeEnd(version2::ENDED_JAM, 0, joint, ""));
  }
  push(version2::END_PUSH, version2_frames::makeEnd(version2::ENDED_MOTION, 2, "NOD.MTN", "told to"));
  live(milliseconds(1000));
  return text_.str() + counters();
}

std::string WholeRobot::fallSilent(bool while_it_streams) {
  wantUdp(PictureTransport::kTcp);
  wish_.streaming = while_it_streams;
  live(milliseconds(2000));
  call(callToStore("B.MTN", Bytes(100000, 3), 0));
  serve(while_it_streams ? Will::kAnswer : Will::kRefuse);
  is_silent_ = true;
  text_.str("");
  const TimePoint since = now_;
  commandBody(3);
  call(callForMotions(), milliseconds(300));
  try {
    live(milliseconds(10000));
  } catch (const Fault& fault) {
    write(fault.what());
    EXPECT_LE(now_, since + (while_it_streams ? milliseconds(500) + connection_.pictures.extraInterval()
                                              : milliseconds(1000)));
  }
  return text_.str();
}

class SessionHistoryTest : public testing::TestWithParam<bool> {};

TEST_P(SessionHistoryTest, ThePastDoesNotShow) {
  const auto test = [](WholeRobot* robot, unsigned seed) {
    const std::string everything = robot->doEverything();
    return everything + robot->fallSilent(seed % 2 == 0);
  };
  std::array<std::string, 2> expected;
  for (unsigned seed = 0; seed < 2; ++seed) {
    WholeRobot robot(GetParam());
    expected.at(seed) = test(&robot, seed);
  }
  for (unsigned seed = 0; seed < 20; ++seed) {
    WholeRobot robot(GetParam());
    seed == 0 ? static_cast<void>(robot.doEverything()) : robot.experience(seed);
    robot.beIdle();
    ASSERT_EQ("", difference(expected.at(seed % 2), test(&robot, seed))) << "after the history " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SessionHistoryTest, testing::Bool());

}  // namespace session_history
