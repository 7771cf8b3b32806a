// What the robot hears and plays, over ROS.

#include <aibo_driver/PlaySound.h>
#include <aibo_driver/PlaySoundAction.h>
#include <aibo_driver/SetVolume.h>
#include <aibo_driver/Sound.h>
#include <audio_common_msgs/AudioDataStamped.h>
#include <gmock/gmock.h>
#include <ros/ros.h>

#include <numeric>

#include "protocol/sound_requests.h"
#include "ros/driver_user.h"
#include "ros/goal_watch.h"
#include "support/scripted_server.h"
#include "support/temporary_folder.h"
#include "unit/sound/wav_files.h"

namespace {

using aibo_driver::Sound;
using test_support::TopicListener;

using SoundGoal = test_support::GoalWatch<aibo_driver::PlaySoundAction>;
using State = actionlib::TerminalState;

/// The driver's next request for the microphones.
protocol::version2::MicrophoneSettings nextSettings(test_support::ScriptedPeer* robot) {
  const version2_frames::Frame request = robot->readRequest();
  EXPECT_EQ(request.header.kind, protocol::version2::REQUEST_SOUND);
  protocol::version2::MicrophoneSettings settings = {};
  EXPECT_EQ(decode(request.payload.data(), request.payload.size(), &settings), nullptr);
  robot->send(version2_frames::makeFrame('a', request.header.request_number, request.payload));
  return settings;
}

bool isSwitchedOn(test_support::ScriptedPeer* robot) {
  return (nextSettings(robot).mode & protocol::version2::MICROPHONE_ON) != 0;
}

TEST(Microphone, IsOnOnlyWhileSomebodyListens) {
  test_support::ScriptedServer server;
  test_support::DriverProcess driver("/listens", server.port(),
                                     {"_stream_on_start:=false", "_telemetry_rate:=0", "_read_timeout:=20"});
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToVersion2("F A");
  {
    const TopicListener<Sound> listener("/listens/microphone");
    EXPECT_TRUE(isSwitchedOn(&robot));
    const TopicListener<Sound> other("/listens/microphone");
  }
  EXPECT_FALSE(isSwitchedOn(&robot));
}

TEST(Microphone, IsOpenedWithItsParametersAndAGapIsSilenceInAudio) {
  namespace version2 = protocol::version2;
  test_support::ScriptedServer server;
  test_support::DriverProcess driver("/gap", server.port(),
                                     {"_stream_on_start:=false", "_telemetry_rate:=0", "_read_timeout:=20",
                                      "_microphone_channels:=1", "_sound_priority:=true"},
                                     {}, AIBO_DRIVER_NODE_WITH_ALL);
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToVersion2("F A");
  EXPECT_EQ(nextSettings(&robot).mode, version2::SOUND_FIRST) << "before somebody listens";
  TopicListener<audio_common_msgs::AudioDataStamped> audio("/gap/audio");
  const version2::MicrophoneSettings settings = nextSettings(&robot);
  EXPECT_EQ(settings.mode, version2::MICROPHONE_ON | version2::SOUND_FIRST);
  EXPECT_EQ(settings.channels, 1);
  std::vector<std::uint8_t> samples(2 * version2::SAMPLES_PER_FRAME);
  std::iota(samples.begin(), samples.end(), std::uint8_t{1});
  std::vector<std::uint8_t> heard_samples = samples;  // little-endian
  for (std::size_t i = 0; i < samples.size(); i += 2) {
    std::swap(heard_samples[i], heard_samples[i + 1]);
  }
  const auto send = [&robot, &samples](unsigned frame) {
    std::vector<std::uint8_t> bytes =
        version2_frames::makeFrame('a', 0,
                                   version2_frames::encoded(version2::HeardSound{frame, version2::SAMPLES_PER_FRAME, 1,
                                                                                 samples.data(), samples.size()}));
    bytes[1] = version2::SOUND_MICROPHONE;
    robot.send(bytes);
    robot.readFrame();  // the client's next sign of life; the second frame is over by then
  };
  send(1000);
  send(1002);
  const auto heard = audio.waitForCount(2);
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0]->audio.data, heard_samples);
  std::vector<std::uint8_t> with_silence(samples.size(), 0);
  with_silence.insert(with_silence.end(), heard_samples.begin(), heard_samples.end());
  EXPECT_EQ(heard[1]->audio.data, with_silence);
  EXPECT_NEAR((heard[1]->header.stamp - heard[0]->header.stamp).toSec(), 0.008, 0.004) << "when the silence began";
}

class PlaySoundTest : public ::testing::Test {
 protected:
  PlaySoundTest() {
    writeSoundFile(path("short.wav"), tone(1600));
    writeSoundFile(path("long.wav"), tone(16000 * 60));
    EXPECT_TRUE(client_.waitForActionServerToStart(ros::Duration(60)));
  }

  std::string path(const std::string& name) const { return name.empty() ? "" : folder_.path(name).string(); }

  std::unique_ptr<SoundGoal> begin(const std::string& file, const std::string& text = "") {
    SoundGoal::Goal goal;
    goal.file = path(file);
    goal.text = text;
    return std::make_unique<SoundGoal>(client_, goal);
  }

  const test_support::TemporaryFolder folder_;
  test_support::DriverUser user_{"/plays", {"_stream_on_start:=false"}};
  SoundGoal::Client client_{"/plays/play_sound"};
};

TEST_F(PlaySoundTest, ACallBeginsASoundAndStopsIt) {
  aibo_driver::PlaySound::Request request;
  request.file = path("long.wav");
  EXPECT_TRUE(user_.call<aibo_driver::PlaySound>("play_sound", request).success);
  request.file.clear();
  request.stop = 1;
  EXPECT_TRUE(user_.call<aibo_driver::PlaySound>("play_sound", request).success);
  aibo_driver::SetVolume::Request volume;
  volume.volume = 2;
  EXPECT_EQ(user_.call<aibo_driver::SetVolume>("set_volume", volume).volume, 2);
}

TEST_F(PlaySoundTest, AGoalSucceedsAtTheEndOfItsSoundAndCancelledStopsIt) {
  EXPECT_EQ(begin("short.wav")->waitForEnd(), State::SUCCEEDED);
  const auto cancelled = begin("long.wav");
  ASSERT_TRUE(cancelled->waitForFeedback());
  cancelled->cancel();
  EXPECT_EQ(cancelled->waitForEnd(), State::PREEMPTED);
  const auto replaced = begin("long.wav");
  ASSERT_TRUE(replaced->waitForFeedback());
  const auto next = begin("short.wav");
  replaced->cancel();
  EXPECT_EQ(next->waitForEnd(), State::SUCCEEDED);
  for (const auto& rejected : {begin(""), begin("short.wav", "hello")}) {
    EXPECT_EQ(rejected->waitForEnd(), State::REJECTED);
    EXPECT_THAT(rejected->result()->message, testing::HasSubstr("give a file or a text"));
  }
}

}  // namespace
