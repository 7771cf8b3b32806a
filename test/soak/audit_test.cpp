#include "order_audit.h"

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/Movement.h>
#include <gmock/gmock.h>

#include "order_user.h"

namespace soak {
namespace {

using aibo_driver::EndedMovement;
using aibo_driver::Movement;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPan = 0.7;

class OrderAuditTest : public ::testing::Test {
 protected:
  OrderAuditTest() {
    // The head is measured for 10 s. It goes to 0.7 rad at second 1, and is there at second 2.
    for (int i = 0; i <= 300; ++i) {
      const double time = i / 30.0;
      round_.measured.push_back({time, {{"head_pan", kPan * std::min(1.0, std::max(0.0, time - 1))}}});
    }
    round_.orders = {{"/anna", "command", 1, 0, {{"head_pan", kPan}}}};
    round_.sent = {{1.1, "head_pan", kPan}};
    round_.movements = {{1.0, {moving_}}, {2.1, {}}};
    round_.ended = {{2.1, moving_, EndedMovement::DONE}};
  }

  std::vector<std::string> judge() {
    std::vector<std::string> violations;
    OrderAudit audit([&violations](const std::string& violation) { violations.push_back(violation); },
                     {{"head_pan", {-1.5, 1.5}}});
    audit.judge(round_);
    return violations;
  }

  const Moving moving_{"/anna", Movement::COMMAND, "", {"head_pan"}};
  Round round_;
};

TEST_F(OrderAuditTest, ARoundInWhichAllIsRightHasNoViolation) {
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, TheEndsGoToTheOrdersThatNeedOne) {
  round_.orders = {{"/anna", "command", 0.2, 0, {{"head_pan", 0.1}}},
                   {"/anna", "command", 0.4, 0, {{"head_pan", 0.2}}},  // the same movement goes on
                   {"/anna", "command", 8, 0, {{"head_pan", kPan}}}};
  round_.ended = {{0.9, moving_, EndedMovement::REPLACED}, {8.1, moving_, EndedMovement::DONE}};
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, AfterAStopNoJointMovesUntilRelease) {
  round_.calls = {{"/bert", "stop", 0.9, 1.0, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), Contains(HasSubstr("head_pan moved by 0.490 rad after the stop of /bert")));
  round_.calls = {{"/bert", "stop", 2.0, 2.1, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), IsEmpty());
  round_.calls = {{"/bert", "stop", 0.1, 0.2, true}, {"/carl", "release", 0.9, 1, true}};
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, AnOrderDuringAStopDoesNotReachTheRobot) {
  round_.calls = {{"/bert", "stop", 0.1, 0.2, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), Contains(HasSubstr("a target of head_pan by /anna went to the robot during the stop of /bert")));
}

TEST_F(OrderAuditTest, ATargetThatLeavesLateIsAViolationUnlessTheDriverWasHeldUp) {
  round_.sent[0].time = 1.9;
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("a target of head_pan by /anna went to the robot 0.900 s late")));
  round_.faults = {{Fault::Kind::kDriverFrozen, 1.05, 1.5}};
  EXPECT_THAT(judge(), IsEmpty());
  round_.sent[0].time = 4;
  round_.faults = {{Fault::Kind::kDriverFrozen, 1.05, 3.9}};
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("late"))) << "it waited for too long";
}

TEST_F(OrderAuditTest, EachOrderHasOneEnd) {
  round_.ended.clear();
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("a command of /anna to head_pan has no end")));
  round_.ended = {{2.1, moving_, EndedMovement::DONE}, {2.2, moving_, EndedMovement::REPLACED}};
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("has ended as replaced (), but nobody gave it")));
}

TEST_F(OrderAuditTest, AnEndNeedNotNameJointsThatWereReplacedBefore) {
  const Moving both{"/anna", Movement::COMMAND, "", {"head_pan", "mouth"}};
  round_.orders.push_back({"/anna", "command", 3, 0, {{"head_pan", kPan}, {"mouth", -0.1}}});
  round_.orders.push_back({"/anna", "command", 4, 0, {{"head_pan", kPan}, {"mouth", -0.2}}});
  round_.ended.push_back({4.5, moving_, EndedMovement::DONE});
  round_.ended.push_back({5, both, EndedMovement::REPLACED});
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, EachCallIsAnswered) {
  round_.calls = {{"/anna", "stand", 1, 60, false, kNoAnswer}};
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("stand of /anna got no answer")));
}

TEST_F(OrderAuditTest, WhatIsDoneIsThere) {
  round_.ended[0].time = 1.3;
  EXPECT_THAT(judge(), Contains(HasSubstr("is done, but one of its joints is 0.")));
  round_.ended[0].how = EndedMovement::NOT_REACHED;
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, WhatMovesIsNamed) {
  round_.movements = {{0, {}}};
  round_.measured.clear();
  for (int i = 0; i <= 100; ++i) {
    round_.measured.push_back({i * 0.1, {{"head_pan", i < 10 ? 0 : kPan}}});
  }
  EXPECT_THAT(judge(), Contains(HasSubstr("head_pan moves, and motion_state does not say why")));
}

TEST_F(OrderAuditTest, WhatBeginsEnds) {
  const Moving nod{"/bert", Movement::MOTION, "NOD.MTN"};
  round_.movements = {{0.9, {nod}}, {1.0, {moving_, nod}}, {2.1, {nod}}};
  EXPECT_THAT(judge(), Contains(HasSubstr("/bert's motion NOD.MTN does not end")));
  round_.movements.push_back({3, {}});
  round_.ended.push_back({3, nod, EndedMovement::DONE});
  EXPECT_THAT(judge(), IsEmpty());
  round_.ended.push_back({3.1, nod, EndedMovement::DONE});
  EXPECT_THAT(judge(), Contains(HasSubstr("was done 2 times")));
}

TEST_F(OrderAuditTest, WhatWaitedInARobotThatWasHeldUpDoesNotMoveIt) {
  round_.measured.clear();
  for (int i = 0; i <= 100; ++i) {
    round_.measured.push_back({i * 0.1, {{"head_pan", i < 60 ? 0 : kPan}}});
  }
  round_.faults = {{Fault::Kind::kRobotFrozen, 0.5, 5}};
  EXPECT_THAT(judge(), Contains(HasSubstr("head_pan went where it was sent 4.9")));
}

TEST(UserLines, ComeBackAsTheyWere) {
  const UserLine order = parseUserLine(toText(Order{"/anna", "trajectory", 1234567890.125, 2, {{"mouth", -0.25}}}));
  ASSERT_TRUE(order.order);
  EXPECT_EQ(order.order->user, "/anna");
  EXPECT_EQ(order.order->time, 1234567890.125);
  EXPECT_EQ(order.order->targets.at("mouth"), -0.25);
  const UserLine call = parseUserLine(toText(Call{"/bert", "stop", 1, 2, true, "it holds"}));
  ASSERT_TRUE(call.call);
  EXPECT_TRUE(call.call->success);
  EXPECT_EQ(call.call->message, "it holds");
  EXPECT_EQ(parseUserLine(quietIn(3, "/carl")).quiet_in, 3u);
}

}  // namespace
}  // namespace soak
