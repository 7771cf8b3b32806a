#include "camera/stream_policy.h"

#include <gmock/gmock.h>

#include <optional>

namespace aibo_driver::camera {
namespace {

class StreamPolicyTest : public ::testing::Test {
 protected:
  bool has_subscriber_ = false;
  std::optional<bool> streaming_;
  StreamPolicy policy_{true, true, [this] { return has_subscriber_; }, [this](bool on) { streaming_ = on; }};
};

TEST_F(StreamPolicyTest, OnDemandFollowsTheSubscribers) {
  policy_.decide();
  EXPECT_EQ(streaming_, false);
  EXPECT_TRUE(policy_.waitsForSubscriber());
  has_subscriber_ = true;
  policy_.decide();
  EXPECT_EQ(streaming_, true);
  EXPECT_FALSE(policy_.waitsForSubscriber());
  has_subscriber_ = false;
  policy_.decide();
  EXPECT_EQ(streaming_, false);
}

TEST_F(StreamPolicyTest, OnDemandSubscribersGetNothingWhileTheStreamIsNotWanted) {
  policy_.decide();
  has_subscriber_ = true;
  policy_.setWanted(false);
  policy_.decide();
  EXPECT_EQ(streaming_, false);
  EXPECT_FALSE(policy_.waitsForSubscriber());
  has_subscriber_ = false;
  EXPECT_FALSE(policy_.waitsForSubscriber()) << "one would not help";
}

}  // namespace
}  // namespace aibo_driver::camera
