// Microphone and speaker (`A`). Level2 Reference Guide, pages 44, 62 and 63; Model Information ERS-7, 3.1.2 and 3.2.2.

#include <cmath>

#include "protocol/sound_requests.h"
#include "rcserver_fixture.h"

namespace {

using namespace protocol::version2;
using ::testing::SizeIs;

using Samples = std::vector<sword>;

constexpr unsigned kRate = 16000;
constexpr unsigned kVector = 512;  // 32 ms
constexpr int kHeartbeat = 60000;  // a request number
constexpr double kPi = 3.14159265358979;

sword tone(double frequency, size_t sample) {
  return static_cast<sword>(std::lround(10000 * std::sin(2 * kPi * frequency * static_cast<double>(sample) / kRate)));
}

// Never 0, so that silence can be told from it.
sword mark(size_t sample) {
  return static_cast<sword>(1 + sample % 30000);
}

Samples samplesOf(const std::function<sword(size_t)>& sound, size_t begin, size_t end) {
  Samples samples;
  for (size_t i = begin; i < end; ++i) {
    samples.push_back(sound(i));
  }
  return samples;
}

std::string playedPayload(unsigned position, const Samples& samples, bool last = false) {
  std::vector<unsigned char> bytes(2 * samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    protocol::encodeBigEndian16(static_cast<unsigned>(samples[i]), bytes.data() + 2 * i);
  }
  return payloadOf(PlayedSound{position, last, bytes.data(), bytes.size()});
}

class SoundTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    startWith("ALLOW_MICROPHONE=yes\n");
    connectVersion2();
  }

  // Takes in what has come: sound, ends and replies.
  void collect() {
    machine_->runPending();
    while (const auto frame = client_->nextFrame()) {
      if (frame->header.kind != SOUND_PUSH || frame->header.request_number != 0) {
        replies_.push_back(*frame);
      } else if (frame->header.id == SOUND_MICROPHONE) {
        take(payloadIn<HeardSound>(*frame));
      } else {
        ends_.push_back(payloadIn<SoundEnd>(*frame));
      }
    }
  }

  // What is missing by the frame numbers is filled with silence.
  void take(const HeardSound& sound) {
    samples_of_push_ = sound.samples_size / 2 / sound.channels;
    const unsigned per_frame = heard_rate_ * 8 / 1000;
    if (heard_.empty()) {
      first_frame_ = sound.frame_number;
    }
    EXPECT_EQ(heard_[0].size() % per_frame, 0U);
    const size_t begin = size_t{sound.frame_number - first_frame_} * per_frame;
    EXPECT_GE(begin, heard_[0].size()) << "heard twice";
    for (unsigned channel = 0; channel < sound.channels; ++channel) {
      Samples& heard = heard_[channel];
      missing_ += channel == 0 ? begin - heard.size() : 0;
      heard.resize(begin);
      for (unsigned i = channel; i < sound.samples_size / 2; i += sound.channels) {
        heard.push_back(protocol::decodeBigEndianSigned16(sound.samples + 2 * i));
      }
    }
  }

  Frame ask(int id, const std::string& payload) {
    const int number = ++last_number_;
    send(frame('A', id, number, payload));
    collect();
    const auto reply = std::find_if(replies_.begin(), replies_.end(), [number](const Frame& candidate) {
      return candidate.header.request_number == number;
    });
    EXPECT_NE(reply, replies_.end());
    return reply == replies_.end() ? Frame() : *reply;
  }

  void listen(unsigned char channels = 2, unsigned short rate = kRate, int mode = MICROPHONE_ON | SOUND_FIRST) {
    const MicrophoneSettings settings = {static_cast<unsigned char>(mode), channels, rate};
    const Frame reply = ask(SOUND_MICROPHONE, payloadOf(settings));
    ASSERT_EQ(reply.header.kind, 'a');
    EXPECT_EQ(payloadIn<MicrophoneSettings>(reply).channels, channels);
    heard_rate_ = rate;
  }

  // How many samples may follow.
  unsigned play(unsigned position, const Samples& samples, bool last = false) {
    const Frame reply = ask(SOUND_SPEAKER, playedPayload(position, samples, last));
    EXPECT_EQ(reply.header.kind, 'a');
    return payloadIn<SpeakerRoom>(reply).samples;
  }

  void pass(unsigned frames) {
    for (unsigned i = 0; i < frames; ++i) {
      passFrames(1);
      if (i % 100 == 0) {
        send(frame('H', 0, kHeartbeat));
      }
      collect();
    }
  }

  std::map<unsigned, Samples> heard_;  // by channel
  unsigned heard_rate_ = kRate;
  unsigned first_frame_ = 0;
  size_t samples_of_push_ = 0;  // of each channel of the last one
  size_t missing_ = 0;          // samples of each channel
  std::vector<SoundEnd> ends_;
  std::vector<Frame> replies_;
};

TEST_F(SoundTest, WhatIsHeardHasTheFrameInWhichItWasHeard) {
  robot_.sound = [](size_t i) { return OSoundSampleStereo16{mark(i), static_cast<sword>(-mark(i))}; };
  listen();
  pass(20);
  EXPECT_GE(heard_[0].size(), 18 * SAMPLES_PER_FRAME);
  EXPECT_EQ(heard_[0],
            samplesOf(mark, first_frame_ * SAMPLES_PER_FRAME, first_frame_ * SAMPLES_PER_FRAME + heard_[0].size()));
  EXPECT_EQ(heard_[1][100], -heard_[0][100]) << "left and right";
  EXPECT_EQ(samples_of_push_, 256U) << "16 ms";
}

// The level of a tone in what is heard, as a part of its level in the room, in dB.
double levelOf(const Samples& heard) {
  double square = 0;
  for (size_t i = 400; i < heard.size(); ++i) {
    square += 1.0 * heard[i] * heard[i];
  }
  return 10 * std::log10(1e-9 + square / static_cast<double>(heard.size() - 400) / (0.5 * 1e8));
}

TEST_F(SoundTest, AtEightKilohertzHighTonesDoNotComeBackAsLowOnes) {
  for (const auto& [frequency, lowest, highest] :
       {std::tuple{1000, -0.1, 0.1}, {3000, -0.3, 0.1}, {5000, -99.0, -40.0}, {7000, -99.0, -60.0}}) {
    robot_.sound = [hertz = frequency](size_t i) { return OSoundSampleStereo16{tone(hertz, i), tone(hertz, i)}; };
    for (const unsigned char channels : {'\1', '\2'}) {
      heard_.clear();
      listen(channels, 8000);
      pass(126);
      EXPECT_THAT(heard_, SizeIs(channels));
      for (const auto& [channel, heard] : heard_) {
        EXPECT_THAT(levelOf(heard), testing::AllOf(testing::Ge(lowest), testing::Le(highest)))
            << frequency << " in channel " << channel;
        EXPECT_NEAR(static_cast<double>(heard.size()), 8000, 150);
      }
    }
  }
}

TEST_F(SoundTest, OneChannelIsTheMeanOfBoth) {
  robot_.sound = [](size_t) { return OSoundSampleStereo16{1000, -400}; };
  listen(1);
  pass(10);
  EXPECT_THAT(heard_[0], testing::Each(300));
  EXPECT_THAT(heard_[0], testing::Not(testing::IsEmpty()));
}

TEST_F(SoundTest, TheReplyTellsHowMuchMayFollow) {
  EXPECT_EQ(play(0, {}), SPEAKER_CAPACITY) << "a question";
  const unsigned at_once = 2 * kVector;  // the robot takes two vectors at first
  EXPECT_EQ(play(0, samplesOf(mark, 0, 10000)), SPEAKER_CAPACITY - 10000 + at_once);
  EXPECT_EQ(play(10000, samplesOf(mark, 10000, 10000 + SPEAKER_CAPACITY - 10000 + at_once)), 0U);
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(SPEAKER_CAPACITY + at_once, {1})), CODE_REFUSED, "no room");
  pass(5);
  EXPECT_EQ(play(0, {}), kVector) << "32 ms later";
  EXPECT_EQ(play(SPEAKER_CAPACITY + at_once,
                 samplesOf(mark, SPEAKER_CAPACITY + at_once, SPEAKER_CAPACITY + 3 * kVector), true),
            0U);
  pass(160);
  EXPECT_EQ(robot_.played, samplesOf(mark, 0, SPEAKER_CAPACITY + 3 * kVector));
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
}

TEST_F(SoundTest, WhatComesTooLateIsSilenceAndTheRestStaysInTime) {
  play(0, samplesOf(mark, 0, 2000));
  pass(30);  // 3840 samples
  const size_t played = robot_.played.size();
  play(2000, samplesOf(mark, 2000, 8000), true);
  pass(60);
  Samples expected = samplesOf(mark, 0, 8000);
  ASSERT_GT(played, 3000U);
  for (size_t i = 2000; i < expected.size() && robot_.played.at(i) == 0; ++i) {
    expected[i] = 0;
  }
  robot_.played.resize(8000);
  EXPECT_EQ(robot_.played, expected);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].samples, 8000U);
  EXPECT_EQ(ends_[0].gaps, 1U);
  EXPECT_EQ(ends_[0].missing, static_cast<unsigned>(std::count(expected.begin(), expected.end(), 0)));
  EXPECT_NEAR(ends_[0].missing, 30 * SAMPLES_PER_FRAME - 2000, 3 * kVector);
}

TEST_F(SoundTest, WhatIsLeftOutIsSilence) {
  play(0, samplesOf(mark, 0, 3000));
  play(3500, samplesOf(mark, 3500, 5000));
  play(4000, samplesOf(mark, 4000, 6000), true);  // some of it a second time
  pass(60);
  Samples expected = samplesOf(mark, 0, 6000);
  std::fill(expected.begin() + 3000, expected.begin() + 3500, sword{0});
  robot_.played.resize(6000);
  EXPECT_EQ(robot_.played, expected);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].gaps, 1U);
  EXPECT_EQ(ends_[0].missing, 500U);
}

TEST_F(SoundTest, EachSoundEndsOnceInAWayThatIsTold) {
  play(0, samplesOf(mark, 0, 4000));
  play(0, samplesOf([](size_t i) { return tone(1000, i); }, 0, 4000), true);
  pass(40);
  play(0, samplesOf(mark, 0, 4000), true);
  EXPECT_EQ(play(0, {}, true), SPEAKER_CAPACITY) << "what was stopped takes no room";
  pass(2);
  play(0, samplesOf(mark, 0, 4000));
  pass(300);
  std::vector<int> how;
  for (const SoundEnd& end : ends_) {
    how.push_back(end.how);
  }
  EXPECT_THAT(how, testing::ElementsAre(END_REPLACED, END_DONE, END_STOPPED, END_REFUSED));
  EXPECT_THAT(ends_[2].samples, testing::Le(2 * kVector));
  EXPECT_NEAR(ends_[3].missing, 2 * kRate, 2 * kVector) << "no sample came for two seconds";
  const size_t played = robot_.played.size();
  pass(20);
  EXPECT_EQ(robot_.played.size(), played);
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(4000, {1})), CODE_REFUSED, "no sound is being played");
}

// An attack of docs/security.md.
TEST_F(SoundTest, PlaysAndHearsAsEverAfterTenThousandBeginnings) {
  std::string begin;
  std::string switches;
  for (int i = 0; i < 100; ++i) {
    const MicrophoneSettings settings = {static_cast<unsigned char>(i % 2), 2, kRate};
    begin += frame('A', SOUND_SPEAKER, kHeartbeat, playedPayload(0, {1}));
    switches += frame('A', SOUND_MICROPHONE, kHeartbeat, payloadOf(settings));
  }
  for (int i = 0; i < 110; ++i) {
    replies_.clear();
    sendAll(i < 100 ? begin : switches);
    EXPECT_TRUE(machine_->runUntil([this] {
      collect();
      return replies_.size() == 100;
    }));
  }
  heard_.clear();
  robot_.played.clear();
  listen();
  play(0, samplesOf(mark, 0, 4000), true);
  pass(50);
  ASSERT_GE(ends_.size(), 10000U) << "each begin replaces the sound before";
  EXPECT_EQ(ends_.back().how, END_DONE);
  EXPECT_EQ(ends_.back().samples, 4000U);
  EXPECT_GE(heard_[0].size(), 40 * SAMPLES_PER_FRAME);
}

TEST_F(SoundTest, ARefusedRequestChangesNothing) {
  play(0, samplesOf(mark, 0, 3000));
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, Samples(SPEAKER_CAPACITY + 1, 7))), CODE_REFUSED, "no room");
  // Far ahead: the server would fill days with silence, and do nothing else meanwhile.
  for (const unsigned ahead : {SPEAKER_CAPACITY, 1U << 30, (1U << 31) - SPEAKER_CAPACITY, (1U << 31) - 1}) {
    expectRefusal(ask(SOUND_SPEAKER, playedPayload(3000 + ahead, {1})), CODE_REFUSED, "no room");
  }
  robot_.refuses_speaker = true;
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, {1, 2})), CODE_REFUSED, "the robot's console says why");
  expectRefusal(ask(SOUND_VOLUME, payloadOf(Volume{1})), CODE_REFUSED, "does not take this volume");
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, "")).step, 2);
  robot_.refuses_speaker = false;
  play(3000, samplesOf(mark, 3000, 4000), true);
  pass(50);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_EQ(ends_[0].samples, 4000U);
  robot_.played.resize(4000);
  EXPECT_EQ(robot_.played, samplesOf(mark, 0, 4000));
}

TEST_F(SoundTest, TheMicrophoneMayAlwaysBeSwitchedOff) {
  startWith("");
  connectVersion2();
  EXPECT_EQ(ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{false, 2, kRate})).header.kind, 'a');
}

TEST_F(SoundTest, AClientThatGoesFallsSilentAndTheNextOneBeginsAnew) {
  listen();
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, payloadOf(Volume{1}))).step, 1);
  play(0, samplesOf(mark, 0, 16000));
  pass(4);
  disconnect();
  const size_t played = robot_.played.size();
  passFrames(50);
  EXPECT_LE(robot_.played.size(), played + 2 * kVector);
  EXPECT_EQ(robot_.speaker_requests.at(oprmreqSPEAKER_SET_VOLUME), ospkvol18dB) << "as the robot's switch says";

  connectVersion2();
  heard_.clear();
  ends_.clear();
  pass(20);
  EXPECT_THAT(heard_, testing::IsEmpty());
  EXPECT_THAT(ends_, testing::IsEmpty());
  EXPECT_EQ(play(0, {}), SPEAKER_CAPACITY) << "a question";
}

TEST_F(SoundTest, TheVolumeIsTheRobotsUntilAClientSetsOne) {
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, "")).step, 2);
  EXPECT_THAT(robot_.speaker_requests, testing::IsEmpty()) << "reading leaves the speaker alone";
  const std::map<int, longword> volumes = {{0, ospkvolinfdB}, {1, ospkvol25dB}, {2, ospkvol18dB}, {3, ospkvol10dB}};
  for (const auto& [step, volume] : volumes) {
    EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, payloadOf(Volume{static_cast<unsigned char>(step)}))).step, step);
    EXPECT_EQ(robot_.speaker_requests.at(oprmreqSPEAKER_SET_VOLUME), volume);
    EXPECT_EQ(robot_.speaker_requests.count(oprmreqSPEAKER_MUTE_ON), step == 0 ? 1 : 0);
    EXPECT_EQ(robot_.speaker_requests.count(oprmreqSPEAKER_MUTE_OFF), step == 0 ? 0 : 1);
    robot_.speaker_requests.clear();
  }
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, payloadOf(Volume{VOLUME_OF_ROBOT}))).step, 2);
  robot_.volume_switch = ovolumeSW3;
  play(0, samplesOf(mark, 0, 100), true);
  EXPECT_EQ(robot_.speaker_requests.at(oprmreqSPEAKER_SET_VOLUME), ospkvol10dB) << "its switch was moved";
}

// While nothing can be sent, half a second of sound waits. Sound that comes after that is lost, and the frame numbers
// show it.
TEST_F(SoundTest, AClientThatReadsLateMissesSoundAndTheRestIsInTime) {
  disconnect();
  connectVersion2(2048);
  robot_.sound = [](size_t i) { return OSoundSampleStereo16{mark(i), mark(i)}; };
  listen();
  for (int i = 0; i < 4; ++i) {
    passFrames(125);
    send(frame('H', 0, kHeartbeat));
  }
  for (int i = 0; i < 125; ++i) {
    pass(1);
  }
  EXPECT_GT(missing_, kRate);
  for (size_t i = 0; i < heard_[0].size(); ++i) {
    const sword expected = mark(first_frame_ * SAMPLES_PER_FRAME + i);
    ASSERT_TRUE(heard_[0][i] == expected || heard_[0][i] == 0) << i;
  }
}

TEST_F(SoundTest, PicturesWaitForWhatWasHeardIfTheClientWantsThat) {
  for (const auto& [mode, first] : {std::pair<int, char>{MICROPHONE_ON, 'f'}, {MICROPHONE_ON | SOUND_FIRST, 'a'}}) {
    disconnect();
    connectVersion2(2048);
    listen(2, kRate, mode);
    send(frame('F', 20, 1, kLayerHigh));
    takeImage();
    collect();  // the last picture is not long ago
    send(frame('F', 20, 2, kLayerHigh));
    for (size_t sent = 0; sent < sends_.size();) {  // no send ends any more when all buffers are full
      sent = sends_.size();
      for (int i = 0; i < 100; ++i) {
        send(frame('H', 0, kHeartbeat));
      }
    }
    takeImage();
    std::optional<Frame> next = nextFrame();
    while (next && next->header.kind == 'h') {
      next = nextFrame();
    }
    ASSERT_TRUE(next);
    EXPECT_EQ(next->header.kind, first);
  }
}

TEST_F(SoundTest, PicturesWaitWhileTheSpeakerRunsShortIfTheClientWantsThat) {
  const auto pictures = [this](int steps = 25) {
    pass(25);
    replies_.clear();
    pass(steps);
    return std::count_if(replies_.begin(), replies_.end(), [](const Frame& reply) { return reply.header.kind == 'f'; });
  };
  answerTo('W', 85, kStreamOn);
  play(0, samplesOf(mark, 0, 4000));
  EXPECT_GT(pictures(), 4) << "sound waits for pictures unless the client wants the opposite";
  ASSERT_EQ(ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{SOUND_FIRST, 2, kRate})).header.kind, 'a');
  play(0, samplesOf(mark, 0, 4000));
  EXPECT_LE(pictures(), 1) << "one in 0.25 s";
  EXPECT_GE(pictures(100), 3) << "a client that gets none takes the connection for dead";
  play(0, samplesOf(mark, 0, SPEAKER_CAPACITY));
  EXPECT_GT(pictures(), 4) << "enough waits for the speaker";
  play(0, samplesOf(mark, 0, 4000), true);
  EXPECT_GT(pictures(), 4) << "no more is to come";
}

}  // namespace
