// What the robot hears and plays, over ROS.

#include <actionlib/client/simple_action_client.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/PlaySound.h>
#include <aibo_driver/PlaySoundAction.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/SetVolume.h>
#include <aibo_driver/Sound.h>
#include <audio_common_msgs/AudioDataStamped.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <ros/ros.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/sound_requests.h"
#include "support/memory_stick.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"
#include "support/version2_frames.h"
#include "unit/sound/wav_files.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::PlaySound;
using aibo_driver::PlaySoundAction;
using aibo_driver::PlaySoundGoal;
using aibo_driver::Say;
using aibo_driver::SetVolume;
using aibo_driver::Sound;
using test_support::DriverProcess;
using test_support::MemoryStick;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;

/// A driver of a robot that hears a tone of a minute, and writes what it plays. The driver is connected.
class SoundUser {
 public:
  explicit SoundUser(const std::string& name_space, const std::string& settings = "ALLOW_MICROPHONE=yes\n")
      : name_space_(name_space), stick_(settings) {
    writeSoundFile(path("heard.wav"), tone(16000 * 60));
    robot_.emplace(std::vector<std::string>{"--memory-stick", stick_.path().string(), "--microphone", path("heard.wav"),
                                            "--speaker", path("played.wav")});
    driver_.emplace(name_space, robot_->port(),
                    std::vector<std::string>{"_stream_on_start:=false", "_read_timeout:=20", "_microphone_channels:=1",
                                             "_frame_prefix:=rex"},
                    std::map<std::string, std::string>{{"PATH", "/nonexistent"}}, AIBO_DRIVER_NODE_WITH_ALL);
    EXPECT_TRUE(ros::service::waitForService(name_space + "/play_sound", ros::Duration(60)));
    TopicListener<Connection> connection(name_space + "/connection");
    EXPECT_TRUE(connection.waitFor([](const Connection& message) { return message.state == Connection::CONNECTED; }));
  }

  std::string path(const std::string& name) const { return stick_.path(name).string(); }

  template <typename Service>
  typename Service::Response call(const std::string& service, const typename Service::Request& request) {
    Service call;
    call.request = request;
    EXPECT_TRUE(ros::service::call(name_space_ + "/" + service, call)) << service;
    return call.response;
  }

  PlaySound::Response play(const std::string& file) {
    PlaySound::Request request;
    request.file = file;
    return call<PlaySound>("play_sound", request);
  }

  DriverProcess& driver() { return *driver_; }

 private:
  std::string name_space_;
  MemoryStick stick_;
  std::optional<SimulatedRobot> robot_;
  std::optional<DriverProcess> driver_;
};

TEST(Microphone, IsHeardByEverySubscriberAlsoTheSecondTime) {
  SoundUser user("/hears");
  for (int time = 0; time < 2; ++time) {
    TopicListener<Sound> sounds("/hears/microphone");
    ASSERT_TRUE(sounds.waitFor([](const Sound& sound) {
      return std::any_of(sound.samples.begin(), sound.samples.end(), [](int sample) { return sample > 9000; });
    })) << "time "
        << time;
    const auto messages = sounds.waitForCount(20);
    ASSERT_GE(messages.size(), 20U);
    for (std::size_t i = 1; i < messages.size(); ++i) {
      EXPECT_EQ(messages[i]->samples_per_second, 16000U);
      EXPECT_EQ(messages[i]->channels, 1);
      EXPECT_EQ(messages[i]->header.frame_id, "rex/base_link");
      EXPECT_GT(messages[i]->frame_number, messages[i - 1]->frame_number);
      EXPECT_GT(messages[i]->header.stamp, messages[i - 1]->header.stamp);
    }
  }
}

// What the driver's diagnostics have said of its sound.
bool saysOfSound(TopicListener<diagnostic_msgs::DiagnosticArray>& diagnostics, const std::string& name_space,
                 const std::string& text) {
  return diagnostics.waitFor([&](const diagnostic_msgs::DiagnosticArray& array) {
    return std::any_of(array.status.begin(), array.status.end(), [&](const diagnostic_msgs::DiagnosticStatus& each) {
      return each.name == name_space + "/aibo_driver: sound" && each.message.find(text) == 0;
    });
  }) != nullptr;
}

TEST(Microphone, IsHeardAsAudioToo) {
  SoundUser user("/audio_user");
  TopicListener<audio_common_msgs::AudioDataStamped> audio("/audio_user/audio");
  ASSERT_TRUE(audio.waitForNext()) << "its subscriber alone switches the microphones on";
  TopicListener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  EXPECT_TRUE(saysOfSound(diagnostics, "audio_user", "listening"));
  TopicListener<Sound> sounds("/audio_user/microphone");
  const auto sound = sounds.waitFor([](const Sound& heard) {
    return heard.missing == 0 && *std::max_element(heard.samples.begin(), heard.samples.end()) > 9000;
  });
  ASSERT_TRUE(sound);
  const auto same = audio.waitFor(
      [&](const audio_common_msgs::AudioDataStamped& a) { return a.header.stamp == sound->header.stamp; });
  ASSERT_TRUE(same);
  EXPECT_EQ(same->header.frame_id, sound->header.frame_id);
  ASSERT_EQ(same->audio.data.size(), 2 * sound->samples.size());
  for (std::size_t i = 0; i < sound->samples.size(); ++i) {
    const int low = same->audio.data[2 * i];
    const int high = same->audio.data[2 * i + 1];
    ASSERT_EQ(static_cast<std::int16_t>(high << 8 | low), sound->samples[i]);
  }
}

/// Whether the driver's next request for the microphones switches them on.
bool isSwitchedOn(test_support::ScriptedPeer* robot) {
  namespace version2 = protocol::version2;
  version2_frames::Frame request;
  while ((request = robot->readFrame()).header.kind != version2::REQUEST_SOUND) {
    const bool is_heartbeat = request.header.kind == version2::REQUEST_HELLO;
    robot->send(version2_frames::makeFrame(version2::replyKind(request.header.kind), request.header.request_number,
                                           is_heartbeat ? version2_frames::makeHello("F A") : request.payload));
  }
  EXPECT_EQ(request.header.id, version2::SOUND_MICROPHONE);
  version2::MicrophoneSettings settings = {};
  EXPECT_EQ(decode(request.payload.data(), request.payload.size(), &settings), nullptr);
  robot->send(version2_frames::makeFrame('a', request.header.request_number, request.payload));
  return (settings.mode & version2::MICROPHONE_ON) != 0;
}

TEST(Microphone, IsOnOnlyWhileSomebodyListensAlsoTheSecondTimeAndOverTheNextConnection) {
  test_support::ScriptedServer server;
  DriverProcess driver("/listens", server.port(), {"_stream_on_start:=false", "_read_timeout:=20"});
  std::optional<test_support::ScriptedPeer> robot(server.accept());
  robot->agreeToVersion2("F A");
  for (int time = 0; time < 2; ++time) {
    {
      const TopicListener<Sound> listener("/listens/microphone");
      EXPECT_TRUE(isSwitchedOn(&*robot)) << "time " << time;
      const TopicListener<Sound> other("/listens/microphone");
    }
    EXPECT_FALSE(isSwitchedOn(&*robot)) << "time " << time;
  }
  const TopicListener<Sound> listener("/listens/microphone");
  EXPECT_TRUE(isSwitchedOn(&*robot));
  robot->close();
  robot.emplace(server.accept());
  robot->agreeToVersion2("F A");
  EXPECT_TRUE(isSwitchedOn(&*robot)) << "over the next connection";
}

TEST(Microphone, AGapIsSilenceInAudio) {
  namespace version2 = protocol::version2;
  test_support::ScriptedServer server;
  DriverProcess driver("/gap", server.port(),
                       {"_stream_on_start:=false", "_read_timeout:=20", "_microphone_channels:=1"}, {},
                       AIBO_DRIVER_NODE_WITH_ALL);
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToVersion2("F A");
  TopicListener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(saysOfSound(diagnostics, "gap", "idle"));
  TopicListener<audio_common_msgs::AudioDataStamped> audio("/gap/audio");
  ASSERT_TRUE(isSwitchedOn(&robot));
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
  EXPECT_TRUE(saysOfSound(diagnostics, "gap", "sound is missing"));
  diagnostics.clear();
  send(1003);
  EXPECT_TRUE(saysOfSound(diagnostics, "gap", "listening")) << "the gap was said";
  diagnostics.clear();
  EXPECT_TRUE(saysOfSound(diagnostics, "gap", "nothing is heard"));
  send(1200);
  const auto after_long_gap = audio.waitForCount(4);
  ASSERT_EQ(after_long_gap.size(), 4U);
  EXPECT_EQ(after_long_gap[3]->audio.data, heard_samples) << "more than a second is not filled";
}

TEST(Microphone, IsSilentUnlessTheRobotsOwnerAllowsIt) {
  SoundUser user("/deaf", "");
  TopicListener<Sound> sounds("/deaf/microphone");
  user.driver().waitForOutput("The robot did not do what it was told: .*ALLOW_MICROPHONE", test_support::kSafetyNet);
  EXPECT_EQ(sounds.count(), 0U);
}

TEST(PlaySoundService, PlaysAFileAndSaysWhyItDoesNot) {
  SoundUser user("/plays");
  writeSoundFile(user.path("bark.wav"), tone(1600));
  const auto played = user.play(user.path("bark.wav"));
  EXPECT_TRUE(played.success) << played.message;
  EXPECT_THAT(user.play(user.path("missing.wav")).message, HasSubstr("missing.wav"));
  EXPECT_THAT(user.play("/proc/kmsg").message, HasSubstr("Nothing was played"));
  const Say::Response said = user.call<Say>("say", [] {
    Say::Request request;
    request.text = "hello";
    return request;
  }());
  EXPECT_FALSE(said.success);
  EXPECT_THAT(said.message, HasSubstr("espeak-ng"));
  SetVolume::Request volume;
  volume.volume = 4;
  EXPECT_FALSE(user.call<SetVolume>("set_volume", volume).success);
  volume.volume = 2;
  const auto set = user.call<SetVolume>("set_volume", volume);
  EXPECT_TRUE(set.success) << set.message;
  EXPECT_EQ(set.volume, 2);
  EXPECT_EQ(set.message, "The volume is 2.");
  volume.volume = SetVolume::Request::OF_ROBOT;
  EXPECT_LE(user.call<SetVolume>("set_volume", volume).volume, 3) << "the one in force";
  writeSoundFile(user.path("long.wav"), tone(16000 * 60));
  EXPECT_TRUE(user.play(user.path("long.wav")).success);
  test_support::DiagnosticsListener diagnostics;
  const auto says_playing = [&diagnostics](const std::string& text) {
    const auto status = diagnostics.waitFor("plays/aibo_driver: sound", [&text](const auto& each) {
      return test_support::DiagnosticsListener::value(each, "playing") == text;
    });
    return !status.name.empty();
  };
  EXPECT_TRUE(says_playing("yes"));
  PlaySound::Request stop;
  stop.stop = 1;
  EXPECT_EQ(user.call<PlaySound>("play_sound", stop).message, "No sound plays.");
  EXPECT_TRUE(says_playing("no"));
}

TEST(PlaySoundActionTest, SucceedsAtTheEndIsCancelledAndSucceedsAgain) {
  SoundUser user("/plays_goals");
  writeSoundFile(user.path("short.wav"), tone(1600));
  writeSoundFile(user.path("long.wav"), tone(16000 * 60));
  actionlib::SimpleActionClient<PlaySoundAction> client("/plays_goals/play_sound");
  ASSERT_TRUE(client.waitForServer(ros::Duration(60)));
  const auto begin = [&](actionlib::SimpleActionClient<PlaySoundAction>& player, const std::string& file) {
    PlaySoundGoal goal;
    goal.file = user.path(file);
    player.sendGoal(goal);
    // A client takes a goal for lost that it cancels before the server has heard of it.
    while (player.getState() == actionlib::SimpleClientGoalState::PENDING) {
      ros::WallDuration(0.01).sleep();
    }
  };
  const auto result_of = [&](const std::string& file, bool cancel) {
    begin(client, file);
    if (cancel) {
      client.cancelGoal();
    }
    EXPECT_TRUE(client.waitForResult(ros::Duration(60)));
    return client.getState();
  };
  EXPECT_EQ(result_of("short.wav", false), actionlib::SimpleClientGoalState::SUCCEEDED);
  EXPECT_EQ(result_of("long.wav", true), actionlib::SimpleClientGoalState::PREEMPTED);
  EXPECT_EQ(result_of("short.wav", false), actionlib::SimpleClientGoalState::SUCCEEDED);
  begin(client, "long.wav");
  writeSoundFile(user.path("second.wav"), tone(16000));
  actionlib::SimpleActionClient<PlaySoundAction> other("/plays_goals/play_sound");
  ASSERT_TRUE(other.waitForServer(ros::Duration(60)));
  begin(other, "second.wav");
  client.cancelGoal();  // at once: the driver need not have seen that this sound has ended
  EXPECT_TRUE(other.waitForResult(ros::Duration(60)));
  EXPECT_EQ(other.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << "only its own sound is cancelled";
  PlaySoundGoal both;
  both.file = user.path("short.wav");
  both.text = "hello";
  PlaySoundGoal speech;
  speech.text = "hello";
  for (const auto& [goal, complaint] :
       {std::pair(PlaySoundGoal(), "give a file or a text"), {both, "give a file or a text"}, {speech, "espeak-ng"}}) {
    client.sendGoalAndWait(goal, ros::Duration(60));
    EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::REJECTED);
    EXPECT_THAT(client.getResult()->message, HasSubstr(complaint));
  }
}

}  // namespace
