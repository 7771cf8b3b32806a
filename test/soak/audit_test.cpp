#include "order_audit.h"

#include <aibo_driver/Movement.h>
#include <gmock/gmock.h>

namespace soak {
namespace {

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
    round_.orders = {{"/anna", 1, {{"head_pan", kPan}}}};
    round_.accepted = {{1.1, "head_pan", kPan}};
    round_.begun = {{3, moving_}};
    round_.ended = {moving_};
  }

  std::vector<std::string> judge() {
    std::vector<std::string> violations;
    OrderAudit audit([&violations](const std::string& violation) { violations.push_back(violation); });
    audit.judge(round_);
    return violations;
  }

  const Moving moving_{3, "/anna", Movement::COMMAND, ""};
  Round round_;
};

TEST_F(OrderAuditTest, ARoundInWhichAllIsRightHasNoViolation) {
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, AfterAStopNoJointMovesUntilRelease) {
  round_.accepted.clear();
  round_.calls = {{"/bert", "stop", 0.9, 1.0, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("head_pan moved by 0.490 rad after the stop of /bert")));
  round_.calls = {{"/bert", "stop", 2.0, 2.1, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), IsEmpty());
  round_.calls = {{"/bert", "stop", 0.1, 0.2, true}, {"/carl", "release", 0.9, 1, true}};
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, TheRobotAcceptsNoTargetDuringAStop) {
  round_.calls = {{"/bert", "stop", 0.1, 0.2, true}, {"/bert", "release", 5, 5.1, true}};
  EXPECT_THAT(judge(), Contains(HasSubstr("the robot accepted a target of head_pan during the stop of /bert")));
}

TEST_F(OrderAuditTest, ACommandIsNotAcceptedLate) {
  round_.accepted[0].time = 1.9;
  EXPECT_THAT(judge(), ElementsAre(HasSubstr("a command of /anna that was 0.900 s old")));
  round_.accepted[0].joint = "mouth";
  EXPECT_THAT(judge(), IsEmpty());
}

TEST_F(OrderAuditTest, EachMovementEndsOnce) {
  round_.ended.clear();
  EXPECT_THAT(judge(), ElementsAre("/anna's command 3 has gone without an end"));
  round_.ended = {moving_, moving_};
  EXPECT_THAT(judge(), ElementsAre("/anna's command 3 has ended twice"));
}

TEST_F(OrderAuditTest, NothingMovesAtTheEnd) {
  round_.moving = {{4, "/bert", Movement::MOTION, "NOD.MTN"}};
  EXPECT_THAT(judge(), ElementsAre("/bert's motion 4 (NOD.MTN) does not end"));
}

}  // namespace
}  // namespace soak
