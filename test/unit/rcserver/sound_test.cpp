// Microphone and speaker (`A`). Level2 Reference Guide, pages 44, 62 and 63; Model Information ERS-7, 3.1.2 and 3.2.2.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "rcserver/Outbox.h"
#include "rcserver_fixture.h"
#include "support/udp_socket.h"

namespace {

using namespace protocol::version2;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;
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

template <typename Payload>
Payload payloadIn(const Frame& frame) {
  Payload payload{};
  EXPECT_EQ(decode(frame.payload.data(), frame.payload.size(), &payload), nullptr);
  return payload;
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
      in_each_frame_();
    }
  }

  // Plays a sound as a client does that keeps the robot's buffer full, and passes the time until it has ended.
  void playAll(const std::function<sword(size_t)>& sound, unsigned size) {
    unsigned sent = 0;
    unsigned room = SPEAKER_CAPACITY;
    while (sent < size) {
      const unsigned count = std::min({room, size - sent, 4000U});
      room = play(sent, samplesOf(sound, sent, sent + count), sent + count == size);
      sent += count;
      pass(room < 4000 ? 32 : 1);
    }
    pass(150);
  }

  Samples heardSince(sword first) const {
    const Samples& left = heard_.at(0);
    return Samples(std::find(left.begin(), left.end(), first), left.end());
  }

  std::map<unsigned, Samples> heard_;  // by channel
  unsigned heard_rate_ = kRate;
  unsigned first_frame_ = 0;
  size_t missing_ = 0;  // samples of each channel
  std::vector<SoundEnd> ends_;
  std::vector<Frame> replies_;
  std::function<void()> in_each_frame_ = [] {};
};

TEST_F(SoundTest, AToneIsTheSameAfterSpeakerAndMicrophone) {
  robot_.hears_itself = true;
  listen();
  pass(4);                                                        // until the next vector of the microphones begins
  const auto sound = [](size_t i) { return tone(1000, i + 4); };  // begins at its crest
  playAll(sound, 10 * kRate);
  Samples heard = heardSince(sound(0));
  ASSERT_GE(heard.size(), 10 * kRate);
  EXPECT_THAT(Samples(heard.begin() + 10 * kRate, heard.end()), Each(0));
  heard.resize(10 * kRate);
  EXPECT_EQ(heard, samplesOf(sound, 0, 10 * kRate));
  EXPECT_EQ(heard_[0], heard_[1]);
  EXPECT_EQ(missing_, 0U);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_EQ(ends_[0].samples, 10 * kRate);
  EXPECT_EQ(ends_[0].gaps, 0U);
}

TEST_F(SoundTest, WhatIsHeardHasTheFrameInWhichItWasHeard) {
  robot_.sound = [](size_t i) { return OSoundSampleStereo16{mark(i), static_cast<sword>(-mark(i))}; };
  listen();
  pass(20);
  EXPECT_GE(heard_[0].size(), 18 * SAMPLES_PER_FRAME);
  EXPECT_EQ(heard_[0],
            samplesOf(mark, first_frame_ * SAMPLES_PER_FRAME, first_frame_ * SAMPLES_PER_FRAME + heard_[0].size()));
  EXPECT_EQ(heard_[1][100], -heard_[0][100]) << "left and right";
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
        EXPECT_THAT(levelOf(heard), AllOf(Ge(lowest), Le(highest))) << frequency << " in channel " << channel;
        EXPECT_NEAR(static_cast<double>(heard.size()), 8000, 150);
      }
    }
  }
}

TEST_F(SoundTest, AtEightKilohertzTheChannelsStayApart) {
  robot_.sound = [](size_t) { return OSoundSampleStereo16{1000, -400}; };
  listen(2, 8000);
  pass(10);
  ASSERT_THAT(heard_, SizeIs(2));
  EXPECT_NEAR(heard_[0].back(), 1000, 10);
  EXPECT_NEAR(heard_[1].back(), -400, 10);
}

// The filter overshoots where the sound changes.
TEST_F(SoundTest, AtEightKilohertzTheLoudestSoundKeepsItsSign) {
  robot_.sound = [](size_t i) {
    const sword loudest = i / 80 % 2 == 0 ? 32767 : -32768;  // 100 Hz
    return OSoundSampleStereo16{loudest, loudest};
  };
  listen(1, 8000);
  pass(126);
  const Samples& heard = heard_[0];
  int changes = 0;
  for (size_t i = 1; i < heard.size(); ++i) {
    changes += (heard[i - 1] < 0) != (heard[i] < 0) ? 1 : 0;
  }
  EXPECT_NEAR(changes, static_cast<double>(heard.size()) / 40, 10);
  EXPECT_THAT(heard, SizeIs(Ge(7000U)));
}

TEST_F(SoundTest, OneChannelIsTheMeanOfBoth) {
  robot_.sound = [](size_t) { return OSoundSampleStereo16{1000, -400}; };
  listen(1);
  pass(10);
  EXPECT_THAT(heard_[0], Each(300));
  EXPECT_THAT(heard_[0], Not(IsEmpty()));
}

TEST_F(SoundTest, NothingIsHeardBeforeAndAfter) {
  pass(10);
  EXPECT_THAT(heard_, IsEmpty());
  listen();
  pass(10);
  EXPECT_EQ(ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{false, 1, 8000})).header.kind, 'a');
  heard_.clear();
  pass(10);
  EXPECT_THAT(heard_, IsEmpty());
}

// The filter for 8 kHz looks at the last samples, and there are none.
TEST_F(SoundTest, WhatWasHeardBeforeAPauseIsNotHeardAfterIt) {
  for (const unsigned char channels : {'\2', '\1', '\2'}) {
    const bool is_off = channels == 2 && heard_.empty();  // otherwise at the full rate, which needs no filter
    robot_.sound = [](size_t) { return OSoundSampleStereo16{20000, 20000}; };
    heard_.clear();
    listen(channels, 8000);
    pass(10);
    heard_.clear();
    heard_rate_ = kRate;
    ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{!is_off, channels, kRate}));
    robot_.sound = [](size_t) { return OSoundSampleStereo16{0, 0}; };
    pass(10);
    heard_.clear();
    listen(channels, 8000);
    pass(10);
    ASSERT_THAT(heard_[0], Not(IsEmpty()));
    EXPECT_THAT(heard_[0], Each(0)) << static_cast<int>(channels) << " channels";
  }
}

TEST_F(SoundTest, TheMicrophoneIsRefusedUnlessTheOwnerAllowsIt) {
  for (const char* settings : {"", "ALLOW_MICROPHONE=no\n"}) {
    startWith(settings);
    connectVersion2();
    expectRefusal(ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{true, 1, 8000})), CODE_REFUSED,
                  "ALLOW_MICROPHONE=yes in RCSERVER.CFG");
    pass(10);
    EXPECT_THAT(heard_, IsEmpty());
    EXPECT_EQ(play(0, samplesOf(mark, 0, 100), true), SPEAKER_CAPACITY - 0) << "the speaker needs no permission";
  }
}

TEST_F(SoundTest, TheOwnerMayForbidTheSpeaker) {
  startWith("ALLOW_SOUND=no\n");
  connectVersion2();
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, {1, 2}, true)), CODE_REFUSED, "ALLOW_SOUND=yes in RCSERVER.CFG");
  expectRefusal(ask(SOUND_VOLUME, payloadOf(Volume{3})), CODE_REFUSED, "ALLOW_SOUND=yes in RCSERVER.CFG");
  pass(10);
  EXPECT_THAT(robot_.played, IsEmpty());
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

TEST_F(SoundTest, ASoundEndsAlsoIfItsLastSamplesComeTooLate) {
  play(0, samplesOf(mark, 0, 2000));
  pass(60);  // 7680 samples
  play(2000, samplesOf(mark, 2000, 3000), true);
  pass(20);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_GT(ends_[0].samples, 3000U) << "with the silence";
  EXPECT_EQ(ends_[0].gaps, 1U);
  EXPECT_EQ(ends_[0].missing, ends_[0].samples - 2000);
}

// The server would fill days with silence, and do nothing else meanwhile.
TEST_F(SoundTest, SamplesThatAreFarAheadAreRefused) {
  const unsigned end = 16000;
  for (const unsigned ahead : {SPEAKER_CAPACITY, 1U << 30, (1U << 31) - SPEAKER_CAPACITY, (1U << 31) - 1}) {
    for (const unsigned size : {1U, SPEAKER_CAPACITY}) {
      play(0, samplesOf(mark, 0, end));
      expectRefusal(ask(SOUND_SPEAKER, playedPayload(end + ahead, Samples(size, 1))), CODE_REFUSED, "no room");
      EXPECT_EQ(play(0, {}), SPEAKER_CAPACITY - end + 2 * kVector) << ahead << " ahead, " << size;
      play(0, {}, true);
      pass(10);
    }
  }
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
  EXPECT_THAT(how, ElementsAre(END_REPLACED, END_DONE, END_STOPPED, END_REFUSED));
  EXPECT_THAT(ends_[2].samples, Le(2 * kVector));
  EXPECT_NEAR(ends_[3].missing, 2 * kRate, 2 * kVector) << "no sample came for two seconds";
  const size_t played = robot_.played.size();
  pass(20);
  EXPECT_EQ(robot_.played.size(), played);
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(4000, {1})), CODE_REFUSED, "no sound is being played");
}

// All samples of the first sound are in a vector that is being output.
TEST_F(SoundTest, ASoundThatReplacesTheEndOfAnotherIsPlayedToItsEnd) {
  play(0, samplesOf(mark, 0, 300), true);
  play(0, samplesOf(mark, 1000, 5000), true);
  pass(60);
  ASSERT_THAT(ends_, SizeIs(2));
  EXPECT_EQ(ends_[0].how, END_REPLACED);
  EXPECT_EQ(ends_[1].how, END_DONE);
  EXPECT_EQ(ends_[1].samples, 4000U);
  const Samples second(robot_.played.begin() + kVector, robot_.played.begin() + kVector + 4000);
  EXPECT_EQ(second, samplesOf(mark, 1000, 5000));
}

TEST_F(SoundTest, GapsOfOneSoundAreNotThoseOfTheNext) {
  play(0, samplesOf(mark, 0, 100));
  pass(30);
  play(0, samplesOf(mark, 0, 100), true);
  pass(30);
  ASSERT_THAT(ends_, SizeIs(2));
  EXPECT_EQ(ends_[0].gaps, 1U);
  EXPECT_EQ(ends_[1].gaps, 0U);
  EXPECT_EQ(ends_[1].missing, 0U);
}

TEST_F(SoundTest, EachOfTwoGapsCounts) {
  play(0, samplesOf(mark, 0, 1000));
  play(1500, samplesOf(mark, 1500, 2000));
  play(2500, samplesOf(mark, 2500, 3000), true);
  pass(40);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].gaps, 2U);
  EXPECT_EQ(ends_[0].missing, 1000U);
}

// The two seconds of silence that end a sound begin with each sample that comes.
TEST_F(SoundTest, ASoundThatStuttersIsNotEnded) {
  for (unsigned part = 0; part < 4; ++part) {
    const unsigned at = part * SPEAKER_CAPACITY;
    play(at, samplesOf(mark, at, at + 100), part == 3);
    pass(part == 3 ? 60 : 15000 / SAMPLES_PER_FRAME);
  }
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_EQ(ends_[0].gaps, 3U);
}

TEST_F(SoundTest, ARefusedRequestChangesNothing) {
  play(0, samplesOf(mark, 0, 3000));
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, Samples(SPEAKER_CAPACITY + 1, 7))), CODE_REFUSED, "no room");
  play(3000, samplesOf(mark, 3000, 4000));
  robot_.refuses_speaker = true;
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, {1, 2})), CODE_REFUSED, "speaker cannot be used");
  robot_.refuses_speaker = false;
  play(4000, {}, true);  // the last samples have come already
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(4000, {1})), CODE_REFUSED, "begins with the sample at position 0");
  pass(50);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_EQ(ends_[0].samples, 4000U);
  robot_.played.resize(4000);
  EXPECT_EQ(robot_.played, samplesOf(mark, 0, 4000));
}

TEST_F(SoundTest, AnEndForWhichThereIsNoRoomIsToldLater) {
  play(0, samplesOf(mark, 0, 1000), true);
  stallBehind("");
  passFrames(30);
  for (int i = 0; i < 100 && ends_.empty(); ++i) {
    pass(1);
  }
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
}

// The last answer for which there is room is that to the second sound.
TEST_F(SoundTest, TwoEndsForWhichThereIsNoRoomAreBothToldLater) {
  connectBehindAPicture();
  std::string bytes = frame('A', SOUND_SPEAKER, 76, playedPayload(0, samplesOf(mark, 0, 1000)));
  for (size_t i = 1; i < 3 * Outbox::MAX_REPLY_SIZE / 10; ++i) {
    bytes += frame('T', 0, 1, std::string(2, '\0'));  // is answered by 10 bytes
  }
  sendAll(bytes + frame('A', SOUND_SPEAKER, 77, playedPayload(0, samplesOf(mark, 0, 2000), true)));
  passFrames(40);
  for (int i = 0; i < 100 && ends_.size() < 2; ++i) {
    pass(1);
  }
  ASSERT_THAT(ends_, SizeIs(2));
  EXPECT_EQ(ends_[0].how, END_REPLACED);
  EXPECT_EQ(ends_[1].how, END_DONE);
  EXPECT_EQ(ends_[1].samples, 2000U);
}

// The microphones then send several vectors in one notification.
TEST_F(SoundTest, WhatIsHeardWhileTheRobotIsHeldUpIsComplete) {
  robot_.sound = [](size_t i) { return OSoundSampleStereo16{mark(i), mark(i)}; };
  listen();
  pass(4);
  clock_.step(8);
  pass(8);
  EXPECT_EQ(missing_, 0U);
  ASSERT_GE(heard_[0].size(), 16 * SAMPLES_PER_FRAME);
  const size_t begin = first_frame_ * SAMPLES_PER_FRAME;
  EXPECT_EQ(heard_[0], samplesOf(mark, begin, begin + heard_[0].size()));
}

// Sound of another kind that still waits would be taken for it.
TEST_F(SoundTest, AfterAChangeNothingComesThatWasHeardBefore) {
  disconnect();
  connectVersion2(2048);
  robot_.sound = [](size_t) { return OSoundSampleStereo16{1000, 1000}; };
  listen(1);
  passFrames(100);
  send(frame('A', SOUND_MICROPHONE, 7, payloadOf(MicrophoneSettings{false, 1, kRate})));
  bool is_off = false;
  for (int i = 0; i < 200; ++i) {
    machine_->runPending();
    while (const auto next = client_->nextFrame()) {
      EXPECT_FALSE(is_off && next->header.kind == SOUND_PUSH && next->header.id == SOUND_MICROPHONE);
      is_off = is_off || next->header.request_number == 7;
    }
  }
  EXPECT_TRUE(is_off);
}

TEST_F(SoundTest, WhatAClientDidNotReadIsNotHeardByTheNext) {
  disconnect();
  connectVersion2(2048);
  robot_.sound = [](size_t) { return OSoundSampleStereo16{1000, 1000}; };
  listen();
  passFrames(125);
  disconnect();
  connectVersion2();
  heard_.clear();
  pass(10);
  EXPECT_THAT(heard_, IsEmpty());
}

TEST_F(SoundTest, TheMicrophoneMayAlwaysBeSwitchedOff) {
  startWith("");
  connectVersion2();
  EXPECT_EQ(ask(SOUND_MICROPHONE, payloadOf(MicrophoneSettings{false, 2, kRate})).header.kind, 'a');
}

// Each takes a moment, and the robot serves its joints meanwhile.
TEST_F(SoundTest, TenThousandBeginsAndAThousandSwitchesLeaveAServerThatPlaysAndHears) {
  robot_.hears_itself = true;
  for (int i = 0; i < 10000; ++i) {
    send(frame('A', SOUND_SPEAKER, 1 + i % 1000, playedPayload(0, {1, 2, 3})) +
         (i % 10 == 0 ? frame('A', SOUND_MICROPHONE, 1, payloadOf(MicrophoneSettings{i % 20 == 0, 2, kRate})) : ""));
    while (client_->nextFrame()) {
    }
  }
  replies_.clear();
  play(0, {}, true);
  pass(20);
  ends_.clear();
  heard_.clear();
  missing_ = 0;
  listen();
  pass(4);  // until the next vector of the microphones begins
  playAll(mark, 3000);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  EXPECT_EQ(missing_, 0U);
  EXPECT_GE(heardSince(mark(0)).size(), 3000U);
}

TEST_F(SoundTest, AClientThatGoesFallsSilentAndTheNextOneBeginsAnew) {
  robot_.hears_itself = true;
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
  robot_.played.clear();
  pass(20);
  EXPECT_THAT(heard_, IsEmpty());
  EXPECT_THAT(ends_, IsEmpty());
  EXPECT_EQ(play(0, {}), SPEAKER_CAPACITY) << "a question";
  listen();
  const auto sound = [](size_t i) { return mark(i + 5000); };
  playAll(sound, kRate);
  EXPECT_EQ(Samples(robot_.played.begin(), robot_.played.begin() + kRate), samplesOf(sound, 0, kRate));
  EXPECT_EQ(missing_, 0U);
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].gaps, 0U);
}

TEST_F(SoundTest, AnEndThatAClientDidNotReadIsNotToldToTheNext) {
  play(0, samplesOf(mark, 0, 1000), true);
  stallBehind("");  // there is no room for the end
  passFrames(30);
  disconnect();
  connectVersion2();
  ends_.clear();
  pass(10);
  EXPECT_THAT(ends_, IsEmpty());
}

TEST_F(SoundTest, TheVolumeIsTheRobotsUntilAClientSetsOne) {
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, "")).step, 2);
  EXPECT_THAT(robot_.speaker_requests, IsEmpty()) << "reading leaves the speaker alone";
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

TEST_F(SoundTest, ASpeakerThatCannotBeUsedIsTold) {
  robot_.refuses_speaker = true;
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(0, {1, 2}, true)), CODE_REFUSED, "the robot's console says why");
  expectRefusal(ask(SOUND_VOLUME, payloadOf(Volume{1})), CODE_REFUSED, "does not take this volume");
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, "")).step, 2) << "that of the robot's switch, as before";
  EXPECT_THAT(console_.str(), ::testing::HasSubstr("the speaker does not take sound of 16 kHz"));
  robot_.refuses_speaker = false;
  playAll(mark, 1000);
  robot_.played.resize(1000);
  EXPECT_EQ(robot_.played, samplesOf(mark, 0, 1000));
  ASSERT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_[0].how, END_DONE);
  ask(SOUND_VOLUME, payloadOf(Volume{1}));
  robot_.refuses_speaker = true;
  reconnect();
  robot_.refuses_speaker = false;
  EXPECT_EQ(payloadIn<Volume>(ask(SOUND_VOLUME, "")).step, 2) << "not the last client's";
}

TEST_F(SoundTest, NonsenseIsRefused) {
  expectRefusal(ask(4, ""), CODE_REFUSED, "the id is not");
  expectRefusal(ask(SOUND_MICROPHONE, std::string("\1\3\x3e\x80", 4)), CODE_REFUSED, "one or two channels");
  expectRefusal(ask(SOUND_MICROPHONE, std::string("\1\1\x3e\x81", 4)), CODE_REFUSED, "neither 8000 nor 16000");
  expectRefusal(ask(SOUND_SPEAKER, std::string(9, '\0')), CODE_REFUSED, "half a sample");
  expectRefusal(ask(SOUND_VOLUME, "\4"), CODE_REFUSED, "0 to 3");
  expectRefusal(ask(SOUND_SPEAKER, playedPayload(100, {1})), CODE_REFUSED, "begins with the sample at position 0");
}

// While nothing can be sent, half a second of sound waits. What comes after that is lost, and the frame numbers tell.
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

TEST_F(SoundTest, PicturesWaitWhileTheSpeakerRunsShortIfTheClientWantsThat) {
  const auto pictures = [this](int steps = 25) {
    pass(25);
    begun_pictures_ = 0;
    pass(steps);
    return begun_pictures_;
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
  const test_support::UdpSocket receiver;
  answerTo('B', 0, payloadOf(DatagramPort{receiver.port()}));
  play(0, samplesOf(mark, 0, 4000));
  EXPECT_LE(pictures(100), 4) << "by UDP";
  EXPECT_TRUE(heard_.empty()) << "the microphones are closed";
  reconnect();
  answerTo('W', 85, kStreamOn);
  play(0, samplesOf(mark, 0, 4000));
  EXPECT_GT(pictures(), 4) << "the next client does not want that";
}

/// With the time that the robot's processor takes. Parameter: milliseconds that PictureEncoder needs for a picture.
class BusySoundTest : public SoundTest, public ::testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    handler_time_ = [](const std::string& object, openr_host::Entry entry, std::chrono::nanoseconds) {
      const bool encodes = object == "PictureEncoder" && entry == openr_host::Entry::kNotify;
      return milliseconds(encodes ? GetParam() : 0);
    };
    SoundTest::SetUp();
  }

  struct Counts {
    long pictures;
    long telemetry;
  };

  // Streams pictures and moves the head for two seconds.
  Counts measure() {
    std::vector<int>& path = robot_.joint("head_pan").path;
    send(frame('J', 0, kHeartbeat, std::string("\x07\xd0\1\0\2\0\0\0", 8) + std::string("\0\x07\xa1\x20", 4)));
    passFrames(12);
    path.clear();
    replies_.clear();
    pass(200);
    for (size_t i = 1; i < path.size(); ++i) {
      EXPECT_GT(path[i], path[i - 1]) << "the head stands still in frame " << i;
    }
    const auto count = [this](char kind) {
      return std::count_if(replies_.begin(), replies_.end(),
                           [kind](const Frame& reply) { return reply.header.kind == kind; });
    };
    const Counts counts{count('f'), count('t')};
    send(frame('J', 0, kHeartbeat, std::string("\0\0\1\0\2\0\0\0", 8) + std::string("\0\0\0\0", 4)));
    pass(200);
    return counts;
  }
};

TEST_P(BusySoundTest, BothWaysCostPicturesAndJointsNothing) {
  answerTo('T', 0, std::string("\0\4", 2));
  answerTo('W', 85, kStreamOn);
  pass(25);
  const Counts without = measure();
  robot_.hears_itself = true;
  listen(2, kRate, MICROPHONE_ON);
  unsigned sent = 8000;
  play(0, samplesOf(mark, 0, sent));
  in_each_frame_ = [this, &sent] {
    if (play(0, {}) > SPEAKER_CAPACITY / 2) {
      play(sent, samplesOf(mark, sent, sent + 4000));
      sent += 4000;
    }
  };
  const Counts with = measure();
  EXPECT_NEAR(static_cast<double>(with.pictures), static_cast<double>(without.pictures), 1);
  EXPECT_NEAR(static_cast<double>(with.telemetry), static_cast<double>(without.telemetry), 1);
  EXPECT_GE(without.pictures, 1600 / std::max(32, (GetParam() + 7) / 8 * 8) - 1);
  EXPECT_EQ(missing_, 0U);
  EXPECT_EQ(robot_.played, samplesOf(mark, 0, robot_.played.size())) << "without a gap";
  const Samples heard = heardSince(mark(0));
  EXPECT_EQ(heard, samplesOf(mark, 0, heard.size()));
  EXPECT_GT(heard.size(), 3 * kRate);
}

INSTANTIATE_TEST_SUITE_P(EncodeTimes, BusySoundTest, ::testing::Values(14, 40));

}  // namespace
