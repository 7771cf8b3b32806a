#include "order_audit.h"

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/Movement.h>
#include <gmock/gmock.h>

#include <boost/crc.hpp>

#include "picture_audit.h"

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

TEST_F(OrderAuditTest, EachOrderHasOneEnd) {
  round_.ended.clear();
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("a command of /anna to head_pan has no end")));
  round_.ended = {{2.1, moving_, EndedMovement::DONE}, {2.2, moving_, EndedMovement::REPLACED}};
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("has ended (), but nobody gave it")));
}

TEST_F(OrderAuditTest, WhatIsDoneIsThere) {
  round_.ended[0].time = 1.3;
  EXPECT_THAT(judge(), Contains(HasSubstr("is done, but one of its joints is 0.")));
  round_.ended[0].how = EndedMovement::NOT_REACHED;
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, NothingMovesAtTheEnd) {
  round_.moving = {{"/bert", Movement::MOTION, "NOD.MTN"}};
  EXPECT_THAT(judge(), ElementsAre("/bert's motion NOD.MTN does not end"));
}

TEST(PictureAudit, FindsWhatIsWrong) {
  using Jpeg = std::vector<std::uint8_t>;
  std::vector<std::string> wrong;
  PictureAudit audit([&wrong](const std::string& violation) { wrong.push_back(violation); });
  for (std::uint8_t number = 1; number <= 5; ++number) {
    boost::crc_32_type crc;
    crc.process_bytes(Jpeg{number}.data(), 1);
    audit.sent("1000000000 1 " + std::to_string(crc.checksum()));
  }
  audit.setCalm(true);
  audit.published({1}, 1);
  audit.published({3}, 2);
  EXPECT_THAT(wrong, IsEmpty());
  EXPECT_EQ(audit.lostInCalm(), 1U);
  audit.published({3}, 3);
  audit.published({99}, 4);
  audit.published({4}, 4);
  EXPECT_THAT(wrong, ElementsAre("picture 3 after picture 3", HasSubstr("has not sent"), HasSubstr("stamp")));
}

}  // namespace
}  // namespace soak
