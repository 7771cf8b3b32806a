#include "node/joints/joint_commander.h"

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"
#include "node/orders.h"
#include "support/refusal.h"

namespace aibo_driver::node {
namespace {

using ::testing::HasSubstr;

constexpr std::uint32_t kHighest = std::numeric_limits<std::uint32_t>::max();

const ros::Time kArrival(1800000000, 500000000);

std::string refusalOf(const ros::Time& stamp, const ros::Time& now) {
  return test_support::refusalOf<aibo_client::InvalidArgumentException>([&] { waitBeforeStart(stamp, now); });
}

TEST(WaitBeforeStart, IsTheTimeUntilTheStamp) {
  EXPECT_EQ(waitBeforeStart(ros::Time(), kArrival), std::chrono::milliseconds(0));
  EXPECT_NEAR(static_cast<double>(waitBeforeStart(kArrival - ros::Duration(0.9), kArrival).count()), -0.9e9, 1e3);
  EXPECT_NEAR(static_cast<double>(waitBeforeStart(kArrival + ros::Duration(3599.5), kArrival).count()), 3599.5e9, 1e3);
}

TEST(WaitBeforeStart, IsRefusedForAStampThatCannotBeMeant) {
  EXPECT_THAT(refusalOf(kArrival - ros::Duration(1.1), kArrival), HasSubstr("1.100000 s ago"));
  EXPECT_THAT(refusalOf(kArrival + ros::Duration(3600.5), kArrival), HasSubstr("3600.500000 s ahead"));
  ros::Time garbage;
  garbage.sec = garbage.nsec = kHighest;
  EXPECT_THAT(refusalOf(garbage, kArrival), HasSubstr("s ahead"));
  EXPECT_THAT(refusalOf(ros::Time(kHighest, 0), ros::Time(5, 0)), HasSubstr("s ahead")) << "under /use_sim_time";
  EXPECT_THAT(refusalOf(ros::Time(1, 0), ros::Time(kHighest, 0)), HasSubstr("s ago"));
}

TEST(OrderOfGoal, IsThatOfTheNodeThatMadeItsId) {
  EXPECT_EQ(orderOfGoal("/node-3-1234.567").source, "/node");
  EXPECT_EQ(orderOfGoal("/my-node-12-1234.567").source, "/my-node");
  for (const char* const id : {"mine", "a-1", ""}) {
    EXPECT_EQ(orderOfGoal(id).source, id) << "not an id of actionlib";
  }
  EXPECT_EQ(orderOfGoal("/\x1b[2Jnode-3-1").source, "/?[2Jnode");
}

}  // namespace
}  // namespace aibo_driver::node
