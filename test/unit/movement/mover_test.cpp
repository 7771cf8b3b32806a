// Orders, stop and ends: docs/ros_interface.md, "Guard rails", "Stop", "motion_state" and "Walking".
#include "movement/mover.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::movement {
namespace {

using aibo_client::CommandException;
using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::FaultKind;
using aibo_client::MotorState;
using aibo_client::NetworkException;
using aibo_client::Posture;
using aibo_client::PostureNow;
using aibo_client::RefusalCause;
using aibo_client::RefusedRequest;
using aibo_client::TimeoutException;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;
using namespace std::chrono_literals;
using Kind = Movement::Kind;
using std::chrono::milliseconds;

constexpr int kHeadPan = 2;  // its identifier
constexpr const char* kLetGo = "; let go first: 0, or nothing for 0.5 s";

// How it ended and why, in the words of docs/ros_interface.md.
std::string textOf(const EndedMovement* ended) {
  constexpr const char* kHow[] = {"DONE", "REPLACED", "STOPPED", "REFUSED", "FELL", "UNKNOWN", "NOT_REACHED", "LOST"};
  return ended == nullptr ? "-"
                          : kHow[static_cast<int>(ended->how)] + (ended->reason.empty() ? "" : " " + ended->reason);
}
std::string textOf(const Mover::Begun& begun) {
  return textOf(begun.ended());
}

[[noreturn]] void doNotAnswer() {
  throw TimeoutException("no answer within 2000 ms.", FaultKind::kNone, true);
}

std::vector<std::string> withoutSpeedLimits(std::vector<std::string> told) {
  told.erase(std::remove_if(told.begin(), told.end(), [](const auto& text) { return text[0] == 'V'; }), told.end());
  return told;
}

// A robot that stands with all joints at 0, and says nothing by itself. Time stands still unless a test lets it pass.
struct Robot {
  Robot() {
    client.present.robot.capabilities = {"I", "S", "E", "O"};
    mover.setListener({nullptr, nullptr, [this](const EndedMovement& ended) { ends.push_back(ended); },
                       [this](const std::string& text) { warnings.push_back(text); }});
    mover.connected();
    mover.robotChanged({MotorState::kOn, PostureNow::kStanding});
    measure(0);
  }

  void measure(double pan) {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = now;
    for (const JointProperties& joint : table.joints()) {
      telemetry.joints.push_back({joint.id, joint.id == kHeadPan ? pan : std::clamp(0.0, joint.lowest, joint.highest)});
    }
    measured.update(telemetry);
  }
  void pass(milliseconds time, double pan = 0) {
    for (const SteadyTime end = now + time; now < end; mover.goOn()) {
      now += JointPlan::kPeriod;
      measure(pan);
    }
  }

  Order order(const std::string& source = "/user") const { return {source, now}; }
  Mover::Begun command(const std::string& joint, double position, const std::string& source = "/user") {
    return mover.command(order(source), {joint}, {position}, {});
  }
  Mover::Begun follow(const std::string& joint, double position) {
    return mover.follow(order(), {{joint}, {{1.0, {position}, {}}}}, 0ms);
  }
  Mover::Begun play(const std::string& motion) { return mover.play(order(), motion, 1); }
  Mover::Begun sit() { return mover.takePosture(order(), Posture::kSit); }
  void steer(double forward, const std::string& source = "/teleop") { mover.steer(order(source), {forward, 0, 0}); }
  void walk() {
    steer(0.1);
    mover.steered({0.1, 0, 0}, client.steering_order);
  }
  Mover::Begun walkToGoal() {
    const Mover::Begun begun = mover.walkToGoal(order(), "1 m ahead");
    EXPECT_TRUE(mover.walkOn(begun.id, {0.1, 0, 0}));
    mover.steered({0.1, 0, 0}, client.steering_order);
    return begun;
  }
  void refuses(RefusedRequest request, RefusalCause cause, const std::string& reason, std::uint64_t order = 0) {
    mover.refused({request, cause, {kHeadPan}, reason, order});
  }
  // What it was told since the last call, without speed limits.
  std::vector<std::string> told() { return withoutSpeedLimits(std::exchange(client.told, {})); }
  std::string lastEnd() const { return textOf(ends.empty() ? nullptr : &ends.back()); }
  test_support::FakeClient client;
  SteadyTime now{1000s};
  JointTable table{"ERS-7", 3.0};
  MeasuredJoints measured{table};
  bool telemetry_wanted = true;
  Mover mover{table, measured, client, 0.5, false, [this] { return telemetry_wanted; }, [this] { return now; }};
  std::vector<EndedMovement> ends;
  std::vector<std::string> warnings;
};

class MoverTest : public ::testing::Test, protected Robot {};

// What may happen to a robot, for the tables below.
const std::map<std::string, std::function<void(Robot&)>> kEvents = {
    {"stop", [](Robot& robot) { robot.mover.stop(robot.order("/panel")); }},
    {"release", [](Robot& robot) { robot.mover.release(robot.order("/panel")); }},
    {"empty trajectory", [](Robot& robot) { robot.mover.hold(robot.order(), "an empty trajectory came"); }},
    {"motors off", [](Robot& robot) { robot.mover.setMotors(robot.order("/panel"), false); }},
    {"motors on", [](Robot& robot) { robot.mover.setMotors(robot.order("/panel"), true); }},
    {"motors go off",
     [](Robot& robot) {
       robot.mover.robotChanged({MotorState::kOff, PostureNow::kStanding});
     }},
    {"rest", [](Robot& robot) { robot.mover.takePosture(robot.order("/panel"), Posture::kRest); }},
    {"sit", [](Robot& robot) { robot.sit(); }},
    {"head command", [](Robot& robot) { robot.command("head_pan", 0.1, "/other"); }},
    {"head trajectory", [](Robot& robot) { robot.follow("head_pan", 0.1); }},
    {"leg command", [](Robot& robot) { robot.command("left_front_knee", 0.1, "/other"); }},
    {"leg trajectory", [](Robot& robot) { robot.follow("left_front_knee", 0.1); }},
    {"motion", [](Robot& robot) { robot.play("WAG.MTN"); }},
    {"motions stopped", [](Robot& robot) { robot.mover.stopMotion(robot.order(), ""); }},
    {"velocity", [](Robot& robot) { robot.steer(0.05); }},
    {"goal", [](Robot& robot) { robot.walkToGoal(); }},
    {"disconnected", [](Robot& robot) { robot.mover.disconnected(); }},
    {"reconnected",
     [](Robot& robot) {
       robot.mover.disconnected();
       ++robot.client.connections;
       robot.mover.connected();
     }},
    {"version 1",
     [](Robot& robot) {
       robot.client.can_hold = false;
       robot.client.present.protocol_version = 1;
       robot.client.present.robot.capabilities.clear();
     }},
    {"reconnected unnoticed", [](Robot& robot) { ++robot.client.connections; }},
    {"no robot", [](Robot& robot) { robot.client.problem = "there is no robot"; }},
    {"an ERS-210", [](Robot& robot) { robot.client.present.robot.design = "ERS-210"; }},
    {"no telemetry", [](Robot& robot) { robot.telemetry_wanted = false; }},
    {"time passes", [](Robot& robot) { robot.pass(600ms); }},
    {"held up", [](Robot& robot) { robot.now += 501ms; }},
    {"fallen",
     [](Robot& robot) {
       robot.mover.robotChanged({MotorState::kOn, PostureNow::kFallen});
     }},
    {"lifted",
     [](Robot& robot) {
       robot.mover.robotChanged({MotorState::kOn, PostureNow::kCarried});
     }},
    {"walk fell",
     [](Robot& robot) {
       robot.mover.ended({EndedKind::kWalk, EndedHow::kFell, "walk", "it fell"});
     }},
    {"walk done",
     [](Robot& robot) {
       robot.mover.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
     }},
    {"edge",
     [](Robot& robot) {
       robot.mover.ended({EndedKind::kWalk, EndedHow::kRefused, "walk", "an edge"});
     }},
    {"legs taken",
     [](Robot& robot) {
       robot.mover.ended({EndedKind::kWalk, EndedHow::kReplaced, "walk", "a leg"});
     }},
    {"posture done",
     [](Robot& robot) {
       robot.mover.ended({EndedKind::kPosture, EndedHow::kDone, "sit", ""});
     }},
    {"joints refused", [](Robot& robot) { robot.refuses(RefusedRequest::kJoints, RefusalCause::kRobot, "no"); }},
    {"joint jams", [](Robot& robot) { robot.refuses(RefusedRequest::kJoints, RefusalCause::kJointFault, "a jam"); }},
    {"walk refused",
     [](Robot& robot) {
       robot.refuses(RefusedRequest::kWalk, RefusalCause::kRobot, "no; let go first: send zero velocities");
     }},
    {"velocity too late", [](Robot& robot) { robot.refuses(RefusedRequest::kWalk, RefusalCause::kTooOld, "late"); }},
};

void happen(Robot& robot, const std::vector<std::string>& events) {
  for (const std::string& event : events) {
    kEvents.at(event)(robot);
  }
}

// ---- Ends

TEST(Ends, OfACommandAreThoseOfTheTable) {
  const struct {
    const char* end;
    std::vector<std::string> events;
    double measured;  // the joint is sent to 0.5 rad
  } rows[] = {
      {"DONE", {}, 0.47},
      {"NOT_REACHED head_pan is 0.50 rad from where it was sent", {}, 0},
      {"NOT_REACHED a jam (head_pan is 0.50 rad from where it was sent)", {"joint jams"}, 0},
      {"REFUSED no", {"joints refused"}, 0},
      {"REPLACED head_pan was commanded to go elsewhere", {"head command"}, 0},
      {"STOPPED /panel called stop", {"stop"}, 0},
      {"STOPPED the motors are off", {"motors go off"}, 0},
      {"LOST the connection to the robot was lost; the movement will not be resumed", {"disconnected"}, 0},
  };
  for (const auto& row : rows) {
    Robot robot;
    const auto begun = robot.command("head_pan", 0.5);
    happen(robot, row.events);
    robot.pass(3200ms, row.measured);
    EXPECT_EQ(textOf(begun), row.end);
  }
}

const std::vector<std::pair<std::string, std::function<void(Robot&)>>> kMovements = {
    {"command", [](Robot& robot) { robot.command("head_pan", 0.5); }},
    {"trajectory", [](Robot& robot) { robot.follow("head_pan", 0.5); }},
    {"leg", [](Robot& robot) { robot.command("left_front_knee", 0.5); }},
    {"leg's trajectory", [](Robot& robot) { robot.follow("left_front_knee", 0.5); }},
    {"motion", [](Robot& robot) { robot.play("NOD.MTN"); }},
    {"posture", [](Robot& robot) { robot.sit(); }},
    {"walk", [](Robot& robot) { robot.walk(); }},
    {"goal", [](Robot& robot) { robot.walkToGoal(); }},
};

TEST(Ends, OfWhatIsUnderWayComeFromTheseEvents) {
  const struct {
    const char* event;
    const char* ends;  // of each of kMovements; "-": it goes on, or the robot says how it ends
  } rows[] = {
      {"stop", "STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED"},
      {"empty trajectory", "STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED"},
      {"motors off", "STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED STOPPED"},
      {"motors go off", "STOPPED STOPPED STOPPED STOPPED - - - -"},
      {"disconnected", "LOST LOST LOST LOST LOST LOST LOST LOST"},
      {"reconnected unnoticed", "LOST LOST LOST LOST LOST LOST LOST LOST"},
      {"head command", "REPLACED REPLACED - - - - - -"},
      {"head trajectory", "REPLACED REPLACED - - - - - -"},
      {"leg command", "- - REPLACED REPLACED - - - -"},
      {"leg trajectory", "- - REPLACED REPLACED - - - -"},
      {"motion", "- REPLACED - REPLACED - - - -"},
      {"motions stopped", "- - - - STOPPED - - -"},
      {"sit", "- - REPLACED REPLACED - - - -"},
      {"velocity", "- - REPLACED REPLACED - - - REPLACED"},
      {"goal", "- - REPLACED REPLACED - - REPLACED REPLACED"},
  };
  for (const auto& row : rows) {
    std::istringstream expected(row.ends);
    for (const auto& [movement, begin] : kMovements) {
      Robot robot;
      begin(robot);
      happen(robot, {row.event});
      robot.mover.goOn();
      std::string end;
      expected >> end;
      EXPECT_THAT(textOf(robot.ends.empty() ? nullptr : &robot.ends[0]), StartsWith(end))
          << row.event << ", " << movement;
    }
  }
}

TEST(Ends, OfWhatTheRobotMovesAreWhatItSays) {
  const struct {
    EndedKind kind;
    const char* name;
    std::function<Mover::Begun(Robot&)> begin;
  } rows[] = {{EndedKind::kMotion, "NOD.MTN", [](Robot& robot) { return robot.play("NOD.MTN"); }},
              {EndedKind::kPosture, "sit", [](Robot& robot) { return robot.sit(); }},
              {EndedKind::kWalk, "walk", [](Robot& robot) { return robot.walkToGoal(); }}};
  for (const auto& row : rows) {
    for (const EndedHow how :
         {EndedHow::kDone, EndedHow::kReplaced, EndedHow::kStopped, EndedHow::kRefused, EndedHow::kFell}) {
      Robot robot;
      const Mover::Begun begun = row.begin(robot);
      robot.mover.ended({EndedKind::kMotion, how, "WAG.MTN", ""});
      robot.mover.ended({EndedKind::kJam, how, row.name, ""});
      EXPECT_EQ(textOf(begun), "-") << row.name;
      robot.mover.ended({row.kind, how, row.name, "of the robot"});
      ASSERT_NE(begun.ended(), nullptr) << row.name;
      EXPECT_EQ(begun.ended()->how, how) << row.name;
      EXPECT_EQ(begun.ended()->reason, "of the robot");
    }
  }
}

TEST_F(MoverTest, JointsThatANewerCommandDoesNotNameGoOn) {
  const auto both = mover.command(order(), {"head_pan", "mouth"}, {0.5, -0.2}, {});
  command("head_pan", 0.1, "/other");
  EXPECT_EQ(textOf(both), "-");
  EXPECT_THAT(mover.jointsOf(both.id), ElementsAre("mouth"));
}

TEST_F(MoverTest, ANodeThatCommandsTheSameJointsAgainGoesOnWithItsMovement) {
  EXPECT_EQ(command("head_pan", 0.5).id, command("head_pan", 0.4).id);
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  mover.command(order(), {"head_pan"}, {0.3}, {}, Kind::kLookAt);
  EXPECT_THAT(lastEnd(), StartsWith("REPLACED")) << "a look is another movement";
}

TEST_F(MoverTest, ARefusalEndsTheOrderThatItNames) {
  const auto older = command("head_pan", 0.5);
  const auto newer = command("head_pan", 0.4, "/other");
  refuses(RefusedRequest::kJoints, RefusalCause::kTooOld, "too old", older.id);
  EXPECT_EQ(textOf(newer), "-");
  refuses(RefusedRequest::kJoints, RefusalCause::kReplaced, "a motion plays", newer.id);
  EXPECT_EQ(textOf(newer), "REPLACED a motion plays");
}

TEST_F(MoverTest, AStreamThatIsRefusedAgainAndAgainHasOneEnd) {
  client.problem = "there is no robot";
  for (int i = 0; i < 10; ++i, now += 100ms) {
    command("head_pan", 0.1 * i);
    steer(0.1);
  }
  EXPECT_THAT(ends, SizeIs(2));
  command("head_pan", 0, "/other");
  EXPECT_THAT(ends, SizeIs(3)) << "of another node";
  now += 500ms;
  command("head_pan", 0);
  EXPECT_THAT(ends, SizeIs(4)) << "after a pause";
  play("NOD.MTN");
  play("NOD.MTN");
  EXPECT_THAT(ends, SizeIs(6)) << "each call has its answer";
}

TEST_F(MoverTest, TheLatest64EndsAreRemembered) {
  for (int i = 0; i < 70; ++i) {
    play(std::to_string(i));
    mover.stopMotion(order(), "");
  }
  ASSERT_THAT(mover.state().ended, SizeIs(64));
  EXPECT_EQ(mover.state().ended.back().movement.name, "69");
  EXPECT_EQ(mover.state().ends, 70u);
}

// ---- Orders that do not act

const std::vector<std::pair<std::string, std::function<void(Robot&, const Order&)>>> kOrders = {
    {"command", [](Robot& robot, const Order& order) { robot.mover.command(order, {"head_pan"}, {0.5}, {}); }},
    {"trajectory",
     [](Robot& robot, const Order& order) {
       robot.mover.follow(order, {{"head_pan"}, {{1.0, {0.5}, {}}}}, 0ms);
     }},
    {"motion", [](Robot& robot, const Order& order) { robot.mover.play(order, "NOD.MTN", 1); }},
    {"posture", [](Robot& robot, const Order& order) { robot.mover.takePosture(order, Posture::kSit); }},
    {"velocity",
     [](Robot& robot, const Order& order) {
       robot.mover.steer(order, {0.1, 0, 0});
     }},
    {"goal", [](Robot& robot, const Order& order) { robot.mover.walkToGoal(order, "1 m ahead"); }},
};

TEST(Orders, AreRefusedForTheseReasonsAndMoveNothing) {
  const struct {
    const char* reason;
    std::vector<std::string> before;     // the order comes
    std::vector<std::string> meanwhile;  // before it acts
  } rows[] = {
      {"stopped by /panel; call release", {"stop"}, {}},
      {"it came before /panel called stop", {}, {"stop", "release"}},
      {"it came before /panel called release", {"stop"}, {"release"}},
      {"it came before /panel called rest", {}, {"rest"}},
      {"it came before /panel switched the motors off", {}, {"motors off"}},
      {"it came before /panel switched the motors on", {}, {"motors on"}},
      {"it came before the robot was connected", {}, {"reconnected unnoticed"}},
      {"too old: it has waited for 0.6 s", {}, {"time passes"}},
      {"it is an ERS-210", {"an ERS-210"}, {}},
  };
  for (const auto& row : rows) {
    for (const auto& [name, give] : kOrders) {
      Robot robot;
      happen(robot, row.before);
      const Order order = robot.order();
      robot.pass(10ms);
      happen(robot, row.meanwhile);
      robot.told();
      give(robot, order);
      EXPECT_THAT(robot.lastEnd(), AllOf(StartsWith("REFUSED"), HasSubstr(row.reason))) << name;
      EXPECT_THAT(robot.told(), IsEmpty()) << name;
    }
  }
}

TEST_F(MoverTest, AnOrderThatCameAfterACallActsEvenIfTheCallHadToWait) {
  const std::function<void(const Order&)> calls[] = {
      [this](const Order& call) { mover.takePosture(call, Posture::kSit); },
      [this](const Order& call) { mover.setMotors(call, false); },
      [this](const Order& call) { mover.setMotors(call, true); },
      [this](const Order& call) { mover.hold(call, "an empty trajectory came"); },
      [this](const Order& call) { mover.release(call); }};
  for (const auto& call : calls) {
    const Order earlier = order();
    pass(32ms);
    const Order later = order();
    pass(32ms);
    call(earlier);
    EXPECT_EQ(textOf(mover.command(later, {"head_pan"}, {0.5}, {})), "-");
  }
}

// The client drops it then; the robot never gets it.
TEST(Orders, ThatWaitInTheClientGetTooOldHalfASecondAfterTheyCame) {
  for (const auto& [name, give] : kOrders) {
    Robot robot;
    const Order order = robot.order();
    give(robot, order);
    EXPECT_EQ(robot.client.terms.not_after - order.received, 500ms) << name;
  }
}

TEST_F(MoverTest, AnOrderThatNamesMoreThan1000JointsIsNotRead) {
  const std::vector<std::string> names(1001, "head_pan");
  const std::vector<double> positions(1001, 0.1);
  const std::string refusal = "REFUSED it names 1001, and at most 1000 names are allowed";
  EXPECT_EQ(textOf(mover.command(order(), names, positions, {})), refusal);
  EXPECT_EQ(textOf(mover.follow(order(), {names, {{1.0, positions, {}}}}, 0ms)), refusal);
}

TEST_F(MoverTest, JointsThatAreLeftOutAreNamedInOneShortPlainLine) {
  mover.command(order(), {"head_pan", "a", "b", "c", "d"}, {0.1, 0, 0, 0, 0}, {});
  EXPECT_THAT(warnings, ElementsAre("The ERS-7 has no joint 'a'. The ERS-7 has no joint 'b'. The ERS-7 has no joint "
                                    "'c'. and 1 more"));
  EXPECT_EQ(textOf(command("a", 0.1)), "REFUSED The ERS-7 has no joint 'a'");
  EXPECT_THAT(textOf(follow("a\n\x1b[31m", 0)), Not(AnyOf(HasSubstr("\n"), HasSubstr("\x1b"))));
  EXPECT_LE(textOf(follow(std::string(100000, 'a'), 0)).size(), 1020u);
}

// ---- Stop and release

TEST_F(MoverTest, AStopLastsUntilRelease) {
  mover.stop(order("/panel"));
  EXPECT_THAT(told(), ElementsAre("hold"));
  happen(*this, {"reconnected"});
  EXPECT_EQ(mover.state().stopped_by, "/panel") << "over another connection";
  EXPECT_THROW(mover.setMotors(order(), true), CommandException);
  mover.setMotors(order(), false);
  mover.takePosture(order(), Posture::kRest);
  EXPECT_THAT(told(), ElementsAre("motors off", "rest")) << "these are allowed";
  mover.release(order());
  EXPECT_FALSE(mover.state().stopped_by);
  pass(100ms);
  EXPECT_THAT(told(), IsEmpty()) << "nothing starts by itself";
  command("head_pan", 0.5);
  EXPECT_THAT(told(), SizeIs(1));
}

TEST_F(MoverTest, NothingIsSentWhileTheRobotIsToldToStop) {
  const auto trajectory = follow("head_pan", 0.5);
  const auto goal = walkToGoal();
  told();
  client.meanwhile = [&] {
    EXPECT_EQ(textOf(command("mouth", -0.1)), "REFUSED stopped by /panel; call release");
    pass(100ms);
    mover.walkOn(goal.id, {0.1, 0, 0});
    EXPECT_THROW(mover.release(order()), CommandException);
    EXPECT_EQ(textOf(trajectory), "-") << "the robot has not answered";
  };
  mover.stop(order("/panel"));
  EXPECT_THAT(told(), ElementsAre("hold"));
  EXPECT_EQ(textOf(trajectory), "STOPPED /panel called stop");
}

TEST(Stop, ThatDoesNotReachTheRobotRefusesOrdersAllTheSame) {
  const std::pair<const char*, std::function<void()>> rows[] = {
      {"UNKNOWN /panel called stop, but the robot has not answered: no answer within 2000 ms", doNotAnswer},
      {"LOST there is no robot", [] { throw NetworkException("there is no robot."); }}};
  for (const auto& [end, fail] : rows) {
    Robot robot;
    const auto moving = robot.command("head_pan", 0.5);
    robot.client.meanwhile = fail;
    EXPECT_THROW(robot.mover.stop(robot.order("/panel")), aibo_client::Exception);
    EXPECT_EQ(textOf(moving), end);
    EXPECT_EQ(textOf(robot.command("head_pan", 0.5)), "REFUSED stopped by /panel; call release");
    robot.mover.release(robot.order());
    EXPECT_EQ(textOf(robot.command("head_pan", 0.5)), "-");
  }
}

TEST_F(MoverTest, WhatBeginsDuringAStopIsStopped) {
  client.meanwhile = [this] { mover.stop(order("/panel")); };
  EXPECT_EQ(textOf(play("NOD.MTN")), "STOPPED /panel called stop");
  EXPECT_THAT(told(), ElementsAre("play NOD.MTN 1", "hold", "stop NOD.MTN"));
  mover.release(order());
  client.meanwhile = [this] { mover.stop(order("/panel")); };
  EXPECT_EQ(textOf(sit()), "STOPPED /panel called stop");
  EXPECT_THAT(told(), ElementsAre("sit", "hold", "hold"));
  mover.release(order());
  client.meanwhile = [this] {
    mover.stop(order("/panel"));
    client.problem = "there is no robot";
  };
  play("NOD.MTN");
  EXPECT_THAT(warnings, ElementsAre("The motion NOD.MTN may go on: there is no robot"));
}

TEST_F(MoverTest, WhatTheRobotReportsDuringAStopHasTheReasonOfTheStop) {
  const auto motion = play("NOD.MTN");
  const auto head = command("head_pan", 0.4);
  client.meanwhile = [this] {
    mover.ended({EndedKind::kMotion, EndedHow::kStopped, "NOD.MTN", "the client holds it"});
    refuses(RefusedRequest::kJoints, RefusalCause::kStopped, "a stop came before it was sent");
  };
  mover.stop(order("/panel"));
  EXPECT_EQ(textOf(motion), "STOPPED /panel called stop");
  EXPECT_EQ(textOf(head), "STOPPED /panel called stop");
}

TEST_F(MoverTest, CancellingEndsOneMovementAndHoldsItsJoints) {
  const auto trajectory = follow("head_pan", 0.5);
  const auto waiting = mover.follow(order(), {{"mouth"}, {{1.0, {-0.2}, {}}}}, 5s);
  const auto posture = sit();
  told();
  mover.cancel(trajectory.id, "the goal was cancelled");
  EXPECT_EQ(textOf(trajectory), "STOPPED the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre("hold 2"));
  mover.cancel(waiting.id, "the goal was cancelled");
  EXPECT_EQ(textOf(waiting), "STOPPED the goal was cancelled");
  EXPECT_THAT(told(), IsEmpty()) << "it moved nothing yet";
  EXPECT_EQ(textOf(posture), "-");
  mover.cancel(posture.id, "the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre(StartsWith("hold 11"))) << "the legs";
  mover.cancel(posture.id, "the goal was cancelled");
  EXPECT_THAT(told(), IsEmpty()) << "it is over";
}

// A version 1 server has no request to hold: each joint is sent to a place to hold, so that none turns back.
TEST_F(MoverTest, AVersion1ServerHoldsWhereATrajectoryWasSentAndACommandShouldBe) {
  happen(*this, {"version 1"});
  follow("head_pan", 0.5);
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.05 in 0")) << "96 ms ahead";
  mover.release(order());
  measure(0.5);
  command("head_pan", -1);
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.50 in 0"));
}

TEST_F(MoverTest, AVersion1ServerIsToldToEndItsMotionsIfOneWasPlayed) {
  happen(*this, {"version 1"});
  mover.stop(order());
  EXPECT_THAT(told(), IsEmpty());
  mover.release(order());
  play("NOD.MTN");
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("stop "));
}

// ---- Motors

TEST_F(MoverTest, TheMotorsAreWhatTheRobotSaysAndUnknownWithoutAConnection) {
  EXPECT_TRUE(mover.setMotors(order(), true));
  EXPECT_EQ(mover.state().robot.motors, MotorState::kOn);
  client.motors_work = false;
  EXPECT_FALSE(mover.setMotors(order(), true));
  EXPECT_EQ(mover.state().robot.motors, MotorState::kOff);
  mover.disconnected();
  EXPECT_EQ(mover.state().robot, aibo_client::MotorsAndPosture());
}

TEST(Joints, AreApproachedSlowlyAfterWhateverMayHaveMovedThem) {
  const std::vector<std::string> rows[] = {
      {"reconnected"},    {"motors on"},           {"motors go off"},
      {"joints refused"}, {"sit", "posture done"}, {"goal", "walk done"},
  };
  for (const auto& events : rows) {
    Robot robot;
    robot.command("head_pan", 0.0);
    robot.command("head_pan", 0.2);  // it has arrived at 0
    EXPECT_THAT(robot.client.told, Contains("V 2:3.00"));
    happen(robot, events);
    robot.client.told.clear();
    robot.command("head_pan", 1.0);
    EXPECT_THAT(robot.client.told, ElementsAre("V 2:0.50", "J 2:1.00 in 0")) << events[0];
  }
}

TEST_F(MoverTest, AJointThatIsStoppedOnItsApproachBeginsItAgain) {
  command("head_pan", 1.0);
  mover.stop(order());
  now += 10s;
  mover.release(order());
  client.told.clear();
  command("head_pan", 1.0);
  EXPECT_THAT(client.told, ElementsAre("J 2:1.00 in 0")) << "its speed limit is still 0.5 rad/s";
}

// ---- Motions and postures

TEST_F(MoverTest, AMotionPlaysAtTheRobotsOwnSpeedsAndCommandsKeepTheirs) {
  play("NOD.MTN");
  EXPECT_EQ(client.told.back(), "play NOD.MTN 1");
  client.told.pop_back();
  EXPECT_THAT(client.told, SizeIs(table.size()));
  EXPECT_THAT(client.told, Each(StartsWith("V ")));
  client.told.clear();
  command("head_pan", 0.1);
  EXPECT_THAT(client.told, ElementsAre("V 2:0.50", "J 2:0.10 in 0"));
}

TEST(Motion, ThatDoesNotBeginEndsByWhatFailed) {
  const std::pair<const char*, std::function<void()>> rows[] = {
      {"REFUSED There is none", [] { throw CommandException("There is none."); }},
      {"REFUSED it was not sent", [] { throw TimeoutException("it was not sent."); }},
      {"REFUSED it was not sent", [] { throw NetworkException("it was not sent."); }},
      {"LOST it broke", [] { throw NetworkException("it broke.", FaultKind::kNone, true); }},
      {"-", doNotAnswer}};  // it may play or not
  for (const auto& [end, fail] : rows) {
    Robot robot;
    robot.client.meanwhile = fail;
    EXPECT_EQ(textOf(robot.play("NOD.MTN")), end);
  }
}

TEST_F(MoverTest, AMotionThatMayOrMayNotPlayStaysUntilTheRobotSays) {
  client.meanwhile = doNotAnswer;
  const auto plays = play("NOD.MTN");
  EXPECT_TRUE(plays.is_uncertain);
  EXPECT_EQ(plays.remark, "no answer within 2000 ms");
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  mover.answeredLate({plays.id, true, "", ""});
  EXPECT_EQ(textOf(plays), "-");
  mover.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""});
  EXPECT_EQ(textOf(plays), "DONE");
  client.meanwhile = doNotAnswer;
  const auto refused = play("NOD.MTN");
  mover.answeredLate({refused.id, false, "There is none.", ""});
  EXPECT_EQ(textOf(refused), "REFUSED There is none");
}

TEST_F(MoverTest, TheEndOfAMotionIsUnknownIfTheRobotDoesNotSayIt) {
  happen(*this, {"version 1"});
  EXPECT_EQ(textOf(play("NOD.MTN")), "UNKNOWN this robot does not say when a motion ends");
}

TEST_F(MoverTest, AMotionMayEndBeforeItsCallReturns) {
  client.meanwhile = [this] { mover.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""}); };
  EXPECT_EQ(textOf(play("NOD.MTN")), "DONE");
}

TEST_F(MoverTest, StoppingOneMotionLeavesTheOthers) {
  const auto nod = play("NOD.MTN");
  const auto wag = play("WAG.MTN");
  mover.stopMotion(order("/panel"), "NOD.MTN");
  EXPECT_EQ(client.told.back(), "stop NOD.MTN");
  EXPECT_EQ(textOf(nod), "STOPPED /panel stopped it");
  EXPECT_EQ(textOf(wag), "-");
}

TEST_F(MoverTest, TheEndOfAnOlderPostureIsNotThatOfTheNextOne) {
  sit();
  mover.stop(order());
  mover.release(order());
  const auto stand = mover.takePosture(order(), Posture::kStand);
  mover.ended({EndedKind::kPosture, EndedHow::kStopped, "sit", ""});
  EXPECT_EQ(textOf(stand), "-");
}

// ---- Trajectories

TEST(Trajectory, IsRefusedUnlessItsJointsAreMeasured) {
  const struct {
    const char* end;
    int version;
    milliseconds age;
  } rows[] = {
      {"-", 2, 300ms},
      {"REFUSED head_pan was last measured 0.4 s ago", 2, 400ms},
      {"-", 1, 2000ms},
      {"REFUSED head_pan was last measured 2.1 s ago", 1, 2100ms},
  };
  for (const auto& row : rows) {
    Robot robot;
    robot.client.present.protocol_version = row.version;
    robot.now += row.age;
    EXPECT_THAT(textOf(robot.follow("head_pan", 0.5)), StartsWith(row.end));
  }
  Robot robot;
  robot.telemetry_wanted = false;
  EXPECT_THAT(textOf(robot.follow("head_pan", 0.5)), StartsWith("REFUSED telemetry_rate is 0"));
}

TEST_F(MoverTest, ATrajectorySaysWhereItWantsItsJointsAndWhenItEnds) {
  const auto trajectory = follow("head_pan", 0.5);
  EXPECT_EQ(mover.state().movements.at(0).end, now + 1s);
  ASSERT_THAT(mover.wantedBy(trajectory.id, now + 100ms), SizeIs(1));
  EXPECT_NEAR(mover.wantedBy(trajectory.id, now + 100ms)[0].position, 0.05, 1e-9);
}

TEST_F(MoverTest, ATrajectoryThatIsTooFastIsSlowedDownIfThatIsWanted) {
  const TrajectoryRequest too_fast{{"head_pan"}, {{0.1, {0.6}, {}}}};
  EXPECT_THAT(textOf(mover.follow(order(), too_fast, 0ms)), StartsWith("REFUSED"));
  Mover slow{table, measured, client, 0.5, true, [] { return true; }, [this] { return now; }};
  EXPECT_THAT(slow.follow(order(), too_fast, 0ms).remark, StartsWith("slowed down 2.0"));
}

TEST_F(MoverTest, ATrajectoryDoesNotGoOnAfterTheDriverWasHeldUpForHalfASecond) {
  const auto trajectory = follow("head_pan", 0.5);
  pass(200ms);
  told();
  now += 501ms;
  measure(0.1);
  mover.goOn();
  EXPECT_EQ(textOf(trajectory), "REFUSED the driver was held up");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverTest, ATrajectoryWhoseStepCannotBeSentIsLost) {
  const auto trajectory = follow("head_pan", 0.5);
  client.problem = "there is no robot";
  pass(32ms);
  EXPECT_EQ(textOf(trajectory), "LOST there is no robot");
}

// ---- Walking by velocities

TEST(Walk, HasToBeLetGoFirstAfterTheseEvents) {
  const struct {
    std::string reason;
    std::vector<std::string> events;
  } rows[] = {
      {"/panel called stop", {"stop", "release"}},
      {"the connection is a new one", {"reconnected"}},
      {"/user called sit", {"sit"}},
      {"/panel switched the motors off", {"motors off"}},
      {"the motors are off", {"motors go off"}},
      {"/other moves left_front_knee", {"leg command"}},
      {"/user moves left_front_knee", {"leg trajectory"}},
      {"/user sends the robot to a goal", {"goal"}},
      {"it fell", {"walk fell"}},
      {"an edge", {"edge"}},
      {"a leg", {"legs taken"}},
      {"the robot was lifted", {"lifted"}},
      {"the robot has fallen", {"fallen"}},
      {"no", {"walk refused"}},
  };
  for (const auto& row : rows) {
    for (const bool by_a_zero : {true, false}) {
      Robot robot;
      robot.walk();
      happen(robot, row.events);
      robot.told();
      robot.now += 100ms;
      robot.steer(0.1);
      EXPECT_THAT(robot.told(), IsEmpty()) << row.reason;
      EXPECT_EQ(robot.lastEnd(), "REFUSED " + row.reason + kLetGo);
      by_a_zero ? robot.steer(0) : robot.pass(500ms);
      robot.told();
      robot.steer(0.1);
      EXPECT_THAT(robot.told(), ElementsAre("steer 0.10 0.00 0.00")) << row.reason;
    }
  }
}

TEST_F(MoverTest, AStreamThatBeginsWhileStoppedHasToLetGoToo) {
  mover.stop(order("/panel"));
  steer(0.1);
  mover.release(order("/panel"));
  told();
  steer(0.1);
  EXPECT_EQ(lastEnd(), std::string("REFUSED the robot was stopped") + kLetGo);
  EXPECT_THAT(told(), IsEmpty());
}

TEST(Walk, GoesOnAfterTheseEvents) {
  const std::vector<std::string> rows[] = {
      {"head command"}, {"head trajectory"}, {"no telemetry", "leg trajectory"}, {"release"}, {"velocity too late"},
  };
  for (const auto& events : rows) {
    Robot robot;
    robot.walk();
    happen(robot, events);
    robot.told();
    robot.steer(0.1);
    EXPECT_THAT(robot.told(), ElementsAre("steer 0.10 0.00 0.00")) << events.back();
    EXPECT_EQ(robot.mover.state().movements.at(0).kind, Kind::kWalk) << events.back();
  }
}

TEST_F(MoverTest, AWalkBrakesAtAVelocityOf0AndIsDoneWhenTheRobotSaysSo) {
  walk();
  steer(0);
  mover.steered({}, client.steering_order);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 0.00 0.00", "steer 0.00 0.00 0.00"));
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  mover.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(lastEnd(), "DONE");
}

TEST_F(MoverTest, AVelocityOf0IsNotSentToARobotThatDoesNotWalk) {
  sit();
  told();
  steer(0);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverTest, AWalkThatIsNotSteeredAnyMoreStopsAndSaysWhy) {
  walk();
  told();
  mover.stopWalking("no cmd_vel came for 0.5 s");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
  mover.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(lastEnd(), "STOPPED no cmd_vel came for 0.5 s");
  walk();
  mover.stopWalking("no cmd_vel came for 0.5 s");
  happen(*this, {"walk fell"});
  EXPECT_EQ(lastEnd(), "FELL it fell") << "while it brakes";
}

TEST_F(MoverTest, AWalkThatHasNotBegunEndsByItsRefusalOrWhenItIsLetGo) {
  steer(0.1);
  refuses(RefusedRequest::kWalk, RefusalCause::kRobot, "the motors are off");
  EXPECT_EQ(lastEnd(), "REFUSED the motors are off");
  steer(0);
  steer(0.1);
  steer(0);
  mover.steered({}, client.steering_order);
  EXPECT_EQ(lastEnd(), "STOPPED it was let go before the robot walked");
}

TEST_F(MoverTest, TheEndOfAnOlderWalkIsNotThatOfTheNextOne) {
  walk();
  command("left_front_knee", 0.1);
  mover.ended({EndedKind::kWalk, EndedHow::kReplaced, "walk", ""});
  steer(0);
  steer(0.1);
  mover.ended({EndedKind::kWalk, EndedHow::kReplaced, "walk", ""});  // late, of the first one
  EXPECT_THAT(mover.state().movements, Contains(::testing::Field(&Movement::kind, Kind::kWalk)));
}

TEST_F(MoverTest, OneWalkMayBeSteeredByTwoNodesAndIsTheOthersWhenTheFirstPauses) {
  walk();
  steer(0.1, "/navigation");
  EXPECT_THAT(ends, IsEmpty());
  pass(600ms);
  steer(0.1, "/navigation");
  EXPECT_EQ(lastEnd(), "REPLACED /navigation steers now");
  EXPECT_EQ(mover.state().movements.at(0).source, "/navigation");
}

TEST_F(MoverTest, AWalkThatTwoNodesContradictNamesBoth) {
  walk();
  steer(0, "/b");
  steer(0.1);
  EXPECT_EQ(mover.state().movements.at(0).source, "/teleop, /b");
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("/b")));
}

TEST_F(MoverTest, AWalkAndAPostureGetTheFullSpeedOfTheLegs) {
  command("left_front_knee", 0.1);
  client.told.clear();
  steer(0.1);
  EXPECT_EQ(std::count_if(client.told.begin(), client.told.end(), [](const auto& text) { return text[0] == 'V'; }), 12);
}

// ---- Walking to a goal

TEST_F(MoverTest, AGoalIsReachedWhenTheRobotStandsThere) {
  const auto goal = mover.walkToGoal(order(), "1 m ahead");
  EXPECT_EQ(mover.state().movements.at(0).name, "1 m ahead");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00")) << "it lets go of an earlier walk";
  EXPECT_TRUE(mover.walkOn(goal.id, {0.1, 0, 0}));
  mover.steered({0.1, 0, 0}, client.steering_order);
  EXPECT_TRUE(mover.walkOn(goal.id, {}));
  EXPECT_THAT(told(), ElementsAre("steer 0.10 0.00 0.00", "steer 0.00 0.00 0.00"));
  mover.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(textOf(goal), "DONE");
  EXPECT_FALSE(mover.walkOn(goal.id, {0.1, 0, 0}));
}

TEST_F(MoverTest, AGoalWhereTheRobotIsAlreadyIsDoneAtOnce) {
  const auto goal = mover.walkToGoal(order(), "here");
  told();
  EXPECT_FALSE(mover.walkOn(goal.id, {}));
  EXPECT_EQ(textOf(goal), "DONE");
  EXPECT_THAT(told(), IsEmpty());
}

TEST(Goal, IsNotWalkedToAfterTheseEvents) {
  const struct {
    const char* end;
    const char* event;
  } rows[] = {
      {"STOPPED /panel called stop", "stop"},
      {"LOST the connection to the robot was lost", "reconnected"},
      {"LOST the connection to the robot was lost", "reconnected unnoticed"},
      {"LOST there is no robot", "no robot"},
      {"REFUSED the driver was held up", "held up"},
      {"REFUSED an edge", "edge"},
      {"FELL it fell", "walk fell"},
      {"REPLACED /teleop steers now", "velocity"},
      {"REPLACED /user sends the robot to a goal", "goal"},
  };
  for (const auto& row : rows) {
    Robot robot;
    const auto goal = robot.walkToGoal();
    happen(robot, {row.event});
    robot.told();
    EXPECT_FALSE(robot.mover.walkOn(goal.id, {0.1, 0, 0})) << row.event;
    EXPECT_THAT(robot.told(), Not(Contains("steer 0.10 0.00 0.00"))) << row.event;
    EXPECT_THAT(textOf(goal), StartsWith(row.end));
  }
}

TEST(Goal, ThatIsCancelledOrStoppedByAVelocityOf0Brakes) {
  const std::pair<const char*, std::function<void(Robot&, MovementId)>> rows[] = {
      {"STOPPED the goal was cancelled",
       [](Robot& robot, MovementId goal) { robot.mover.cancel(goal, "the goal was cancelled"); }},
      {"STOPPED /teleop sent a velocity of 0", [](Robot& robot, MovementId) { robot.steer(0); }}};
  for (const auto& [end, happen] : rows) {
    Robot robot;
    const auto goal = robot.walkToGoal();
    robot.told();
    happen(robot, goal.id);
    EXPECT_TRUE(robot.mover.walkOn(goal.id, {0.1, 0, 0})) << "the robot has not said that it stands";
    EXPECT_THAT(robot.told(), ElementsAre("steer 0.00 0.00 0.00"));
    robot.mover.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
    EXPECT_EQ(textOf(goal), end);
  }
}

TEST_F(MoverTest, ANewGoalIsWalkedToWithoutAStopInBetween) {
  walkToGoal();
  told();
  const auto second = mover.walkToGoal(order("/other"), "2 m ahead");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_TRUE(mover.walkOn(second.id, {0.05, 0, 0}));
}

TEST_F(MoverTest, WhoSteeredBeforeAGoalHasToLetGoFirst) {
  walk();
  const auto goal = walkToGoal();
  steer(0.05);
  EXPECT_THAT(lastEnd(), HasSubstr("let go first"));
  mover.stopWalking("no cmd_vel came for 0.5 s");
  EXPECT_EQ(textOf(goal), "-");
}

// ---- What a listener is told

TEST_F(MoverTest, EachChangeIsToldAndThatTheJointsHaveToBeMovedOn) {
  int changes = 0;
  int begins = 0;
  mover.setListener({[&] { ++changes; }, [&] { ++begins; }, nullptr, nullptr});
  command("head_pan", 0.5);
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(begins, 1);
  EXPECT_TRUE(mover.goOn());
  follow("head_pan", 0.5);
  EXPECT_EQ(begins, 2);
  mover.stop(order());
  EXPECT_FALSE(mover.goOn());
}

TEST(Movement, IsDescribedInWordsThatBeginASentence) {
  const std::vector<std::string> joints{"head_pan", "mouth"};
  EXPECT_EQ(describe({Kind::kCommand, "", "/user", joints, {}}), "The command of head_pan, mouth");
  EXPECT_EQ(describe({Kind::kTrajectory, "", "/user", joints, {}}), "The trajectory of head_pan, mouth");
  EXPECT_EQ(describe({Kind::kMotion, "NOD.MTN", "/user", {}, {}}), "The motion NOD.MTN");
  EXPECT_EQ(describe({Kind::kWalk, "", "/user", {}, {}}), "The walk");
  EXPECT_EQ(describe({Kind::kPosture, "sit", "/user", {}, {}}), "The posture sit");
  EXPECT_EQ(describe({Kind::kLookAt, "", "/user", joints, {}}), "The look_at");
}

}  // namespace
}  // namespace aibo_driver::movement
