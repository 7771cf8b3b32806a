#include "node/camera/stream_policy.h"

#include <gmock/gmock.h>

#include <optional>

namespace aibo_driver::node {
namespace {

class StreamPolicyTest : public ::testing::Test {
 protected:
  void start(StreamPolicy& policy) {
    policy.start([this] { return has_subscriber_; }, [this](bool on) { streaming_ = on; });
  }

  bool has_subscriber_ = false;
  std::optional<bool> streaming_;
};

TEST_F(StreamPolicyTest, OnDemandFollowsTheSubscribers) {
  StreamPolicy policy(true, true);
  start(policy);
  EXPECT_EQ(streaming_, false);
  EXPECT_TRUE(policy.waitsForSubscriber());
  has_subscriber_ = true;
  policy.subscribersChanged();
  EXPECT_EQ(streaming_, true);
  EXPECT_FALSE(policy.waitsForSubscriber());
  has_subscriber_ = false;
  policy.subscribersChanged();
  EXPECT_EQ(streaming_, false);
}

TEST_F(StreamPolicyTest, OnDemandSubscribersGetNothingWhileTheStreamIsNotWanted) {
  StreamPolicy policy(true, true);
  start(policy);
  has_subscriber_ = true;
  policy.setWanted(false);
  policy.subscribersChanged();
  EXPECT_EQ(streaming_, false);
  EXPECT_FALSE(policy.waitsForSubscriber());
  has_subscriber_ = false;
  EXPECT_FALSE(policy.waitsForSubscriber()) << "one would not help";
}

TEST_F(StreamPolicyTest, DecidesNothingAfterStop) {
  StreamPolicy policy(true, true);
  has_subscriber_ = true;
  start(policy);
  policy.stop();
  EXPECT_TRUE(policy.waitsForSubscriber()) << "it asks nobody any more";
  policy.setWanted(false);
  EXPECT_EQ(streaming_, true);
}

}  // namespace
}  // namespace aibo_driver::node
