#include "rcserver/joints/JointControl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using protocol::version2::JointTargets;

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

TEST(JointControl, TheNextClientFindsTheRobotsOwnLimitsAndNoFaults) {
  JointControl joints(ers7());
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    joints.Planner().SetSpeedLimit(i, 300000);
    joints.Planner().SetAccelerationLimit(i, 300000);
    joints.Failed(i, JointWatch::LIMP);
  }
  joints.ClientGone();
  for (unsigned frame = 4; frame <= 2 * JointWatch::PATIENCE; frame += 4) {
    joints.Measured(0, {-100000, -100000, 0}, frame, true);
  }
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    EXPECT_EQ(joints.Planner().SpeedLimit(i), ers7().joints[i].highest_speed);
    EXPECT_EQ(joints.Planner().AccelerationLimit(i), defaultAcceleration(ers7().joints[i]));
    EXPECT_EQ(joints.TakeFault(i), JointWatch::FOLLOWS);
    EXPECT_FALSE(joints.TakeRecovery(i)) << "the next client does not know of the fault";
  }
}

TEST(JointControl, JointsThatHoldBrakeWithTheRobotsOwnAcceleration) {
  for (const bool client_goes : {false, true}) {
    JointControl joints(ers7());
    const int pan = findJointByName(ers7(), "head_pan");
    joints.Planner().SetAccelerationLimit(pan, 300000);
    joints.NextFrame();  // a lower one is in force when the joint stands
    protocol::version2::JointTargets target = {0, 1, {{joints.Identifier(pan), 1000000}}};
    joints.SetTargets(&target);
    for (int frame = 0; frame < 125; ++frame) {  // until it turns at 0.3 rad/s
      joints.NextFrame();
    }
    const int begin = joints.Planner().Position(pan);
    client_goes ? joints.ClientGone() : joints.Stop(pan);
    while (joints.AreMoving()) {
      joints.NextFrame();
    }
    EXPECT_LT(joints.Planner().Position(pan), begin + 20000) << "with the client's limit, it would be 0.15 rad";
  }
}

constexpr int kOrdered = 1000000;  // microradian; target of the joints of an order

// Two joints in an order, of which the first stays this far behind where it is planned to be, or ahead of it if the
// error is negative. Then it passes through its target.
class OrderedJoints {
 public:
  explicit OrderedJoints(int error, unsigned short duration_ms = 0) : error_(error) {
    JointTargets targets = {duration_ms, 2, {{joints.Identifier(kPan), kOrdered}, {joints.Identifier(kTail), 300000}}};
    joints.SetTargets(&targets, 7);
  }

  // Passes frames until an order ends, or for that long. Returns the end, such as "7 0: ".
  std::string pass(unsigned frames) {
    for (unsigned end = frame + frames; frame < end;) {
      joints.NextFrame();
      if (++frame % 4 == 0) {
        measure();
      }
      const std::string ended = takeEnd();
      if (!ended.empty()) {
        return ended;
      }
    }
    return takeEnd();
  }

  std::string takeEnd() {
    OrderBook::OrderEnd end = {};
    return joints.Orders().Take(&end) ? std::to_string(end.number) + " " + std::to_string(end.how) + ": " + end.reason
                                      : "";
  }

  JointControl joints{ers7()};
  const int kPan = findJointByName(ers7(), "head_pan");
  const int kTail = findJointByName(ers7(), "tail_pan");
  unsigned frame = 0;

 private:
  void measure() {
    for (int i = 0; i < joints.NumberOfJoints(); ++i) {
      const int planned = joints.Planner().Position(i);
      const bool is_far = i == kPan && planned > error_;
      joints.Measured(i, {is_far ? planned - error_ : planned, planned, 100}, frame, true);
    }
    joints.Measured(FallWatch::Reading(), frame);
  }

  int error_;
};

TEST(JointOrders, AreDoneOrRefusedByTheDistancesOfTheirJoints) {
  const std::pair<int, std::string> rows[] = {
      {0, "7 0: "},
      {40000, "7 0: "},
      {50000, "7 0: "},
      {60000, "7 3: head_pan stays 0.060 rad from its target"},
      {170000, "7 3: head_pan stays 0.170 rad from its target"},
      {200000, "7 3: head_pan does not follow"},
      {-40000, "7 0: "},
      {-60000, "7 3: head_pan stays 0.060 rad from its target"},
  };
  for (const auto& [error, end] : rows) {
    OrderedJoints ordered(error);
    EXPECT_EQ(ordered.pass(1000), end) << error;
    EXPECT_EQ(ordered.pass(300), "") << "once";
  }
}

TEST(JointOrders, AreJudgedFromTheEndOfTheirPlannedWaysForTwoSeconds) {
  for (const int error : {0, 60000, -60000}) {
    OrderedJoints ordered(error, 3000);
    EXPECT_EQ(ordered.pass(375 + 10), "") << "they may be near their targets long before, or pass through them";
    if (error != 0) {
      EXPECT_EQ(ordered.pass(240), "");
    }
    EXPECT_NE(ordered.pass(24), "");
  }
}

TEST(JointOrders, EndWhenNoneOfTheirJointsIsUnderWay) {
  const struct {
    const char* what;
    int error;
    unsigned frames;  // that pass before
    std::string commanded;
    std::string held;
    const char* end;
  } rows[] = {
      // joints are p (head_pan) and t (tail_pan)
      {"a part is taken and the rest arrives", 0, 2, "p", "", "7 0: "},
      {"a part is taken and the rest fails", 200000, 2, "t", "", "7 3: head_pan does not follow"},
      {"all are taken", 0, 2, "pt", "", "7 1: tail_pan was commanded"},
      {"a part is taken and the rest is held", 0, 2, "p", "t", "7 2: tail_pan was told to hold"},
      {"a joint fails and the rest is held", 200000, 200, "", "t", "7 3: head_pan does not follow"},
  };
  for (const auto& row : rows) {
    OrderedJoints ordered(row.error);
    const auto indexOf = [&ordered](char joint) { return joint == 'p' ? ordered.kPan : ordered.kTail; };
    ordered.joints.Planner().SetSpeedLimit(ordered.kTail, 50000);
    ordered.pass(row.frames);
    for (const char joint : row.commanded) {
      JointTargets targets = {0, 1, {{ordered.joints.Identifier(indexOf(joint)), -200000}}};
      ordered.joints.SetTargets(&targets, 8);
    }
    for (const char joint : row.held) {
      ordered.joints.Stop(indexOf(joint));
    }
    std::string ended = ordered.pass(1000);
    while (ended.rfind('8', 0) == 0) {
      ended = ordered.pass(1000);
    }
    EXPECT_EQ(ended, row.end) << row.what;
  }
}

constexpr int kFar = 2 * JointWatch::TOLERANCE;
constexpr int kMoved = JointWatch::MOVEMENT;
constexpr unsigned kPeriod = 4;
constexpr unsigned kPatience = JointWatch::PATIENCE;
constexpr int kPlace = -70001;

// Readings for a number of frames, relative to where the joint was at first, or until the watch finds a fault.
struct Watched {
  unsigned frames;
  int reference;
  int duty;
  JointWatch::Verdict verdict;  ///< at the end
  int step = 0;                 ///< by which the position grows from one reading to the next
};

TEST(JointWatch, JudgesAJointByItsReadings) {
  const std::map<std::string, std::vector<Watched>> cases = {
      {"a joint that pushes in vain for half a second is jammed, and again after another half second",
       {{kPatience - kPeriod, kFar, 512, JointWatch::FOLLOWS},
        {2 * kPeriod, kFar, 512, JointWatch::JAMMED},
        {kPatience - kPeriod, kFar, 512, JointWatch::FOLLOWS},
        {2 * kPeriod, kFar, 512, JointWatch::JAMMED}}},
      {"half the power is enough, in either direction", {{2 * kPatience, -kFar, -256, JointWatch::JAMMED}}},
      {"a joint that pushes with less does not follow", {{2 * kPatience, kFar, 255, JointWatch::UNCONTROLLABLE}}},
      {"a joint that lags behind but moves follows",
       {{10 * kPatience, 1000 * kFar, 512, JointWatch::FOLLOWS, kMoved / 10}}},
      {"a joint that hangs a little under its load follows",
       {{10 * kPatience, JointWatch::TOLERANCE, 512, JointWatch::FOLLOWS}}},
      {"rest counts as following, however long it lasts",
       {{10 * kPatience, 0, 0, JointWatch::FOLLOWS}, {kPatience - kPeriod, kFar, 512, JointWatch::FOLLOWS}}},
  };
  for (const auto& [name, readings] : cases) {
    JointWatch watch;
    unsigned frame = 0;
    int position = kPlace;
    watch.Reset(position, frame);
    for (const Watched& reading : readings) {
      JointWatch::Verdict verdict = JointWatch::FOLLOWS;
      for (unsigned passed = 0; passed < reading.frames && verdict == JointWatch::FOLLOWS; passed += kPeriod) {
        frame += kPeriod;
        position += reading.step;
        verdict = watch.Look({position, kPlace + reading.reference, reading.duty}, frame);
      }
      EXPECT_EQ(verdict, reading.verdict) << name << ", frame " << frame;
    }
  }
}

// The same reading for a number of frames.
struct Recovery {
  unsigned frames;
  int position;
  int reference;
  bool has_recovered;
};

TEST(JointRecovery, NeedsACommandThatIsFollowed) {
  const std::map<std::string, std::vector<Recovery>> cases = {
      {"a joint that has followed a command for half a second has recovered, once",
       {{kPatience - kPeriod, kMoved, kMoved, false},
        {2 * kPeriod, kMoved, kMoved, true},
        {10 * kPatience, kMoved, kMoved, false}}},
      {"a joint that is held has not recovered, however long it rests", {{100 * kPatience, 0, 0, false}}},
      {"a joint that is moved by hand has not recovered", {{10 * kPatience, JointWatch::TOLERANCE, 0, false}}},
      {"a joint that is commanded and does not move has not", {{10 * kPatience, 0, JointWatch::TOLERANCE, false}}},
      {"a joint that stays far behind has not", {{10 * kPatience, kMoved, kFar + kMoved, false}}},
      {"half a second begins again when it falls behind",
       {{kPatience - kPeriod, kFar, kFar, false},
        {kPeriod, kFar, 3 * kFar, false},
        {kPatience - kPeriod, kFar, kFar, false},
        {2 * kPeriod, kFar, kFar, true}}},
  };
  for (const auto& [name, readings] : cases) {
    JointRecovery recovery;
    unsigned frame = 0;
    recovery.Reset(kPlace, frame);
    recovery.Await();
    for (const Recovery& reading : readings) {
      bool has_recovered = false;
      for (unsigned passed = 0; passed < reading.frames && !has_recovered; passed += kPeriod) {
        frame += kPeriod;
        has_recovered = recovery.Look({kPlace + reading.position, kPlace + reading.reference, -3}, frame);
      }
      EXPECT_EQ(has_recovered, reading.has_recovered) << name << ", frame " << frame;
    }
  }
}

// docs/protocol.md promises these numbers. Other tests name them, so they would not see a wrong one.
TEST(JointNumbers, AreThoseOfTheDocument) {
  const double degree = std::acos(-1.0) / 180 * 1e6;
  EXPECT_NEAR(Walker::POSTURE_SPEED, 45 * degree, 1);
  EXPECT_NEAR(Walker::UNLOADED_SPEED, 90 * degree, 1);
  EXPECT_EQ(int{Walker::STEERING_FRAMES}, 63) << "500 ms";
  EXPECT_EQ(int{Walker::ATTEMPTS}, 6);
  EXPECT_NEAR(PlayedMotion::APPROACH_SPEED, 90 * degree, 1);
  EXPECT_NEAR(JointWatch::TOLERANCE, 10 * degree, 1);
  EXPECT_NEAR(JointWatch::MOVEMENT, degree, 1);
  EXPECT_EQ(unsigned{JointWatch::PATIENCE}, 63u) << "half a second";
  EXPECT_EQ(unsigned{FallWatch::PATIENCE}, 50u) << "0.4 s";
}

}  // namespace
