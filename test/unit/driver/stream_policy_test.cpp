#include "ros/camera/stream_policy.h"

#include <gmock/gmock.h>

#include <optional>

namespace aibo_driver::node {
namespace {

class StreamPolicyTest : public ::testing::Test {
 protected:
  StreamPolicy makePolicy(bool wanted, bool on_demand) {
    return {wanted, on_demand, [this] { return has_subscriber_; }, [this](bool on) { streaming_ = on; }};
  }

  bool has_subscriber_ = false;
  std::optional<bool> streaming_;
};

TEST_F(StreamPolicyTest, StreamsFromTheStartWhenWanted) {
  StreamPolicy policy = makePolicy(true, false);
  EXPECT_FALSE(streaming_.has_value());
  policy.start();
  EXPECT_EQ(streaming_, true);
}

TEST_F(StreamPolicyTest, DoesNotStreamFromTheStartWhenNotWanted) {
  StreamPolicy policy = makePolicy(false, false);
  policy.start();
  EXPECT_EQ(streaming_, false);
  policy.setWanted(true);
  EXPECT_EQ(streaming_, true);
}

TEST_F(StreamPolicyTest, RemembersWhatWasWantedBeforeTheStart) {
  StreamPolicy policy = makePolicy(false, false);
  policy.setWanted(true);
  policy.subscribersChanged();
  EXPECT_FALSE(streaming_.has_value());
  policy.start();
  EXPECT_EQ(streaming_, true);
}

TEST_F(StreamPolicyTest, TogglingTellsWhatIsWantedNow) {
  StreamPolicy policy = makePolicy(true, false);
  policy.start();
  EXPECT_FALSE(policy.toggleWanted());
  EXPECT_EQ(streaming_, false);
  EXPECT_TRUE(policy.toggleWanted());
  EXPECT_EQ(streaming_, true);
}

TEST_F(StreamPolicyTest, OnDemandFollowsTheSubscribers) {
  StreamPolicy policy = makePolicy(true, true);
  policy.start();
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

TEST_F(StreamPolicyTest, OnDemandSubscribersGetNothingThatIsNotWanted) {
  StreamPolicy policy = makePolicy(true, true);
  policy.start();
  has_subscriber_ = true;
  policy.setWanted(false);
  policy.subscribersChanged();
  EXPECT_EQ(streaming_, false);
  EXPECT_FALSE(policy.waitsForSubscriber());
}

TEST_F(StreamPolicyTest, WithoutDemandSubscribersDoNotMatter) {
  StreamPolicy policy = makePolicy(true, false);
  policy.start();
  policy.subscribersChanged();
  EXPECT_EQ(streaming_, true);
  EXPECT_FALSE(policy.waitsForSubscriber());
}

TEST_F(StreamPolicyTest, DecidesNothingAfterStop) {
  StreamPolicy policy = makePolicy(true, false);
  policy.start();
  policy.stop();
  policy.setWanted(false);
  EXPECT_EQ(streaming_, true);
}

}  // namespace
}  // namespace aibo_driver::node
