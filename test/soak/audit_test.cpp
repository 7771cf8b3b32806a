#include "order_audit.h"

#include <aibo_driver/Movement.h>
#include <gmock/gmock.h>

#include "support/version2_frames.h"
#include "wire_audit.h"

namespace soak {
namespace {

using aibo_driver::Movement;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using version2_frames::Bytes;
using version2_frames::encoded;
using version2_frames::makeFrame;

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

/// The robot has accepted 0.5 rad for the head.
class WireAuditTest : public ::testing::Test {
 protected:
  WireAuditTest() {
    hear({'x', 2, 0, 0});
    accept();
  }

  void hear(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      audit_.hear(0, &byte, 1, 5);
    }
  }

  void accept() { hear(makeFrame('j', 7, encoded(protocol::version2::JointTargets{0, 1, {{2, 500000}}}))); }

  void measure(int position) { hear(makeFrame('t', 0, version2_frames::makeTelemetry(1000, {{'J', 2, position}}))); }

  void arrive() {
    namespace version2 = protocol::version2;
    hear(makeFrame('i', 0, version2_frames::makeEnd(version2::ENDED_JOINTS, version2::END_DONE, "", "", 7)));
  }

  std::vector<std::string> wrong_;
  WireAudit audit_{[this](const std::string& violation) { wrong_.push_back(violation); }};
};

TEST_F(WireAuditTest, KnowsWhatTheRobotHasAccepted) {
  EXPECT_THAT(audit_.takeAccepted(), ElementsAre(AllOf(Field(&Accepted::joint, "head_pan"),
                                                       Field(&Accepted::target, 0.5), Field(&Accepted::time, 5))));
}

TEST_F(WireAuditTest, WhatIsDoneIsThere) {
  measure(460000);
  arrive();
  measure(300000);  // another order has taken it since
  EXPECT_THAT(wrong_, IsEmpty());
}

TEST_F(WireAuditTest, WhatIsNotThereIsNotDone) {
  measure(440000);
  arrive();
  measure(449000);
  EXPECT_THAT(wrong_, ElementsAre(HasSubstr("done, but one of them is 0.051")));

  wrong_.clear();
  accept();
  hear(makeFrame('e', 8, {}));  // it takes a posture, which may have taken the joint
  arrive();
  measure(449000);
  EXPECT_THAT(wrong_, IsEmpty());
}

}  // namespace
}  // namespace soak
