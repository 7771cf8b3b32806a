// Sound: what the client asks for, what it believes, and what it sends.
#include "client_fixture.h"
#include "protocol/sound_requests.h"
#include "version2_fixture.h"

using namespace aibo_client;
using namespace test_support;
using std::chrono::milliseconds;
using test_pictures::Bytes;

namespace version2 = protocol::version2;

namespace {

/// The frame in which the robot begins to listen: the numbers begin again soon.
constexpr unsigned kHeard = 0xFFFFFFFE;

const std::vector<std::int16_t> kSixteenMilliseconds(512, 1000);  // two channels

class SoundTest : public Version2SessionFixture {
 public:
  /// Switches the microphones on. The robot sets something else than it was asked for.
  void listen(int channels = 2, int rate = 16000) {
    begin();
    wanted_.microphone = {true, 3 - channels, 24000 - rate};
    EXPECT_EQ("A 1 1 " + std::to_string(3 - channels) + (rate == 16000 ? " 31 64" : " 62 128"), request());
    agree(channels, rate);
  }

  void agree(int channels, int rate) {
    answer(encoded(
        version2::MicrophoneSettings{true, static_cast<unsigned char>(channels), static_cast<unsigned short>(rate)}));
  }

  /// A push `a` with this id.
  void pushSound(int id, const Bytes& payload) {
    Bytes frame = version2_frames::makeFrame('a', 0, payload);
    frame[1] = static_cast<std::uint8_t>(id);
    receive(frame);
  }

  /// The robot pushes what it has heard.
  void push(unsigned frame_number, const std::vector<std::int16_t>& samples, int channels = 2) {
    Bytes bytes(samples.size() * 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      protocol::encodeBigEndian16(static_cast<unsigned short>(samples[i]), &bytes[2 * i]);
    }
    const auto count = static_cast<unsigned short>(samples.size() / static_cast<unsigned>(channels));
    pushSound(1, encoded(version2::HeardSound{frame_number, count, static_cast<unsigned char>(channels), bytes.data(),
                                              bytes.size()}));
  }

  /// Sends the samples.
  std::future<Answer> send(const SoundPart& part) {
    auto answer = add(callToPlaySamples(part, std::vector<std::int16_t>(part.size)), milliseconds(2000));
    EXPECT_EQ("A 2", request(0));
    return answer;
  }

  /// Sends the samples, which the robot accepts.
  void play(const SoundPart& part) {
    send(part);
    answer(encoded(version2::SpeakerRoom{version2::SPEAKER_CAPACITY}));
  }

  void pushEnd(int how, unsigned samples, unsigned gaps = 0, unsigned missing = 0) {
    pushSound(2, encoded(version2::SoundEnd{static_cast<unsigned char>(how), samples, gaps, missing}));
  }

  /// The ends so far, such as "1 done, 2 lost".
  std::string ends() const {
    std::string text;
    for (const SoundEnd& end : sound_ends_) {
      text += (text.empty() ? "" : ", ") + std::to_string(end.sound) +
              std::vector<std::string>{" done", " replaced", " stopped",     " refused",
                                       " fell", " unknown",  " not reached", " lost"}
                  .at(static_cast<std::size_t>(end.how));
    }
    return text;
  }
};

TEST_F(SoundTest, TheMicrophonesAreAskedForOnlyWhenAndAsOftenAsThatIsWanted) {
  begin();
  EXPECT_EQ("", request()) << "nobody listens";
  const std::pair<MicrophoneSettings, std::string> rows[] = {
      {{false, 1, 8000, true}, "A 1 2 1 31 64"},  // for what is played
      {{true, 1, 8000, true}, "A 1 3 1 31 64"},     {{true, 1, 8000, false}, "A 1 1 1 31 64"},
      {{false, 2, 16000, false}, "A 1 0 2 62 128"}, {{false, 1, 8000, false}, ""},
      {{true, 2, 16000, false}, "A 1 1 2 62 128"},
  };
  for (const auto& [wanted, sent] : rows) {
    wanted_.microphone = wanted;
    EXPECT_EQ(sent, request());
    EXPECT_EQ("", request());
  }
  refuse("ALLOW_MICROPHONE is not set");
  expectRefusals({{RefusedRequest::kMicrophone, RefusalCause::kRobot, {}, "ALLOW_MICROPHONE is not set", 0}});
  EXPECT_EQ("", request()) << "it is not asked again";
}

TEST_F(SoundTest, WhatTheRobotHearsIsDeliveredWithItsFrame) {
  listen(2, 16000);
  push(kHeard, {1, -2, 32767, -32768});
  ASSERT_THAT(heard_, testing::SizeIs(1));
  EXPECT_EQ(kHeard, heard_[0].frame_number);
  EXPECT_EQ(3U, heard_[0].connection_number);
  EXPECT_EQ(now_, heard_[0].arrival);
  EXPECT_EQ(2, heard_[0].channels);
  EXPECT_EQ(16000, heard_[0].samples_per_second);
  EXPECT_THAT(heard_[0].samples, testing::ElementsAre(1, -2, 32767, -32768));
}

TEST(Sound, WhatIsMissingBetweenTwoPushesIsCounted) {
  struct NewSound : public SoundTest {
    void TestBody() override {}
  };
  for (const int samples_per_frame : {128, 64}) {
    NewSound robot;
    robot.listen(1, 125 * samples_per_frame);
    std::vector<unsigned> missing;
    for (const unsigned frame : {0, 2, 7, 9}) {
      robot.push(kHeard + frame, std::vector<std::int16_t>(static_cast<std::size_t>(2 * samples_per_frame)), 1);
      missing.push_back(robot.heard_.back().missing);
    }
    EXPECT_THAT(missing, testing::ElementsAre(0, 0, 3 * samples_per_frame, 0));
    EXPECT_EQ(1U, robot.counters_.sound_gaps);
    EXPECT_EQ(4U, robot.counters_.sounds);
  }
}

TEST_F(SoundTest, NothingIsMissingAfterAPause) {
  listen();
  push(kHeard, kSixteenMilliseconds);
  for (const bool on : {false, true}) {
    wanted_.microphone.on = on;
    request();
    answer(encoded(version2::MicrophoneSettings{on, 2, 16000}));
    live(std::chrono::seconds(10));
  }
  push(kHeard + 1000, kSixteenMilliseconds);
  EXPECT_EQ(0U, heard_.back().missing) << "nobody has listened";
}

TEST_F(SoundTest, SoundThatNobodyAskedForOrFromBeforeAChangeIsDropped) {
  begin();
  push(kHeard, kSixteenMilliseconds);
  wanted_.microphone = {true, 1, 16000};
  request();
  push(kHeard, kSixteenMilliseconds, 1);
  agree(1, 8000);  // the rate of a push is that of the settings, so one from before would be misunderstood
  push(kHeard + 2, kSixteenMilliseconds, 2);
  EXPECT_THAT(heard_, testing::IsEmpty());
  push(kHeard + 2, kSixteenMilliseconds, 1);
  ASSERT_THAT(heard_, testing::SizeIs(1));
  EXPECT_EQ(8000, heard_[0].samples_per_second);
}

TEST_F(SoundTest, MoreThanTwiceTheSoundThatWasAskedForIsDroppedAndLoggedOnce) {
  listen();
  for (unsigned i = 0; i < 1000; ++i) {
    push(kHeard + 2 * i, kSixteenMilliseconds);
    now_ += milliseconds(4);
  }
  EXPECT_GE(1000U / 2 + 64, heard_.size());
  EXPECT_LE(1000U / 2, heard_.size());
  EXPECT_EQ(1000U, heard_.size() + counters_.thinned_sounds);
  EXPECT_EQ(1, logged("more than twice as much sound"));
}

// Short pieces must not earn the right to send long ones.
TEST_F(SoundTest, NoMixtureOfPiecesIsMoreThanTwiceTheSoundThatWasAskedFor) {
  listen(1);
  const std::vector<std::int16_t> second(16000);
  std::size_t samples = 0;
  for (int i = 0; i < 10000; ++i) {
    push(kHeard, i % 10 == 9 ? second : std::vector<std::int16_t>(1), 1);
    now_ += std::chrono::microseconds(100);
  }
  for (const HeardSound& sound : heard_) {
    samples += sound.samples.size();
  }
  EXPECT_GE(3U * 16000, samples) << "in one second";
  EXPECT_GE(3U * 125, heard_.size()) << "deliveries";
}

// Users fill gaps with silence, and a robot can say anything.
TEST_F(SoundTest, NoMoreIsMissingThanTimeHasPassed) {
  listen();
  std::uint64_t missing = 0;
  for (unsigned i = 0; i < 1000; ++i) {
    push(i * (i % 2 == 0 ? 100 : 0x01000000), kSixteenMilliseconds);
    missing += heard_.back().missing;
    now_ += milliseconds(16);
  }
  EXPECT_GE(22U * 16000, missing) << "in 16 seconds";
}

TEST_F(SoundTest, TheEndOfASoundIsToldOnceWithTheRobotsCounts) {
  begin();
  play({1, 0, 2048, false});
  play({1, 2048, 1000, true});
  pushEnd(version2::END_DONE, 3048, 2, 512);
  ASSERT_EQ("1 done", ends());
  EXPECT_EQ(3048U, sound_ends_[0].samples);
  EXPECT_EQ(2U, sound_ends_[0].gaps);
  EXPECT_EQ(512U, sound_ends_[0].missing);
  pushEnd(version2::END_DONE, 3048);
  connection_.sound.connectionLost();
  EXPECT_EQ("1 done", ends());
}

// The robot pushes ends with its measurements, so the end of one sound may come after the answer for the next.
TEST_F(SoundTest, ALateEndOfTheSoundBeforeIsNotTakenForThatOfTheNewOne) {
  begin();
  play({1, 0, 500, true});
  play({2, 0, 600, true});
  EXPECT_EQ("1 replaced", ends());
  pushEnd(version2::END_DONE, 500);
  EXPECT_EQ("1 replaced", ends());
  pushEnd(version2::END_DONE, 600);
  EXPECT_EQ("1 replaced, 2 done", ends());
}

TEST_F(SoundTest, ASoundThatHasEndedDoesNotBeginAgainWithALateAnswer) {
  begin();
  play({1, 0, 500, false});
  auto late = send({1, 500, 1, false});
  const Frame late_request = frame_;
  play({0, 0, 0, true});
  EXPECT_EQ("1 stopped", ends());
  answer(late_request, encoded(version2::SpeakerRoom{100}));
  pushEnd(version2::END_STOPPED, 64);
  EXPECT_EQ("1 stopped", ends());
  play({2, 0, 500, false});
  const auto more = send({2, 500, 1, false});
  pushEnd(version2::END_REFUSED, 32500);
  answer(encoded(version2::SpeakerRoom{100}));
  EXPECT_TRUE(done(more));
  connection_.sound.connectionLost();
  EXPECT_EQ("1 stopped, 2 refused", ends());
}

/// The client's functions.
class SoundClientTest : public ClientFixture {
 protected:
  /// Each time, it is a sample more than before; at first, there are three.
  std::future<SoundProgress> play(std::uint64_t sound, bool is_last = false) {
    ++size_;
    return std::async(std::launch::async, [this, sound, is_last] {
      return client_.playSamples(sound, std::vector<std::int16_t>(size_, 7), is_last, test_support::kSafetyNet);
    });
  }

  /// Accepts samples.
  /// @return position of the first one, from the request
  static unsigned acceptSamples(ScriptedPeer* peer) {
    const version2_frames::Frame request = peer->readRequest();
    EXPECT_EQ('A', request.header.kind);
    Bytes reply = version2_frames::makeFrame('a', request.header.request_number, encoded(version2::SpeakerRoom{5000}));
    reply[1] = 2;
    peer->send(reply);
    return protocol::decodeBigEndian32(request.payload.data());
  }

  void expectOver(std::uint64_t sound) {
    EXPECT_THROW(client_.playSamples(sound, {1}, false, test_support::kSafetyNet), CommandException);
  }

  std::size_t size_ = 2;
};

TEST_F(SoundClientTest, TheClientCountsThePositionOfSamples) {
  ScriptedPeer peer = connectVersion2("F A");
  auto first = play(0);
  EXPECT_EQ(0U, acceptSamples(&peer));
  const SoundProgress progress = first.get();
  EXPECT_EQ(5000U, progress.room);
  for (const bool is_last : {false, true}) {
    auto next = play(progress.sound, is_last);
    EXPECT_EQ(is_last ? 3U + 4U : 3U, acceptSamples(&peer));
    EXPECT_EQ(progress.sound, next.get().sound);
  }
  expectOver(progress.sound);
}

TEST_F(SoundClientTest, ASoundThatWasReplacedOrStoppedCannotGoOn) {
  ScriptedPeer peer = connectVersion2("F A");
  auto first = play(0);
  acceptSamples(&peer);
  auto second = play(0);
  EXPECT_EQ(0U, acceptSamples(&peer));
  expectOver(first.get().sound);
  auto stop = std::async(std::launch::async, [this] { client_.stopSound(test_support::kSafetyNet); });
  EXPECT_EQ(0U, acceptSamples(&peer));
  stop.get();
  expectOver(second.get().sound);
}

TEST_F(SoundClientTest, ASoundIsLostWithItsConnection) {
  ScriptedPeer peer = connectVersion2("F A");
  auto first = play(0);
  acceptSamples(&peer);
  const std::uint64_t sound = first.get().sound;
  peer.reset();
  EXPECT_TRUE(eventually([&] { return recorder_.reports().sound_ends == std::to_string(sound) + " lost"; }));
  const ScriptedPeer next = connectVersion2("F A");
  expectOver(sound);
}

}  // namespace
