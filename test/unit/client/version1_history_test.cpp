// The same as session_history_test.cpp with a server of version 1 of the protocol.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "client/fault.h"
#include "client/version1_session.h"
#include "session_transcript.h"

namespace version1_history {

using namespace session_history;

constexpr milliseconds kCameraPeriod{100};

/// A version 1 server. It answers one request at a time.
class OldServer final : public SessionTranscript {
 public:
  enum class Will { kAnswer, kRefuse, kAnswerLate };

  explicit OldServer(bool is_told_of_refusals) : SessionTranscript(is_told_of_refusals) { beIdle(); }

  /// A random past.
  void experience(unsigned seed);
  /// Ends everything that may be under way, and wants nothing any more.
  void beIdle();
  /// Everything that a session can do.
  /// @return what the client sends and tells, and when
  std::string doEverything();

 private:
  Session& session() override { return session_; }

  static const std::vector<std::function<Call()>>& allCalls();
  void live(milliseconds time, Will will = Will::kAnswer);
  void serve(Will will);
  void answer(const Bytes& request, Will will);
  void commandBody(int value);

  ServerHabits habits_;
  Version1Session session_{connection_, habits_, Version1Session::VersionAnswer::kRefused, now_};
  Bytes late_;         // the request that has not been answered
  TimePoint late_at_;  // when it will be
  Will late_will_ = Will::kAnswer;
  std::set<std::string> polled_;
  TimePoint next_picture_ = now_;
  unsigned picture_ = 0;
  bool streams_ = false;
};

const std::vector<std::function<Call()>>& OldServer::allCalls() {
  static const std::vector<std::function<Call()>> kCalls = {
      [] { return callForPicture(30, std::nullopt); },
      [] { return callToPlay("NOD.MTN", 2, 0); },
      [] { return callToStore("B.MTN", Bytes(40000, 3), 1); },
      [] { return callToDelete("B.MTN"); },
      [] { return callForMotions(); },  // it does not know this
      [] { return callToGoOff(protocol::version2::SHUT_DOWN); },
      [] { return callToStop("NOD.MTN"); },
      [] { return callToStop(""); },
  };
  return kCalls;
}

void OldServer::live(milliseconds time, Will will) {
  for (const TimePoint end = now_ + time; now_ < end && !HasFatalFailure();) {
    serve(will);
    const TimePoint next_event = std::min(next_picture_, late_.empty() ? TimePoint::max() : late_at_);
    pass(std::min({end, session_.nextDeadline(), std::max(next_event, now_)}) - now_);
    if (now_ >= next_picture_) {
      next_picture_ = now_ + kCameraPeriod;
      if (streams_) {
        receive(test_pictures::makeReply(jpegOf(++picture_)));
      }
    }
    if (!late_.empty() && now_ >= late_at_) {
      answer(std::exchange(late_, {}), late_will_);
    }
    tell();
  }
  serve(will);
}

void OldServer::serve(Will will) {
  for (Bytes bytes = session_.nextRequest(wish_, now_); !bytes.empty(); bytes = session_.nextRequest(wish_, now_)) {
    std::string text(1, static_cast<char>(bytes[0]));
    for (std::size_t i = 1; i < std::min<std::size_t>(bytes.size(), 30); ++i) {
      text += " " + std::to_string(bytes[i]);
    }
    const bool is_poll = bytes.size() == protocol::BASIC_COMMAND_SIZE && bytes[0] != 'F' && bytes[0] != 'W';
    if (is_poll) {
      polled_.insert(text);  // the order goes on from the last poll
    } else {
      write("> " + text);
    }
    tell();
    if (bytes[0] == 'W') {
      streams_ = !streams_;
    } else if (is_poll || will != Will::kAnswerLate) {
      answer(bytes, is_poll ? Will::kAnswer : will);
    } else {
      late_ = bytes;
      late_at_ = now_ + milliseconds(300);
      late_will_ = ++picture_ % 3 == 0 ? Will::kRefuse : Will::kAnswer;
    }
    tell();
  }
}

void OldServer::answer(const Bytes& request, Will will) {
  if (will == Will::kRefuse) {
    receive({'e', 0, 3, 0});
  } else if (request[0] == 'F') {
    receive(test_pictures::makeReply(jpegOf(++picture_)));
  } else {
    const bool sets_value = request.size() == protocol::VALUE_REQUEST_SIZE;
    receive({static_cast<std::uint8_t>(request[0] - 'A' + 'a'), request[1], sets_value ? request[2] : std::uint8_t{0},
             sets_value ? request[3] : std::uint8_t{0}});
  }
  telemetry_.clear();
}

void OldServer::commandBody(int value) {
  limitSpeed({{1, value / 10.0}, {2, value / 20.0}});
  commandJoints({{1, -value / 100.0}, {2, value / 200.0}, {5, 0.01}});
  commandLeds({{7, value, LedMode::kB}, {8, 0, LedMode::kA}});
  commandEars(value % 2 == 0, value % 2 == 1);
}

void OldServer::beIdle() {
  wish_ = {false, 85, 0};
  live(milliseconds(3000));
  for (const auto& make : allCalls()) {
    call(make());
    live(milliseconds(100));
  }
  std::vector<LedCommand> leds;
  for (int id = 1; id <= 26; ++id) {
    leds.push_back({id, 0, LedMode::kA});
  }
  commandLeds(leds);
  commandBody(3);
  live(milliseconds(1000));
  commandJoints({{5, 0}});
  live(milliseconds(20));
  commandEars(false, false);
  live(milliseconds(30000));
  EXPECT_TRUE(calls_.empty());
}

void OldServer::experience(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&random](int lowest, int highest) {
    return lowest + static_cast<int>(random() % static_cast<unsigned>(highest - lowest + 1));
  };
  const std::vector<std::function<void()>> changes = {
      [&] { wish_.streaming = !wish_.streaming; },
      [&] { wish_.jpeg_quality = number(1, 100); },
      [&] { wish_.telemetry_period = number(0, 1) * 4; },
      [&] { wish_.camera.gain = number(1, 3); },
      [&] { wish_.colors.on = !wish_.colors.on; },
      [&] { commandBody(number(10, 100)); },
      [&] {
        steer({0.1, 0, 0});
      },
      [&] { call(allCalls().at(random() % allCalls().size())(), milliseconds(number(350, 3000))); },
      [&] {
        const Bytes bytes = test_pictures::makeReply(jpegOf(1));
        if (streams_) {  // one in pieces
          receive(Bytes(bytes.begin(), bytes.begin() + 5000));
          now_ += milliseconds(20);
          receive(Bytes(bytes.begin() + 5000, bytes.end()));
        }
      },
  };
  for (int i = 0; i < 40; ++i) {
    changes.at(random() % changes.size())();
    tell();
    live(milliseconds(number(0, 400)), static_cast<Will>(number(0, 2)));
  }
}

std::string OldServer::doEverything() {
  beginTranscript();
  next_picture_ = now_ + milliseconds(50);
  picture_ = 0;
  for (const Will will : {Will::kAnswer, Will::kRefuse, Will::kAnswerLate, Will::kAnswer}) {
    text_ << "# will " << static_cast<int>(will) << "\n";
    wish_.streaming = true;
    wish_.jpeg_quality = 60;
    wish_.camera.gain = 1;
    live(milliseconds(250));
    call(callForPicture(20, std::nullopt));
    live(milliseconds(150), will);
    wish_.streaming = false;
    live(milliseconds(100), will);
    call(callForPicture(20, std::nullopt));
    live(milliseconds(700), will);
    for (const int value : {40, 70, 31}) {
      commandBody(value);
      live(milliseconds(100), will);
    }
    live(milliseconds(3000), will);
    for (const auto& make : allCalls()) {
      call(make(), milliseconds(1000));
      commandBody(50 + static_cast<int>(will));
      live(milliseconds(4000), will);
    }
    steer({0.1, 0, 0});
    polled_.clear();
    wish_.telemetry_period = 4;
    live(milliseconds(3000));
    for (const std::string& each : polled_) {
      text_ << each << "|";
    }
    wish_ = {false, 85, 0};
    live(milliseconds(20000));
  }
  receive({'e', 0, 7, 0});  // it answers nothing
  tell();
  return text_.str() + counters();
}

class Version1HistoryTest : public testing::TestWithParam<bool> {};

TEST_P(Version1HistoryTest, ThePastDoesNotShow) {
  const std::string expected = OldServer(GetParam()).doEverything();
  for (unsigned seed = 0; seed < 20; ++seed) {
    OldServer server(GetParam());
    seed == 0 ? static_cast<void>(server.doEverything()) : server.experience(seed);
    server.beIdle();
    ASSERT_EQ("", difference(expected, server.doEverything())) << "after the history " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Version1HistoryTest, testing::Bool());

}  // namespace version1_history
