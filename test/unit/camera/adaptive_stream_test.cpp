#include "camera/adaptive_stream.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace aibo_driver::camera {
namespace {

using namespace std::chrono_literals;

constexpr auto kMaxAge = 150ms;
constexpr auto kInTime = 60ms;

/// Pictures come with a stepped clock, every n-th of 30 a second as they are asked for, or as many as the link carries.
class AdaptiveStreamTest : public testing::Test {
 protected:
  using Step = AdaptiveStream::Step;

  /// The link carries this many pictures of quality 85 in a second.
  void passOverLink(double rate_at_85, AdaptiveStream::Duration time) {
    const auto end = now_ + time;
    while (now_ < end) {
      const Step& step = stream_.inForce();
      const double asked = 30.0 / step.every_nth_image;
      const double size = step.jpeg_quality >= 85 ? 1 : 0.5 + 0.5 * (step.jpeg_quality - 50) / 35;
      const double carried = rate_at_85 / size;
      arrive(std::min(asked, carried), asked > carried ? 250ms : kInTime);
    }
  }

  /// Pictures of one age, as many as are asked for.
  void pass(AdaptiveStream::Duration age, AdaptiveStream::Duration time) {
    const auto end = now_ + time;
    while (now_ < end) {
      arrive(30.0 / stream_.inForce().every_nth_image, age);
    }
  }

  void arrive(double rate, AdaptiveStream::Duration age) {
    now_ += std::chrono::duration_cast<AdaptiveStream::Duration>(std::chrono::duration<double>(1 / rate));
    if (stream_.pictureArrived(now_, age)) {
      changes_.push_back(now_);
    }
    too_old_since_ = age > kMaxAge ? std::min(too_old_since_, now_) : AdaptiveStream::SteadyTime::max();
    longest_too_old_ = std::max(longest_too_old_, now_ - std::min(too_old_since_, now_));
  }

  AdaptiveStream stream_{{85, 1}, kMaxAge};
  AdaptiveStream::SteadyTime now_{1000s};
  std::vector<AdaptiveStream::SteadyTime> changes_;
  AdaptiveStream::SteadyTime too_old_since_ = AdaptiveStream::SteadyTime::max();
  AdaptiveStream::Duration longest_too_old_{0};
};

TEST_F(AdaptiveStreamTest, FewOldPicturesChangeNothing) {
  pass(kInTime, 1s);
  for (int i = 0; i < 20; ++i) {
    pass(300ms, 130ms);  // four of them
    pass(kInTime, 400ms);
  }
  EXPECT_TRUE(changes_.empty());
  EXPECT_FALSE(stream_.isLowered());
}

TEST_F(AdaptiveStreamTest, GoesDownAboveFourFifthsOfTheLimitAndUpBelowThreeFifths) {
  pass(117ms, 1min);
  EXPECT_FALSE(stream_.isLowered());
  pass(123ms, 1s);
  ASSERT_TRUE(stream_.isLowered());
  const auto lowered = changes_.size();
  pass(93ms, 1min);
  EXPECT_EQ(changes_.size(), lowered);
  pass(87ms, 1min);
  EXPECT_FALSE(stream_.isLowered());
}

TEST_F(AdaptiveStreamTest, LowersQualityBeforeRate) {
  stream_ = AdaptiveStream({85, 2}, kMaxAge);
  int last_quality = 85;
  int last_nth = 2;
  for (int i = 0; i < 30; ++i) {
    pass(200ms, 1s);
    const Step& step = stream_.inForce();
    EXPECT_LE(step.jpeg_quality, last_quality);
    EXPECT_GE(step.every_nth_image, last_nth);
    EXPECT_TRUE(step.every_nth_image == 2 || step.jpeg_quality == AdaptiveStream::kLowestQuality);
    last_quality = step.jpeg_quality;
    last_nth = step.every_nth_image;
  }
  EXPECT_EQ(last_quality, AdaptiveStream::kLowestQuality);
  EXPECT_EQ(last_nth, AdaptiveStream::kRarestImage);
}

TEST_F(AdaptiveStreamTest, OnAFullLinkPicturesAreTooOldForLessThanASecond) {
  for (const double rate_at_85 : {25.0, 17.3, 8.0}) {
    stream_ = AdaptiveStream({85, 1}, kMaxAge);
    passOverLink(rate_at_85, 60s);
  }
  EXPECT_LT(longest_too_old_, 1s);
}

TEST_F(AdaptiveStreamTest, TriesAHigherStepEverMoreRarely) {
  passOverLink(17.3, 10min);
  const auto first_half = std::count_if(changes_.begin(), changes_.end(), [this](auto at) { return at < now_ - 5min; });
  EXPECT_LE(changes_.size(), 30U);
  EXPECT_LE(static_cast<long>(changes_.size()) - first_half, 4) << "in the last five minutes";
}

TEST_F(AdaptiveStreamTest, TriesAHigherStepWithinTenMinutes) {
  passOverLink(25, 1h);
  ASSERT_TRUE(stream_.isLowered());
  pass(kInTime, 10min);
  EXPECT_FALSE(stream_.isLowered());
}

TEST_F(AdaptiveStreamTest, ComesBackToTheBestWhenTheLinkIsGoodAgain) {
  passOverLink(8, 20s);
  ASSERT_TRUE(stream_.isLowered());
  pass(kInTime, 2min);
  EXPECT_EQ(stream_.inForce().jpeg_quality, 85);
  EXPECT_EQ(stream_.inForce().every_nth_image, 1);
}

// A hostile robot chooses the ages, and when they change.
TEST_F(AdaptiveStreamTest, ARobotThatLiesIsAskedForFewChangesAndIsBelievedAgain) {
  const auto begin = now_;
  bool lies = true;
  while (now_ - begin < 1h) {
    lies = lies ? stream_.inForce().every_nth_image < AdaptiveStream::kRarestImage
                : !stream_.isLowered() && now_ - changes_.back() > AdaptiveStream::kTrial;
    pass(lies ? 10s : kInTime, 30ms);
  }
  EXPECT_LT(changes_.size(), 60U * 20);
  pass(kInTime, 10min);
  EXPECT_FALSE(stream_.isLowered());
}

// A robot can send any number of pictures in a second, so only the newest ones are compared.
TEST_F(AdaptiveStreamTest, AFloodIsJudgedByItsNewestPictures) {
  pass(200ms, 500ms);
  const auto lowered = changes_.size();
  pass(kInTime, 4s);
  arrive(30, kMaxAge);
  pass(kInTime, 2s);
  ASSERT_EQ(changes_.size(), lowered) << "an old picture keeps the stream low for kCalmTime";
  for (std::size_t i = 0; i < AdaptiveStream::kMostArrivals; ++i) {
    arrive(100'000, kInTime);
  }
  EXPECT_EQ(changes_.size(), lowered + 1) << "but not after so many newer ones";
}

TEST_F(AdaptiveStreamTest, KeepsToTheUsersRateAndALowQuality) {
  stream_ = AdaptiveStream({30, 4}, kMaxAge);
  EXPECT_EQ(stream_.inForce().every_nth_image, 4);
  pass(300ms, 10s);
  EXPECT_EQ(stream_.inForce().jpeg_quality, 30);
  EXPECT_GT(stream_.inForce().every_nth_image, 4);
  pass(kInTime, 5min);
  EXPECT_EQ(stream_.inForce().every_nth_image, 4);
}

}  // namespace
}  // namespace aibo_driver::camera
