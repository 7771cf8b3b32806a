// Sound, from the simulated robot's microphones and to its speaker.
#include <gmock/gmock.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "sound/player.h"
#include "sound/recording.h"
#include "sound/sound_file.h"
#include "support/memory_stick.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

using namespace aibo_client;
using std::chrono::seconds;
using test_support::kSafetyNet;
using test_support::MemoryStick;
using test_support::SimulatedRobot;

namespace {

using Samples = std::vector<std::int16_t>;

/// No sample of it is 0.
Samples ramp(std::size_t size) {
  Samples samples(size);
  for (std::size_t i = 0; i < size; ++i) {
    samples[i] = static_cast<std::int16_t>(i % 30000 + 1);
  }
  return samples;
}

class SoundPairTest : public testing::Test {
 protected:
  ~SoundPairTest() override {
    if (client_) {
      client_->stop();
    }
  }

  std::string path(const std::string& name) const { return stick_.path(name).string(); }

  void start(const std::vector<std::string>& options) {
    std::vector<std::string> all = {"--memory-stick", stick_.path().string(), "--hears-itself", "0.25",
                                    "--speaker",      path("played.wav")};
    all.insert(all.end(), options.begin(), options.end());
    robot_.emplace(all);
    ClientOptions client_options;
    client_options.port = robot_->port();
    client_options.read_timeout = seconds(10);
    Callbacks callbacks;
    callbacks.on_status = [this](const ConnectionStatus& status) {
      change([&] { is_connected_ = status.state == ConnectionState::kConnected; });
    };
    callbacks.on_heard = [this](const HeardSound& sound) {
      change([&] {
        heard_.push_back(sound);
        loudest_heard_ = std::accumulate(sound.samples.begin(), sound.samples.end(), loudest_heard_,
                                         [](std::int16_t a, std::int16_t b) { return std::max(a, b); });
      });
    };
    callbacks.on_sound_ended = [this](const SoundEnd& end) {
      player_->ended(end);
      change([&] { ends_.push_back(end); });
    };
    client_.emplace(client_options, callbacks);
    player_.emplace(*client_);
    client_->start();
    ASSERT_TRUE(await([this] { return is_connected_; }));
  }

  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    changed_.notify_all();
  }

  template <typename Condition>
  bool await(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kSafetyNet, condition);
  }

  /// Writes a WAV file, mono.
  void write(const std::string& name, const Samples& samples) const {
    aibo_driver::sound::Recording recording(path(name), {true, 1, 16000});
    HeardSound sound;
    sound.channels = 1;
    sound.samples_per_second = 16000;
    sound.samples = samples;
    recording.add(sound);
  }

  MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_connected_ = false;
  std::vector<HeardSound> heard_;
  std::int16_t loudest_heard_ = 0;
  std::vector<SoundEnd> ends_;
  std::optional<SimulatedRobot> robot_;
  std::optional<RcServerClient> client_;
  std::optional<aibo_driver::sound::Player> player_;
};

TEST_F(SoundPairTest, WhatTheRobotHearsComesBitByBit) {
  const Samples file = ramp(8000);
  write("heard.wav", file);
  start({"--microphone", path("heard.wav")});
  client_->setMicrophone({true, 1, 16000});
  // Until the whole file was heard, or would have been: a busy computer may be too slow for some of it.
  ASSERT_TRUE(await([&] {
    std::size_t frames = 0;
    for (const HeardSound& sound : heard_) {
      frames += sound.missing + sound.samples.size();
    }
    return frames > file.size() + 8000;
  }));
  std::optional<std::size_t> begin;
  std::size_t at = 0;
  std::size_t compared = 0;
  for (const HeardSound& sound : heard_) {
    at += sound.missing;
    for (const std::int16_t sample : sound.samples) {
      if (!begin && sample != 0) {
        begin = at - static_cast<std::size_t>(sample - 1);
      }
      if (begin && at - *begin < file.size()) {
        ASSERT_EQ(file[at - *begin], sample) << "at " << at - *begin;
        ++compared;
      }
      ++at;
    }
  }
  EXPECT_LT(0U, compared);
}

TEST_F(SoundPairTest, TheRobotPlaysAFileBitByBit) {
  const Samples file = ramp(20000);
  write("bark.wav", file);
  start({});
  client_->setMicrophone({true, 1, 16000});
  // A busy computer may send samples too late. Then there are gaps, so the sound is played again.
  for (std::size_t i = 1; i <= 5; ++i) {
    player_->play(aibo_driver::sound::openSoundFile(path("bark.wav")));
    ASSERT_TRUE(await([&] { return ends_.size() == i; }));
    ASSERT_TRUE(ends_.back().how == EndedHow::kDone || ends_.back().how == EndedHow::kRefused);
    if (ends_.back().how == EndedHow::kDone && ends_.back().gaps == 0) {
      break;
    }
  }
  EXPECT_EQ(file.size(), ends_.back().samples);
  // A busy computer may be too slow for some of what it hears of itself, but not for all.
  EXPECT_TRUE(await([this] { return loudest_heard_ > 0; }));
  client_->stop();
  EXPECT_LE(loudest_heard_, 5000) << "a quarter";
  robot_.reset();
  std::ifstream stream(path("played.wav"), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  Samples played(bytes.size() / sizeof(std::int16_t));
  std::memcpy(played.data(), bytes.data(), played.size() * sizeof(std::int16_t));
  EXPECT_NE(played.end(), std::search(played.begin(), played.end(), file.begin(), file.end()));
}

}  // namespace
