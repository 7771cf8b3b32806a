// Playing: how samples are paced, and how sounds end.
#include "sound/player.h"

#include <gmock/gmock.h>

#include <atomic>
#include <future>

#include "support/fake_client.h"
#include "support/safety_net.h"

using namespace aibo_driver::sound;
using aibo_client::EndedHow;
using aibo_client::kMostSamplesAtOnce;

namespace {

Source ramp(std::size_t length) {
  return [left = length, next = std::int16_t{0}](std::size_t most) mutable {
    std::vector<std::int16_t> samples(std::min(most, left));
    left -= samples.size();
    std::generate(samples.begin(), samples.end(), [&next] { return next++; });
    return samples;
  };
}

class PlayerTest : public testing::Test {
 protected:
  PlayerTest() {
    robot_.on_samples = [this](bool is_last) { has_last_ = is_last; };
  }

  std::atomic<bool> has_last_{false};
  test_support::FakeClient robot_;
  Player player_{robot_};
};

TEST_F(PlayerTest, AllSamplesAreSentInPieces) {
  const auto playback = player_.play(ramp(2 * kMostSamplesAtOnce + 100));
  ASSERT_TRUE(test_support::eventually([this] { return has_last_.load(); }));
  EXPECT_THAT(robot_.told, testing::ElementsAre("samples 2048", "samples 2048", "samples 100 last"));
  ASSERT_EQ(2 * kMostSamplesAtOnce + 100, robot_.played.size());
  EXPECT_TRUE(std::is_sorted(robot_.played.begin(), robot_.played.end()));
  EXPECT_FALSE(playback->end());
  EXPECT_TRUE(player_.isPlaying());
  player_.ended({41, EndedHow::kDone, 4196, 2, 16000});
  ASSERT_TRUE(playback->end());
  EXPECT_EQ(EndedHow::kDone, playback->end()->how);
  EXPECT_THAT(playback->end()->message, testing::HasSubstr("2 gaps, 1.0 s"));
  EXPECT_FALSE(player_.isPlaying());
}

TEST_F(PlayerTest, TheEndOfASoundIsSaidInWords) {
  const std::pair<aibo_client::SoundEnd, const char*> ends[] = {
      {{41, EndedHow::kDone, 24000, 0, 0}, "It was played to its end, 1.5 s."},
      {{42, EndedHow::kReplaced, 24000, 0, 0}, "Another sound has replaced it."},
      {{43, EndedHow::kStopped, 24000, 0, 0}, "It was stopped."},
      {{44, EndedHow::kRefused, 24000, 0, 0}, "The robot has ended it: no more samples came for 2 s."},
      {{45, EndedHow::kLost, 24000, 0, 0},
       "The connection to the robot was lost. The sound does not go on when it is back."},
      {{46, EndedHow::kUnknown, 24000, 0, 0}, "The robot does not say how it has ended."}};
  for (const auto& [end, words] : ends) {
    const auto playback = player_.play(ramp(5));
    player_.ended(end);
    ASSERT_TRUE(playback->end()) << words;
    EXPECT_EQ(playback->end()->how, end.how);
    EXPECT_EQ(playback->end()->message, words);
  }
}

TEST_F(PlayerTest, NoMoreIsSentThanTheRobotHasRoomFor) {
  robot_.room_for_samples = 0;
  const auto begin = std::chrono::steady_clock::now();
  player_.play(ramp(2 * kMostSamplesAtOnce));
  ASSERT_TRUE(test_support::eventually([this] { return has_last_.load(); }));
  // Until then, the robot has played what was sent.
  EXPECT_LE(std::chrono::milliseconds(128), std::chrono::steady_clock::now() - begin);
}

TEST_F(PlayerTest, ASoundThatEndsBeforeItIsKnownHasEnded) {
  player_.ended({40, EndedHow::kDone, 3, 0, 0});
  player_.ended({41, EndedHow::kDone, 3, 0, 0});
  EXPECT_TRUE(player_.play(ramp(3))->end());
}

TEST_F(PlayerTest, ANewSoundReplacesTheOneThatPlays) {
  robot_.room_for_samples = 0;
  player_.play(ramp(1000000));
  const auto second = player_.play(ramp(5));
  EXPECT_EQ("samples 5 last", robot_.told.back());
  player_.ended({41, EndedHow::kReplaced, 0, 0, 0});
  EXPECT_FALSE(second->end());
}

TEST_F(PlayerTest, StoppingASoundThatHasEndedOrWasReplacedStopsNoOther) {
  player_.stop();
  EXPECT_TRUE(robot_.told.empty()) << "nothing has played yet";
  const auto first = player_.play(ramp(5));
  const auto second = player_.play(ramp(5));
  player_.stop(first);
  EXPECT_NE("stop sound", robot_.told.back());
  player_.stop(second);
  EXPECT_EQ("stop sound", robot_.told.back());
  robot_.told.clear();
  player_.ended({42, EndedHow::kStopped, 0, 0, 0});
  player_.stop();
  EXPECT_TRUE(robot_.told.empty());
}

TEST_F(PlayerTest, WhyNoMoreSamplesWereSentIsInTheEnd) {
  std::promise<void> fails;
  robot_.on_samples = [&, pieces = 0](bool) mutable {
    if (++pieces == 2) {
      fails.set_value();
      throw aibo_client::NetworkException("the answer did not come");
    }
  };
  const auto playback = player_.play(ramp(1000000));
  fails.get_future().wait();
  player_.finish();
  player_.ended({41, EndedHow::kRefused, 0, 0, 0});
  EXPECT_THAT(playback->end()->message, testing::HasSubstr("The robot has ended it: the answer did not come"));
}

TEST_F(PlayerTest, WithoutAConnectionNothingPlays) {
  robot_.problem = "no connection";
  EXPECT_THROW(player_.play(ramp(5)), aibo_client::NetworkException);
  EXPECT_FALSE(player_.isPlaying());
  robot_.problem.clear();
  EXPECT_THROW(player_.play(ramp(0)), aibo_client::InvalidArgumentException);
}

}  // namespace
