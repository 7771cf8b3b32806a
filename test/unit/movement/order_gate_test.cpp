#include "movement/order_gate.h"

#include <gtest/gtest.h>

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;

SteadyTime at(int time) {
  return SteadyTime(milliseconds(100000 + time));
}

class OrderGateTest : public ::testing::Test {
 protected:
  // Of an order that acts some time after its receipt.
  std::string refusal(int received, int wait = 0) const {
    return gate_.refusal({"/user", at(received)}, at(received + wait));
  }

  OrderGate gate_;
};

TEST_F(OrderGateTest, LetsAnOrderPassUnlessItHasWaited) {
  EXPECT_EQ(refusal(0), "");
  EXPECT_EQ(refusal(0, 500), "");
  EXPECT_EQ(refusal(0, 730), "too old: it has waited for 0.7 s, and 0.5 s are allowed");
}

TEST_F(OrderGateTest, RefusesEverythingWhileStopped) {
  gate_.stop("/panel");
  EXPECT_EQ(refusal(10), "stopped by /panel; call release");
  EXPECT_EQ(gate_.refusal({"/user", at(10)}, at(10), true), "") << "to rest is allowed";
  gate_.stop("/joystick");
  EXPECT_EQ(refusal(20), "stopped by /joystick; call release");
  gate_.release();
  EXPECT_EQ(refusal(30), "");
  gate_.stop("/panel");
  EXPECT_EQ(refusal(40), "stopped by /panel; call release") << "again";
}

TEST_F(OrderGateTest, RefusesWhatIsOlderThanWhatOverruledIt) {
  gate_.overrule(at(100), "/user called sit");
  EXPECT_EQ(refusal(99, 20), "it came before /user called sit");
  EXPECT_EQ(refusal(100), "");
  gate_.overrule(at(50), "/other called stand");
  EXPECT_EQ(refusal(99, 20), "it came before /user called sit") << "the latest counts";
}

}  // namespace
}  // namespace aibo_driver::movement
