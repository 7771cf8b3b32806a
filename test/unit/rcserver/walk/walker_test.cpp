// Walks, postures and falls: docs/protocol.md, "Walking and postures".
#include "rcserver/walk/Walker.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "motion_bytes.h"
#include "rcserver/joints/JointControl.h"

namespace {

using namespace protocol::version2;
using protocol::version2::Posture;
using protocol::version2::Velocity;
using robot_model::LegAngles;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr int kFramesASecond = 125;
constexpr int kDegree = 17453;  // microradian
constexpr double kGravity = 9.80665;
constexpr Velocity kAhead = {0.1, 0, 0};
constexpr FallWatch::Reading kUpright = {0.05, -0.08, kGravity, {true, true, true, true}};
constexpr FallWatch::Reading kOnItsSide = {0, kGravity, 0, {true, true, true, true}};
constexpr FallWatch::Reading kInTheAir = {0, 0, kGravity, {}};
const WalkGuard::Reading kFloor = {0.223, 2, 2, {}, {true, true, true, true}};
const WalkGuard::Reading kEdge = {0.9, 2, 2, {}, {true, true, true, true}};

// An ERS-7 that stands, and whose joints follow their commands. The lowest feet are on the floor if there is one.
struct WalkingRobot {
  WalkingRobot() {
    joints.Take(POSTURE_STAND);
    passUntilIdle();
    letGo();
    ends();
  }

  Walker& walker() { return joints.Walking(); }
  int joint(const std::string& name) const { return findJointByName(model, name.c_str()); }
  int position(int joint) { return joints.Planner().Position(joint); }
  int position(const std::string& name) { return position(joint(name)); }
  int positionInLeg(int leg, int number) {
    return position(joints.Find(legJointIdentifier(static_cast<robot_model::Leg>(leg), number)));
  }
  std::vector<int> positions() {
    std::vector<int> all;
    for (int i = 0; i < model.number_of_joints; ++i) {
      all.push_back(position(i));
    }
    return all;
  }

  void report() {
    FallWatch::Reading reading = feels;
    std::array<double, robot_model::NUMBER_OF_LEGS> feet{};
    for (int i = 0; i < robot_model::NUMBER_OF_LEGS; ++i) {
      const LegAngles angles = {positionInLeg(i, 0) * 1e-6, positionInLeg(i, 1) * 1e-6, positionInLeg(i, 2) * 1e-6};
      feet[static_cast<std::size_t>(i)] = findFoot(static_cast<robot_model::Leg>(i), angles).z;
    }
    for (std::size_t i = 0; i < feet.size(); ++i) {
      reading.paws[i] = reading.paws[i] && feet[i] < *std::min_element(feet.begin(), feet.end()) + 0.004;
    }
    walker().Measured(reading, positions().data(), frame);
    if (looks) {
      walker().HaveLooked(sees);
    }
  }
  void pass(int frames) {
    for (int i = 0; i < frames; ++i) {
      joints.NextFrame();
      if (++frame % 4 == 0) {
        report();
      }
    }
  }
  int passUntilIdle() {
    int frames = 0;
    for (; walker().IsActive() && frames < 3000; ++frames) {
      pass(1);
      if (walker().WantsMotorsOff()) {
        joints.MotorsGoOff();
      }
    }
    return frames;
  }

  // As the server does with each S. Returns why it is refused.
  std::string order(const Velocity& velocity, bool guarded = false) {
    const char* problem = velocity.isZero() ? nullptr : walker().ProblemOfWalk(true, guarded ? &velocity : nullptr);
    if (problem == nullptr) {
      joints.Steer(velocity, guarded, ++last_number);
    }
    return problem == nullptr ? "" : problem;
  }
  // As a client does: again and again. Returns the last answer.
  std::string steer(const Velocity& velocity, int frames = 2 * kFramesASecond, bool guarded = false) {
    std::string answer;
    for (int passed = 0; passed < frames; passed += 12) {
      answer = order(velocity, guarded);
      pass(std::min(12, frames - passed));
    }
    return answer;
  }
  void letGo() { order({0, 0, 0}); }
  void command(const std::string& name, int position) {
    JointTargets targets = {0, 1, {{joints.Identifier(joint(name)), position}}};
    joints.SetTargets(&targets);
  }
  void play(const std::string& key_frames, const std::string& name = "ANY.MTN") {
    protocol::MotionName motion_name;
    ASSERT_EQ(protocol::readMotionName(name.data(), name.size(), motion_name), nullptr);
    const std::string motion = motionBytes(key_frames);
    motion.copy(reinterpret_cast<char*>(joints.Motions().FindRoom()), motion.size());
    joints.ForgetOrders();
    ASSERT_EQ(joints.Play(motion_name, motion.size(), 1000, false, 1), nullptr);
  }
  void take(Posture posture) {
    joints.Take(posture);
    passUntilIdle();
  }

  bool walks() { return walker().State() == WALK_STATE_WALKS; }
  bool isIn(Posture posture) {
    for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
      const LegAngles& angles = postures.Legs(posture)[leg];
      const double values[] = {angles.rotator, angles.elevator, angles.knee};
      for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
        if (std::abs(positionInLeg(leg, number) - values[number] * 1e6) > 1) {
          return false;
        }
      }
    }
    return true;
  }
  // Such as "walk: left_front_knee was commanded".
  std::vector<std::string> ends() {
    std::vector<std::string> texts;
    for (OrderBook::OrderEnd end; joints.Orders().Take(&end);) {
      texts.push_back(std::string(end.name) + ": " + end.reason);
    }
    return texts;
  }

  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  JointControl joints{model};
  const Postures postures{Gait()};
  FallWatch::Reading feels = kUpright;
  WalkGuard::Reading sees = kFloor;
  bool looks = true;
  unsigned frame = 0;
  unsigned short last_number = 0;  ///< of the last order to walk
};

class Walk : public ::testing::Test, protected WalkingRobot {};

TEST_F(Walk, HasTheVelocityThatItIsSteeredWithAndEndsInTheStand) {
  steer({0.1, 0, 0.2});
  walker().TakeVelocity();
  steer({0.1, 0, 0.2}, 600);  // ten steps
  const Velocity velocity = walker().TakeVelocity();
  EXPECT_NEAR(velocity.forward, 0.1, 2e-3);
  EXPECT_NEAR(velocity.left, 0, 2e-3);
  EXPECT_NEAR(velocity.turn, 0.2, 5e-3);
  letGo();
  EXPECT_LT(passUntilIdle(), 1.2 * kFramesASecond);
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: "));
  walker().TakeVelocity();
  EXPECT_TRUE(walker().TakeVelocity().isZero());
}

TEST_F(Walk, IsATrotWhileItIsGuarded) {
  steer(kAhead);
  EXPECT_DOUBLE_EQ(joints.Steer({9, 0, 0}).forward, 0.3);
  EXPECT_DOUBLE_EQ(joints.Steer({9, 0, 0}, true).forward, 0.2);
}

TEST_F(Walk, EndsInTheStandIfItIsNotSteeredForHalfASecond) {
  steer(kAhead, 300);
  order(kAhead);
  walker().TakeVelocity();
  pass(62);
  EXPECT_NEAR(walker().TakeVelocity().forward, 0.1, 0.002);
  const int frames = passUntilIdle();
  EXPECT_GT(frames, 40);
  EXPECT_LT(frames, 1.2 * kFramesASecond);
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: it was not steered for 500 ms"));
}

enum class Legs { kHold, kStand, kSit };

struct WalkEnd {
  std::string why;
  std::function<void(WalkingRobot&)> event;
  Legs then;
};

const std::vector<WalkEnd> kWalkEnds = {
    {"left_front_knee was commanded", [](WalkingRobot& robot) { robot.command("left_front_knee", 500000); },
     Legs::kHold},
    {"everything was told to hold", [](WalkingRobot& robot) { robot.joints.StopAll(); }, Legs::kHold},
    {"left_hind_knee does not follow",
     [](WalkingRobot& robot) {
       const int place = robot.position("left_hind_knee");
       for (unsigned frame = 4; frame <= 2 * JointWatch::PATIENCE && robot.walker().IsActive(); frame += 4) {
         robot.joints.Measured(robot.joint("left_hind_knee"), {place, place + 400000, FULL_DUTY}, frame, true);
       }
     },
     Legs::kHold},
    {"the robot lies on its right side",
     [](WalkingRobot& robot) {
       robot.feels = kOnItsSide;
       robot.steer(kAhead, 72);
       robot.feels = kUpright;
       robot.steer(kAhead, 72);
     },
     Legs::kHold},
    {"the robot is carried",
     [](WalkingRobot& robot) {
       robot.feels = kInTheAir;
       robot.steer(kAhead, 60);
       robot.feels = kUpright;
       robot.steer(kAhead, 72);
     },
     Legs::kHold},
    {"the robot was told to take a posture", [](WalkingRobot& robot) { robot.joints.Take(POSTURE_SIT); }, Legs::kSit},
    {"the speed limit of right_hind_knee is too low for walking",
     [](WalkingRobot& robot) {
       robot.joints.Planner().SetSpeedLimit(robot.joint("right_hind_knee"), 3000000);
       robot.pass(1);
     },
     Legs::kStand},
    {"the floor ends ahead: turn, or walk back",
     [](WalkingRobot& robot) {
       robot.order(kAhead, true);
       robot.sees = kEdge;
       robot.pass(12);
       robot.sees = kFloor;
     },
     Legs::kStand},
};

TEST_F(Walk, EndsForEachOfTheseReasons) {
  for (const WalkEnd& row : kWalkEnds) {
    SCOPED_TRACE(row.why);
    WalkingRobot robot;
    robot.steer(kAhead);
    row.event(robot);
    robot.pass(row.then == Legs::kHold ? 40 : 0);
    EXPECT_EQ(robot.walker().IsActive(), row.then != Legs::kHold);
    EXPECT_EQ(robot.joints.AreMoving(), row.then != Legs::kHold);
    robot.letGo();  // changes nothing, also for a posture that waits for the stand
    robot.passUntilIdle();
    EXPECT_THAT(robot.ends(), Contains(StartsWith("walk: " + row.why)));
    EXPECT_EQ(robot.isIn(POSTURE_STAND), row.then == Legs::kStand);
    EXPECT_EQ(robot.isIn(POSTURE_SIT), row.then == Legs::kSit);
  }
}

// A client that steers on and on would start the walk again at once.
TEST_F(Walk, HasToBeLetGoFirstAfterEachOfTheseEnds) {
  for (const WalkEnd& row : kWalkEnds) {
    SCOPED_TRACE(row.why);
    WalkingRobot robot;
    robot.steer(kAhead);
    row.event(robot);
    for (int i = 0; i < 10; ++i) {
      EXPECT_THAT(robot.order(kAhead), AllOf(StartsWith(row.why), HasSubstr("let go first: send zero velocities")));
      robot.pass(100);  // silence does not count as letting go: a frozen link looks the same
    }
    robot.letGo();
    robot.steer(kAhead, 1000);
    EXPECT_TRUE(robot.walks());
  }
}

TEST_F(Walk, ThatIsEndingIsReplacedByTheNextOneWithoutABreak) {
  for (const WalkEnd& row : kWalkEnds) {
    if (row.then == Legs::kHold) {
      continue;
    }
    SCOPED_TRACE(row.why);
    WalkingRobot robot;
    const int walk = robot.last_number + 1;
    robot.steer(kAhead);
    row.event(robot);
    const bool has_ended = row.then == Legs::kSit;
    EXPECT_EQ(robot.walker().WalkNumber(), has_ended ? 0 : walk);
    EXPECT_EQ(robot.ends().empty(), !has_ended);
    robot.letGo();
    EXPECT_EQ(robot.order(kAhead), "");
    EXPECT_THAT(robot.ends(), ElementsAre(has_ended ? "sit: the robot was told to walk" : "walk: " + row.why));
    EXPECT_EQ(robot.walker().WalkNumber(), robot.last_number);
    EXPECT_TRUE(robot.walks());
    robot.steer(kAhead);
    EXPECT_THAT(robot.ends(), IsEmpty());
  }
}

TEST_F(Walk, IsNotEndedByACommandToTheHead) {
  steer(kAhead);
  command("head_pan", 500000);
  joints.Stop(joint("tail_pan"));
  steer(kAhead);
  EXPECT_TRUE(walks());
  EXPECT_EQ(position("head_pan"), 500000);
}

TEST_F(Walk, SetsSpeedLimitsBackThatAreTooLowForIt) {
  joints.Planner().SetSpeedLimit(joint("right_hind_knee"), 3000000);
  EXPECT_EQ(walker().Problem(POSTURE_SIT), nullptr) << "postures are slow";
  steer(kAhead);
  EXPECT_TRUE(walks());
}

TEST_F(Walk, TakesTheLegsFromAMotion) {
  play("at 0 right_hind_knee 60\nat 800 right_hind_knee 80\n");
  letGo();
  order(kAhead);
  EXPECT_THAT(ends(), ElementsAre("ANY.MTN: the robot was told to walk or to take a posture"));
}

TEST_F(Walk, WithoutTheGuardMindsNoEdge) {
  sees = kEdge;
  steer(kAhead);
  EXPECT_TRUE(walks());
}

TEST_F(Walk, IsGuardedOnlyWhereTheRobotHasNotBeenMovedSince) {
  const std::pair<std::string, std::function<void(WalkingRobot&)>> rows[] = {
      {"where it was", [](WalkingRobot&) {}},
      {"lifted", [](WalkingRobot& robot) { robot.feels = kInTheAir; }},
      {"fallen", [](WalkingRobot& robot) { robot.feels = kOnItsSide; }},
      {"held", [](WalkingRobot& robot) { robot.joints.StopAll(); }},
      {"seated", [](WalkingRobot& robot) { robot.take(POSTURE_SIT); }},
      {"walked without the guard",
       [](WalkingRobot& robot) {
         robot.steer(kAhead);
         robot.letGo();
         robot.passUntilIdle();
       }},
  };
  for (const auto& [name, change] : rows) {
    WalkingRobot robot;
    robot.sees = kEdge;
    robot.steer(kAhead, 250, true);
    robot.passUntilIdle();
    robot.letGo();
    change(robot);
    robot.pass(80);
    robot.looks = false;
    robot.feels = kUpright;
    robot.pass(80);
    robot.take(POSTURE_STAND);
    robot.letGo();
    EXPECT_EQ(robot.order(kAhead, true).empty(), name != "where it was") << name;
  }
}

class PostureOfARobot : public ::testing::Test, protected WalkingRobot {};

TEST_F(PostureOfARobot, IsTakenSlowlyFromEveryOther) {
  for (const Posture from : {POSTURE_STAND, POSTURE_SIT, POSTURE_REST}) {
    for (const Posture to : {POSTURE_STAND, POSTURE_SIT, POSTURE_REST}) {
      WalkingRobot robot;
      robot.take(from);
      robot.ends();
      robot.joints.Take(to);
      while (robot.walker().IsActive()) {
        const std::vector<int> before = robot.positions();
        robot.pass(1);
        for (std::size_t i = 0; i < before.size(); ++i) {
          EXPECT_LT(std::abs(robot.positions()[i] - before[i]) * kFramesASecond, 1.2 * Walker::POSTURE_SPEED);
        }
        if (robot.walker().WantsMotorsOff()) {
          robot.joints.MotorsGoOff();
        }
      }
      EXPECT_TRUE(robot.isIn(to)) << from << " to " << to;
      EXPECT_EQ(robot.walker().Now(robot.positions().data()), to);
      EXPECT_THAT(robot.ends(), ElementsAre(std::string(postureName(to)) + ": "));
    }
  }
}

TEST_F(PostureOfARobot, IsReachedFasterWhileTheLegsDoNotCarryItAndWhileItRolls) {
  for (const bool rolls : {false, true}) {
    WalkingRobot robot;
    for (const std::string side : {"left", "right"}) {
      robot.command(side + "_front_rotator", -90 * kDegree);
      robot.command(side + "_hind_rotator", 90 * kDegree);
      robot.command(side + "_front_knee", 120 * kDegree);
      robot.command(side + "_hind_knee", 120 * kDegree);
    }
    robot.feels = rolls ? kOnItsSide : kUpright;
    robot.pass(200);
    robot.joints.Take(POSTURE_STAND);
    int fastest = 0;
    for (int passed = 0; passed < 300; ++passed) {
      const std::vector<int> before = robot.positions();
      robot.pass(1);
      for (std::size_t i = 0; i < before.size(); ++i) {
        fastest = std::max(fastest, std::abs(robot.positions()[i] - before[i]) * kFramesASecond);
      }
    }
    EXPECT_NEAR(fastest, 1.1 * (rolls ? 180 : 90) * kDegree, 0.1 * (rolls ? 180 : 90) * kDegree);
  }
}

TEST_F(PostureOfARobot, IsToldAlsoWhereItIsNoneOfTheThree) {
  const auto now = [this] { return walker().Now(positions().data()); };
  joints.Take(POSTURE_SIT);
  for (int i = 0; i < 300 && now() == POSTURE_STAND; ++i) {
    pass(1);
  }
  EXPECT_EQ(now(), POSTURE_UNKNOWN) << "on the way";
  letGo();
  steer(kAhead);
  steer(kAhead);
  EXPECT_EQ(now(), POSTURE_WALK);
  feels = kInTheAir;
  pass(60);
  EXPECT_EQ(now(), POSTURE_CARRIED);
  EXPECT_THAT(walker().Problem(POSTURE_STAND), HasSubstr("carried"));
  feels = kOnItsSide;
  pass(80);
  EXPECT_EQ(now(), POSTURE_FALLEN);
}

TEST_F(PostureOfARobot, IsReplacedByLaterOrders) {
  const std::pair<std::string, std::function<void(WalkingRobot&)>> rows[] = {
      {"sit: everything was told to hold", [](WalkingRobot& robot) { robot.joints.StopAll(); }},
      {"sit: the robot was told to walk", [](WalkingRobot& robot) { robot.joints.Steer(kAhead); }},
      {"sit: the robot lies on its right side",
       [](WalkingRobot& robot) {
         robot.feels = kOnItsSide;
         robot.pass(100);
       }},
  };
  for (const auto& [end, event] : rows) {
    for (const bool waits_for_a_walk : {false, true}) {
      WalkingRobot robot;
      waits_for_a_walk ? static_cast<void>(robot.steer(kAhead)) : robot.pass(0);
      robot.joints.Take(POSTURE_SIT);
      robot.pass(20);
      event(robot);
      EXPECT_THAT(robot.ends(), Contains(end));
      robot.feels = kUpright;
      robot.letGo();
      robot.passUntilIdle();
      EXPECT_FALSE(robot.isIn(POSTURE_SIT));
    }
  }
}

TEST_F(PostureOfARobot, MayGiveWayToAJointThatDoesNotFollowSixTimes) {
  take(POSTURE_REST);
  joints.Take(POSTURE_STAND);
  pass(20);
  const int knee = joint("left_hind_knee");
  EXPECT_FALSE(walker().TriesAnotherRoute(joint("head_pan")));
  const JointReading stuck = {position(knee) + 300000, position(knee), -FULL_DUTY};
  joints.Measured(knee, stuck, 1000, true);
  EXPECT_EQ(joints.Measured(knee, stuck, 2000, true), JointWatch::FOLLOWS);
  EXPECT_EQ(position(knee), stuck.position) << "it gives way";
  pass(2);
  EXPECT_GT(joints.Planner().Target(joint("right_front_elevator")), 1400000) << "it spreads its legs";
  for (int i = 2; i < 6; ++i) {
    EXPECT_TRUE(walker().TriesAnotherRoute(knee));
    pass(4);
  }
  EXPECT_FALSE(walker().TriesAnotherRoute(knee));
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
}

TEST_F(PostureOfARobot, EndsIfItStillLiesOnItsSideAfterItHasRolled) {
  feels = kOnItsSide;
  pass(100);
  ends();
  take(POSTURE_STAND);
  OrderBook::OrderEnd end{};
  ASSERT_TRUE(joints.Orders().Take(&end));
  EXPECT_STREQ(end.name, "stand");
  EXPECT_EQ(end.how, 4) << end.reason;
}

class Rest : public ::testing::Test, protected WalkingRobot {};

TEST_F(Rest, LeavesAJointOfTheHeadAsALaterOrderSays) {
  const std::pair<std::string, std::function<void(WalkingRobot&)>> orders[] = {
      {"command", [](WalkingRobot& robot) { robot.command("head_pan", 20 * kDegree); }},
      {"motion", [](WalkingRobot& robot) { robot.play("at 0 head_pan 20\nat 80 head_pan 20\n"); }},
      {"hold", [](WalkingRobot& robot) { robot.joints.Stop(robot.joint("head_pan")); }},
  };
  for (const auto& [order, give] : orders) {
    WalkingRobot robot;
    for (const char* name : {"head_pan", "neck_tilt", "head_tilt"}) {
      robot.command(name, (name == std::string("neck_tilt") ? -20 : 20) * kDegree);
    }
    robot.pass(100);
    robot.take(POSTURE_SIT);
    robot.joints.Take(POSTURE_REST);
    robot.pass(10);  // it stands up first
    give(robot);
    robot.passUntilIdle();
    EXPECT_NEAR(robot.position("head_pan"), 20 * kDegree, 100) << order;
    EXPECT_EQ(robot.position("neck_tilt"), -174533) << "the others are levelled";
    EXPECT_EQ(robot.position("head_tilt"), 0) << "the others are levelled";
  }
}

class ClientThatGoes : public ::testing::Test, protected WalkingRobot {};

TEST_F(ClientThatGoes, LeavesARobotThatStands) {
  steer(kAhead);
  play("at 0 head_pan 0\nat 1600 head_pan 40\n", "HEAD.MTN");
  command("tail_tilt", 1000000);
  pass(5);
  joints.ClientGone();
  EXPECT_TRUE(walker().IsActive());
  EXPECT_FALSE(joints.Motions().IsPlaying());
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_LT(position("tail_tilt"), 500000) << "it stops at once";
  EXPECT_THAT(ends(), IsEmpty()) << "the next client has nothing to do with it";
}

TEST_F(ClientThatGoes, EndsAPostureAndOneThatWaitsForAWalk) {
  joints.Take(POSTURE_SIT);
  pass(50);
  joints.ClientGone();
  EXPECT_FALSE(walker().IsActive());
  pass(30);
  EXPECT_FALSE(joints.AreMoving());
  letGo();
  steer(kAhead, 600);
  joints.Take(POSTURE_SIT);
  joints.ClientGone();
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), IsEmpty());
}

TEST_F(ClientThatGoes, LeavesARestThatHasBegunToTheRobot) {
  for (const bool walks_first : {false, true}) {
    WalkingRobot robot;
    robot.command("head_pan", 500000);
    walks_first ? static_cast<void>(robot.steer(kAhead)) : robot.pass(100);
    robot.joints.Take(POSTURE_REST);
    robot.pass(60);
    robot.joints.ClientGone();
    robot.passUntilIdle();
    EXPECT_TRUE(robot.isIn(POSTURE_REST));
    EXPECT_EQ(robot.position("head_pan"), 0);
    EXPECT_THAT(robot.ends(), ElementsAre("rest: "))
        << "without a number, because the next client has not asked for it";
    robot.take(POSTURE_STAND);
    EXPECT_THAT(robot.ends(), ElementsAre("stand: ")) << "this is its own";
  }
}

class Fall : public ::testing::Test, protected WalkingRobot {};

TEST_F(Fall, LeavesLegsAloneThatSomethingElseHasMovedSince) {
  const std::function<void()> orders[] = {[this] { play("at 0 left_front_knee 60\nat 80 left_front_knee 80\n"); },
                                          [this] { command("left_front_knee", 500000); }, [this] { joints.StopAll(); }};
  for (const auto& order : orders) {
    steer(kAhead);
    order();
    feels = kOnItsSide;
    pass(400);
    EXPECT_FALSE(walker().WantsMotorsOff());
    joints.Motions().Stop(protocol::MotionName{});
    feels = kUpright;
    pass(100);
  }
}

TEST_F(Fall, OfARobotThatCannotGetUpIsGivenUpAfterSixAttempts) {
  command("neck_tilt", -20 * kDegree);
  feels = kOnItsSide;
  pass(100);
  joints.Take(POSTURE_STAND);
  EXPECT_GT(passUntilIdle(), 6 * kFramesASecond);
  EXPECT_EQ(position("neck_tilt"), -174533) << "its head is levelled";
  EXPECT_THAT(ends(), ElementsAre("stand: the robot lies on its right side"));
}

TEST_F(Fall, WhileTheRobotStandsUpMakesItTryAgain) {
  const auto framesToStand = [](int frames_on_its_side) {
    WalkingRobot robot;
    robot.feels = kOnItsSide;
    robot.pass(100);
    robot.joints.Take(POSTURE_STAND);
    robot.pass(200);
    robot.feels = kUpright;
    robot.pass(300);
    robot.feels = kOnItsSide;
    robot.pass(frames_on_its_side);
    robot.feels = kUpright;
    const int frames = frames_on_its_side + robot.passUntilIdle();
    EXPECT_TRUE(robot.isIn(POSTURE_STAND));
    return frames;
  };
  EXPECT_EQ(framesToStand(24), framesToStand(0)) << "a knock";
  EXPECT_GT(framesToStand(80), framesToStand(0) + 100) << "a fall";
}

}  // namespace
