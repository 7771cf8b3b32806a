// Sound: what the client asks for, what it believes, and what it sends.
#include <gmock/gmock.h>

#include <future>
#include <string>
#include <utility>
#include <vector>

#include "client/fault.h"
#include "client/version2_session.h"
#include "newest_client_fixture.h"
#include "protocol/sound_requests.h"
#include "session_fixture.h"
#include "support/version2_frames.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using version2_frames::Frame;

namespace version2 = protocol::version2;

namespace {

constexpr milliseconds kTimeout{20000};

/// The frame in which the robot begins to listen: the numbers begin again soon.
constexpr unsigned kHeard = 0xFFFFFFFE;

/// A reply or a push `a`.
Bytes makeSoundFrame(int id, int number, const Bytes& payload) {
  Bytes frame = version2_frames::makeFrame('a', number, payload);
  frame[1] = static_cast<std::uint8_t>(id);
  return frame;
}

class SoundTest : public SessionFixture {
 protected:
  SoundTest() : SessionFixture(true) {}

  Session& session() override { return session_; }

  void begin(const std::string& capabilities = "H F W A") {
    EXPECT_EQ("H 0", request());
    receive(version2_frames::makeFrame('h', number_, version2_frames::makeHello(capabilities)));
  }

  /// What the session sends now: kind, id and the beginning of the payload.
  std::string request() {
    const Bytes bytes = session_.nextRequest(wish_, now_);
    if (bytes.empty()) {
      return "";
    }
    const Frame frame = version2_frames::split(bytes);
    number_ = frame.header.request_number;
    return version2_frames::textOf(frame, 12);
  }

  /// Has the microphones switched on. The robot does something else than it was asked for.
  void listen(int channels = 2, int rate = 16000) {
    begin();
    wish_.microphone = {true, 3 - channels, 24000 - rate};
    EXPECT_EQ("A 1 1 " + std::to_string(3 - channels) + (rate == 16000 ? " 31 64" : " 62 128"), request());
    agree(channels, rate);
  }

  void agree(int channels, int rate) {
    const version2::MicrophoneSettings settings = {true, static_cast<unsigned char>(channels),
                                                   static_cast<unsigned short>(rate)};
    receive(makeSoundFrame(1, number_, encoded(settings)));
  }

  /// The robot pushes what it has heard.
  void push(unsigned frame_number, const std::vector<std::int16_t>& samples, int channels = 2) {
    Bytes bytes(samples.size() * 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      protocol::encodeBigEndian16(static_cast<unsigned short>(samples[i]), &bytes[2 * i]);
    }
    const auto count = static_cast<unsigned short>(samples.size() / static_cast<unsigned>(channels));
    receive(makeSoundFrame(1, 0,
                           encoded(version2::HeardSound{frame_number, count, static_cast<unsigned char>(channels),
                                                        bytes.data(), bytes.size()})));
  }

  /// Sends the samples, which the robot accepts.
  void play(const SoundPart& part) {
    auto answer = add(callToPlaySamples(part, std::vector<std::int16_t>(part.size, 7)), milliseconds(2000));
    EXPECT_THAT(request(), testing::StartsWith("A 2 "));
    receive(makeSoundFrame(2, number_, encoded(version2::SpeakerRoom{version2::SPEAKER_CAPACITY + 1})));
    ASSERT_TRUE(done(answer));
    const SoundProgress progress = answer.get().sound;
    EXPECT_EQ(part.sound, progress.sound);
    EXPECT_EQ(version2::SPEAKER_CAPACITY, progress.room) << "no robot has more";
  }

  void pushEnd(int how, unsigned samples, unsigned gaps = 0, unsigned missing = 0) {
    receive(makeSoundFrame(2, 0, encoded(version2::SoundEnd{static_cast<unsigned char>(how), samples, gaps, missing})));
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

  int number_ = 0;  // of the request that was sent last
  Version2Session session_{connection_, now_};
};

const std::vector<std::int16_t> kSixteenMilliseconds(512, 1000);  // two channels

TEST_F(SoundTest, TheMicrophonesAreAskedForOnlyWhenAndAsOftenAsThatIsWanted) {
  begin();
  EXPECT_EQ("", request()) << "nobody listens";
  wish_.microphone = {true, 1, 8000};
  EXPECT_EQ("A 1 1 1 31 64", request());
  EXPECT_EQ("", request());
  wish_.microphone.channels = 2;
  EXPECT_EQ("A 1 1 2 31 64", request());
  wish_.microphone.on = false;
  EXPECT_EQ("A 1 0 2 31 64", request());
  wish_.microphone.channels = 1;
  EXPECT_EQ("", request());
}

TEST_F(SoundTest, TheRobotIsToldThatSoundGoesBeforePicturesEvenIfNobodyListens) {
  begin();
  wish_.microphone.before_pictures = true;
  EXPECT_EQ("A 1 2 2 62 128", request());
  EXPECT_EQ("", request());
  wish_.microphone.on = true;
  EXPECT_EQ("A 1 3 2 62 128", request());
  wish_.microphone.before_pictures = false;
  EXPECT_EQ("A 1 1 2 62 128", request());
}

TEST_F(SoundTest, AServerWithoutSoundIsNotAskedForIt) {
  begin("H F W");
  wish_.microphone.on = true;
  EXPECT_EQ("", request());
  EXPECT_EQ("", request());
  EXPECT_EQ(1, logged("for its microphones: nothing is heard"));
}

TEST_F(SoundTest, ARefusalToListenIsReportedAndTheRequestIsNotRepeated) {
  begin();
  wish_.microphone.on = true;
  EXPECT_EQ("A 1 1 2 62 128", request());
  receive(version2_frames::makeFrame('e', number_, version2_frames::makeError(3, "ALLOW_MICROPHONE is not set")));
  ASSERT_THAT(refusals_, SizeIs(1));
  EXPECT_EQ(RefusedRequest::kMicrophone, refusals_[0].request);
  EXPECT_EQ("ALLOW_MICROPHONE is not set", refusals_[0].reason);
  EXPECT_EQ("", request());
}

TEST_F(SoundTest, WhatTheRobotHearsIsDeliveredWithItsFrame) {
  listen();
  push(kHeard, {1, -2, 32767, -32768});
  ASSERT_THAT(heard_, SizeIs(1));
  EXPECT_EQ(kHeard, heard_[0].frame_number);
  EXPECT_EQ(3U, heard_[0].connection_number);
  EXPECT_EQ(now_, heard_[0].arrival);
  EXPECT_EQ(2, heard_[0].channels);
  EXPECT_EQ(16000, heard_[0].samples_per_second);
  EXPECT_THAT(heard_[0].samples, ElementsAre(1, -2, 32767, -32768));
}

TEST_F(SoundTest, WhatIsMissingBetweenTwoPushesIsCounted) {
  listen();
  push(kHeard, kSixteenMilliseconds);
  push(kHeard + 2, kSixteenMilliseconds);
  push(kHeard + 7, kSixteenMilliseconds);
  push(kHeard + 9, kSixteenMilliseconds);
  std::vector<unsigned> missing;
  for (const HeardSound& sound : heard_) {
    missing.push_back(sound.missing);
  }
  EXPECT_THAT(missing, ElementsAre(0, 0, 3 * 128, 0));
  EXPECT_EQ(1U, counters_.sound_gaps);
  EXPECT_EQ(4U, counters_.sounds);
}

TEST_F(SoundTest, AtHalfTheRateAFrameHasHalfTheSamples) {
  listen(1, 8000);
  push(kHeard, std::vector<std::int16_t>(128), 1);
  push(kHeard + 2, std::vector<std::int16_t>(128), 1);
  push(kHeard + 6, std::vector<std::int16_t>(128), 1);
  EXPECT_EQ(0U, heard_.at(1).missing);
  EXPECT_EQ(2U * 64, heard_.at(2).missing);
}

TEST_F(SoundTest, PiecesThatAreNoWholeFramesHaveNoGaps) {
  listen(1);
  push(kHeard, std::vector<std::int16_t>(100), 1);
  push(kHeard, std::vector<std::int16_t>(100), 1);  // begins within the same frame
  push(kHeard + 1, std::vector<std::int16_t>(56), 1);
  push(kHeard + 2, std::vector<std::int16_t>(56), 1);
  EXPECT_EQ(0U, counters_.sound_gaps);
}

// The rate of a push is that of the settings, so one from before a change would be misunderstood.
TEST_F(SoundTest, AfterAGapWithinAFrameTheNextOneIsCountedAsEver) {
  listen(1);
  push(kHeard, std::vector<std::int16_t>(100), 1);
  push(kHeard + 5, std::vector<std::int16_t>(28), 1);
  push(kHeard + 5, std::vector<std::int16_t>(100), 1);
  push(kHeard + 7, std::vector<std::int16_t>(128), 1);
  EXPECT_EQ(5U * 128 - 100, heard_.at(1).missing) << "a part of the first frame was heard";
  EXPECT_EQ(128U, heard_.at(3).missing);
}

TEST_F(SoundTest, OfTwoChangesTheAnswerToTheSecondCounts) {
  begin();
  wish_.microphone = {true, 1, 16000};
  EXPECT_EQ("A 1 1 1 62 128", request());
  const int first = number_;
  wish_.microphone.samples_per_second = 8000;
  EXPECT_EQ("A 1 1 1 31 64", request());
  const int second = std::exchange(number_, first);
  agree(1, 16000);
  push(kHeard, std::vector<std::int16_t>(256), 1);
  EXPECT_THAT(heard_, IsEmpty());
  number_ = second;
  agree(1, 8000);
  push(kHeard + 2, std::vector<std::int16_t>(128), 1);
  ASSERT_THAT(heard_, SizeIs(1));
  EXPECT_EQ(8000, heard_[0].samples_per_second);
}

TEST_F(SoundTest, SoundFromBeforeAChangeIsDropped) {
  listen(2);
  wish_.microphone.samples_per_second = 16000;
  EXPECT_EQ("A 1 1 1 62 128", request());
  push(kHeard, kSixteenMilliseconds);
  EXPECT_THAT(heard_, IsEmpty());
  agree(2, 8000);
  push(kHeard + 2, kSixteenMilliseconds);
  ASSERT_THAT(heard_, SizeIs(1));
  EXPECT_EQ(8000, heard_[0].samples_per_second);
}

TEST_F(SoundTest, AfterAPauseGapsAreCountedAsBefore) {
  listen();
  for (unsigned i = 0; i < 400; ++i) {
    push(kHeard + 2 * i, kSixteenMilliseconds);
    now_ += milliseconds(16);
  }
  begin();  // the check of the link
  wish_.microphone.on = false;
  request();
  receive(makeSoundFrame(1, number_, encoded(version2::MicrophoneSettings{false, 2, 16000})));
  wish_.microphone.on = true;
  request();
  agree(2, 16000);
  push(kHeard + 1000, kSixteenMilliseconds);
  EXPECT_EQ(0U, heard_.back().missing) << "nobody has listened";
  now_ += milliseconds(24);
  push(kHeard + 1003, kSixteenMilliseconds);
  EXPECT_EQ(128U, heard_.back().missing);
}

TEST_F(SoundTest, SoundThatNobodyAskedForIsDropped) {
  begin();
  push(kHeard, kSixteenMilliseconds);
  wish_.microphone = {true, 1, 16000};
  request();
  agree(1, 16000);
  push(kHeard + 2, kSixteenMilliseconds, 2);
  EXPECT_THAT(heard_, IsEmpty());
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
  now_ += seconds(3600);
  const unsigned frame = heard_.back().frame_number + 2;
  push(frame, kSixteenMilliseconds);
  push(frame + 3600 * 125, kSixteenMilliseconds);
  EXPECT_EQ((3600 * 125 - 2) * 128U, heard_.back().missing) << "an hour without sound";
  push(frame + 7200 * 125, kSixteenMilliseconds);
  EXPECT_EQ(0U, heard_.back().missing) << "the same hour";
}

TEST_F(SoundTest, WhatWasHeardIsNotMissingToo) {
  listen();
  for (unsigned i = 0; i < 625; ++i) {
    push(kHeard + 2 * i, kSixteenMilliseconds);
    now_ += milliseconds(16);
  }
  push(kHeard + 1250 + 1000, kSixteenMilliseconds);
  EXPECT_EQ(0U, heard_.back().missing) << "18 s of sound cannot come in 10 s";
}

TEST_F(SoundTest, NothingIsMissingIfAPushComesTwice) {
  listen();
  push(kHeard, kSixteenMilliseconds);
  push(kHeard, kSixteenMilliseconds);
  EXPECT_EQ(0U, heard_.back().missing);
}

TEST_F(SoundTest, APushOfMoreThanASecondIsDropped) {
  listen(1);
  push(kHeard, std::vector<std::int16_t>(16001), 1);
  EXPECT_THAT(heard_, IsEmpty());
}

TEST_F(SoundTest, APushThatContradictsItselfIsNoSound) {
  listen();
  Bytes payload = encoded(version2::HeardSound{kHeard, 0, 2, nullptr, 0});
  payload.push_back(1);
  EXPECT_THROW(receive(makeSoundFrame(1, 0, payload)), ProtocolException);
}

TEST_F(SoundTest, SamplesAreSentAtTheirPlaceInTheSound) {
  begin();
  auto answer = add(callToPlaySamples({7, 0x01020304, 2, true}, {0x1234, -1}), milliseconds(2000));
  EXPECT_EQ("A 2 1 2 3 4 1 0 0 0 18 52 255 255", request());
  receive(makeSoundFrame(2, number_, encoded(version2::SpeakerRoom{8192})));
  EXPECT_EQ(8192U, answer.get().sound.room);
}

// As many as a robot plays in half a second. They are sent while the robot answers other requests.
TEST_F(SoundTest, AnAnswerIsDueAsEverAfterSamples) {
  begin();
  for (unsigned i = 0; i < 4; ++i) {
    play({1, 2048 * i, 2048, false});
  }
  pass(milliseconds(250));
  EXPECT_EQ("H 0", request());
  for (int i = 0; i < 4; ++i) {
    pass(milliseconds(i < 3 ? 250 : 249));
    request();
  }
  EXPECT_EQ("robot:54321 did not answer the request 'H' within 1000 ms", whyGivenUpWithin(milliseconds(1)));
}

TEST_F(SoundTest, AStopGoesBeforeSoundsThatWait) {
  begin("H F W A I O");
  const auto samples = add(callToPlaySamples({1, 0, 3, false}, {1, 2, 3}), milliseconds(2000));
  const auto stop = askToHold({});
  EXPECT_EQ("I 0", request());
}

TEST_F(SoundTest, TheEndOfASoundIsReportedWithTheRobotsCounts) {
  begin();
  play({1, 0, 2048, false});
  play({1, 2048, 1000, true});
  pushEnd(version2::END_DONE, 3048, 2, 512);
  ASSERT_EQ("1 done", ends());
  EXPECT_EQ(3048U, sound_ends_[0].samples);
  EXPECT_EQ(2U, sound_ends_[0].gaps);
  EXPECT_EQ(512U, sound_ends_[0].missing);
  pushEnd(version2::END_DONE, 3048);
  EXPECT_EQ("1 done", ends()) << "a second time";
}

// The robot plays silence until it hears that these samples were the last.
TEST_F(SoundTest, ASoundWhoseLastSamplesComeTooLateEnds) {
  begin();
  play({1, 0, 1000, false});
  play({1, 1000, 1000, true});
  pushEnd(version2::END_DONE, 2512, 1, 1512);
  ASSERT_EQ("1 done", ends());
  EXPECT_EQ(1512U, sound_ends_[0].missing);
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
  play({3, 0, 600, false});
  pushEnd(version2::END_DONE, 600);
  EXPECT_EQ("1 replaced, 2 done", ends()) << "the new one is as long only so far";
}

TEST_F(SoundTest, AStoppedSoundEndsAtOnce) {
  begin();
  play({1, 0, 500, false});
  play({0, 0, 0, true});
  EXPECT_EQ("1 stopped", ends());
  play({2, 0, 500, false});
  pushEnd(version2::END_STOPPED, 64);
  EXPECT_EQ("1 stopped", ends());
  pushEnd(version2::END_REFUSED, 32500);
  EXPECT_EQ("1 stopped, 2 refused", ends());
}

TEST_F(SoundTest, ASoundThatTheRobotHasEndedDoesNotGoOnAndEndsOnce) {
  begin();
  play({1, 0, 500, false});
  const auto answer = add(callToPlaySamples({1, 500, 1, false}, {7}), milliseconds(2000));
  EXPECT_THAT(request(), testing::StartsWith("A 2 "));
  pushEnd(version2::END_REFUSED, 32500);
  receive(makeSoundFrame(2, number_, encoded(version2::SpeakerRoom{100})));
  EXPECT_TRUE(done(answer));
  connection_.sound.connectionLost();
  EXPECT_EQ("1 refused", ends());
}

TEST_F(SoundTest, AStoppedSoundDoesNotBeginAgainWithALateAnswer) {
  begin();
  play({1, 0, 500, false});
  add(callToPlaySamples({1, 500, 1, false}, {7}), milliseconds(2000));
  EXPECT_THAT(request(), testing::StartsWith("A 2 "));
  const int late = number_;
  play({0, 0, 0, true});
  receive(makeSoundFrame(2, late, encoded(version2::SpeakerRoom{100})));
  connection_.sound.connectionLost();
  EXPECT_EQ("1 stopped", ends());
}

TEST_F(SoundTest, ALateAnswerForTheSoundBeforeDoesNotEndTheNewOne) {
  begin();
  add(callToPlaySamples({1, 0, 1, false}, {7}), milliseconds(2000));
  EXPECT_THAT(request(), testing::StartsWith("A 2 "));
  const int late = number_;
  play({2, 0, 600, true});
  receive(makeSoundFrame(2, late, encoded(version2::SpeakerRoom{100})));
  EXPECT_EQ("", ends());
  pushEnd(version2::END_DONE, 600);
  EXPECT_EQ("2 done", ends());
}

TEST_F(SoundTest, ASoundThatTheRobotRefusesHasNotBegunAndHasNoEnd) {
  begin();
  auto answer = add(callToPlaySamples({1, 0, 3, false}, {1, 2, 3}), milliseconds(2000));
  EXPECT_THAT(request(), testing::StartsWith("A 2 "));
  receive(version2_frames::makeFrame('e', number_, version2_frames::makeError(3, "ALLOW_SOUND is no")));
  EXPECT_THAT(answer.get().problem, HasSubstr("refused to play sound: ALLOW_SOUND is no"));
  connection_.sound.connectionLost();
  EXPECT_EQ("", ends());
}

/// The client's functions.
class SoundClientTest : public NewestClientFixture {
 protected:
  /// Each time, it is a sample more than before; at first, there are three.
  std::future<SoundProgress> play(std::uint64_t sound, bool is_last = false) {
    ++size_;
    return std::async(std::launch::async, [this, sound, is_last] {
      return client().playSamples(sound, std::vector<std::int16_t>(size_, 7), is_last, kTimeout);
    });
  }

  /// Accepts samples.
  /// @return position of the first one, from the request
  static unsigned accept(ScriptedPeer* peer) {
    const Frame request = peer->readRequest();
    EXPECT_EQ('A', request.header.kind);
    peer->send(makeSoundFrame(2, request.header.request_number, encoded(version2::SpeakerRoom{5000})));
    return protocol::decodeBigEndian32(request.payload.data());
  }

  std::size_t size_ = 2;
};

TEST_F(SoundClientTest, TheClientCountsThePositionOfSamples) {
  ScriptedPeer peer = connectVersion2("F A");
  auto first = play(0);
  EXPECT_EQ(0U, accept(&peer));
  const SoundProgress progress = first.get();
  EXPECT_EQ(5000U, progress.room);
  for (const bool is_last : {false, true}) {
    auto next = play(progress.sound, is_last);
    EXPECT_EQ(is_last ? 3U + 4U : 3U, accept(&peer));
    EXPECT_EQ(progress.sound, next.get().sound);
  }
  EXPECT_THROW(client().playSamples(progress.sound, {1}, false, kTimeout), CommandException) << "it had its last part";
}

TEST_F(SoundClientTest, ASoundThatWasReplacedOrStoppedCannotGoOn) {
  ScriptedPeer peer = connectVersion2("F A");
  auto first = play(0);
  accept(&peer);
  auto second = play(0);
  EXPECT_EQ(0U, accept(&peer));
  EXPECT_THROW(client().playSamples(first.get().sound, {1}, false, kTimeout), CommandException);
  auto stop = std::async(std::launch::async, [this] { client().stopSound(kTimeout); });
  EXPECT_EQ(0U, accept(&peer));
  stop.get();
  EXPECT_THROW(client().playSamples(second.get().sound, {1}, false, kTimeout), CommandException);
}

TEST_F(SoundClientTest, ASoundDoesNotGoOnOverTheNextConnection) {
  std::optional<ScriptedPeer> peer(connectVersion2("F A"));
  auto first = play(0);
  accept(&*peer);
  const std::uint64_t sound = first.get().sound;
  peer.reset();
  ScriptedPeer next = server_.accept();
  next.agreeToVersion2("F A");
  ASSERT_TRUE(eventually([this] {
    return client().statistics().connections == 3 && client().status().state == ConnectionState::kConnected;
  }));
  EXPECT_THROW(client().playSamples(sound, {1}, false, kTimeout), CommandException);
}

TEST_F(SoundClientTest, ASoundIsLostWithItsConnection) {
  std::promise<SoundEnd> ended;
  Callbacks callbacks = recorder_.callbacks();
  callbacks.on_sound_ended = [&ended](const SoundEnd& end) { ended.set_value(end); };
  RcServerClient player(optionsFor(server_), callbacks);
  player.start();
  std::optional<ScriptedPeer> peer(server_.accept());
  peer->agreeToVersion2("F A");
  player.waitForConnection(kTimeout);
  auto first = std::async(std::launch::async, [&] { return player.playSamples(0, {1, 2, 3}, false, kTimeout); });
  accept(&*peer);
  const std::uint64_t sound = first.get().sound;
  peer.reset();
  std::future<SoundEnd> future = ended.get_future();
  ASSERT_EQ(std::future_status::ready, future.wait_for(kTimeout));
  const SoundEnd end = future.get();
  EXPECT_EQ(EndedHow::kLost, end.how);
  EXPECT_EQ(sound, end.sound);
}

TEST_F(SoundClientTest, TheMicrophonesAreAskedForAgainOverTheNextConnection) {
  std::optional<ScriptedPeer> peer(connectVersion2("F A"));
  client().setMicrophone({true, 2, 16000});
  EXPECT_EQ("A 1 1 2 62 128", version2_frames::textOf(peer->readRequest()));
  peer.reset();
  ScriptedPeer next = server_.accept();
  next.agreeToVersion2("F A");
  EXPECT_EQ("A 1 1 2 62 128", version2_frames::textOf(next.readRequest()));
}

TEST_F(SoundClientTest, TheRobotSaysWhichVolumeIsInForce) {
  ScriptedPeer peer = connectVersion2("F A");
  auto volume = std::async(std::launch::async, [this] { return client().setVolume(kVolumeOfRobot, kTimeout); });
  const Frame request = peer.readRequest();
  EXPECT_EQ("A 3 255", version2_frames::textOf(request));
  peer.send(makeSoundFrame(3, request.header.request_number, {2}));
  EXPECT_EQ(2, volume.get());
  auto nonsense = std::async(std::launch::async, [this] { client().setVolume(1, kTimeout); });
  peer.send(makeSoundFrame(3, peer.readRequest().header.request_number, {255}));
  EXPECT_THROW(nonsense.get(), NetworkException);
}

TEST_F(SoundClientTest, ArgumentsThatCannotBeAreRefused) {
  EXPECT_THROW(client().setMicrophone({true, 3, 16000}), InvalidArgumentException);
  EXPECT_THROW(client().setMicrophone({true, 2, 44100}), InvalidArgumentException);
  EXPECT_THROW(client().playSamples(0, {}, true, kTimeout), InvalidArgumentException);
  EXPECT_THROW(client().playSamples(0, std::vector<std::int16_t>(kMostSamplesAtOnce + 1), true, kTimeout),
               InvalidArgumentException);
  EXPECT_THROW(client().setVolume(4, kTimeout), InvalidArgumentException);
}

TEST_F(SoundClientTest, AVersion1ServerPlaysNothing) {
  ScriptedPeer peer = connectVersion1();
  EXPECT_THROW(client().playSamples(0, {1}, true, kTimeout), CommandException);
  EXPECT_THROW(client().setVolume(1, kTimeout), CommandException);
}

}  // namespace
