// Orders, stop and ends: docs/ros_interface.md, "Guard rails", "Stop", "motion_state" and "Walking".
#include "movement/mover.h"

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::movement {
namespace {

using aibo_client::CommandException;
using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::MotorState;
using aibo_client::Posture;
using aibo_client::PostureNow;
using aibo_client::RefusalCause;
using aibo_client::RefusedRequest;
using aibo_client::TimeoutException;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;
using namespace std::chrono_literals;
using Kind = Movement::Kind;

constexpr int kHeadPan = 2;  // its identifier
constexpr const char* kLetGo = "; let go first: 0, or nothing for 0.5 s";

// How it ended and why, in the words of docs/ros_interface.md.
std::string textOf(const EndedMovement* ended) {
  constexpr const char* kHow[] = {"DONE", "REPLACED", "STOPPED", "REFUSED", "FELL", "UNKNOWN", "NOT_REACHED", "LOST"};
  return ended == nullptr ? "-"
                          : kHow[static_cast<int>(ended->how)] + (ended->reason.empty() ? "" : " " + ended->reason);
}
std::string textOf(const Mover::Answer& begun) {
  return textOf(begun.ended());
}

[[noreturn]] void doNotAnswer() {
  throw TimeoutException("no answer within 2000 ms.", aibo_client::FaultKind::kNone, true);
}

std::vector<std::string> withoutSpeedLimits(std::vector<std::string> told) {
  told.erase(std::remove_if(told.begin(), told.end(), [](const auto& text) { return text[0] == 'V'; }), told.end());
  return told;
}

// A robot that stands with all joints at 0, and reports nothing by itself. Time stands still unless a test lets it
// pass.
struct Robot {
  Robot() {
    client.present.protocol_version = 2;
    client.present.robot.capabilities = {"I", "S", "E", "O"};
    Mover::Listener listener;
    listener.on_ended = [this](const EndedMovement& ended) { told_ends.push_back(ended); };
    mover.setListener(listener);
    mover.connected();
    says(MotorState::kOn, PostureNow::kStanding);
    measure(0);
    now += 1ms;
  }

  void measure(double pan) {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = now;
    for (const JointProperties& joint : table.joints()) {
      telemetry.joints.push_back({joint.id, joint.id == kHeadPan ? pan : std::clamp(0.0, joint.lowest, joint.highest)});
    }
    measured.update(telemetry);
  }
  void pass(std::chrono::milliseconds time, double pan = 0) {
    for (const SteadyTime end = now + time; now < end; mover.advance()) {
      now += JointPlan::kPeriod;
      measure(pan);
    }
  }

  Order order(const std::string& source = "/user") const { return {source, now}; }
  Mover::Answer command(const std::string& joint, double position, const std::string& source = "/user") {
    return mover.command(order(source), {joint}, {position}, {});
  }
  Mover::Answer follow(const std::string& joint, double position) {
    return mover.follow(order(), {{joint}, {{1.0, {position}, {}}}}, 0ms);
  }
  Mover::Answer play(const std::string& motion) { return mover.play(order(), motion, 1); }
  Mover::Answer sit() { return mover.takePosture(order(), Posture::kSit); }
  void steer(double forward, const std::string& source = "/teleop") {
    now += 1ms;  // a stream begins after what overrules it, not at the same time
    mover.steer(order(source), {forward, 0, 0});
  }
  void walk() {
    steer(0.1);
    begins();
  }
  Mover::Answer walkToGoal() {
    const Mover::Answer begun = mover.walkToGoal(order(), "1 m ahead");
    mover.steerToGoal(begun.id, {0.1, 0, 0});
    begins();
    return begun;
  }
  void says(MotorState motors, PostureNow posture) { mover.robotChanged({motors, posture}); }
  // The robot begins to walk with the last velocity.
  void begins() {
    walk_order = client.order();
    mover.steered({0.1, 0, 0}, walk_order, walk_order);
  }
  void refuses(RefusedRequest request, RefusalCause cause, const std::string& reason, std::uint64_t order = 0) {
    mover.refused({request, cause, {}, reason, order == 0 ? client.order() : order});
  }
  // The robot ends an order; the last one unless it is named.
  void ends(EndedKind kind, EndedHow how, const std::string& reason = "", std::uint64_t order = 0) {
    mover.ended({kind, how, "", reason, order == 0 ? client.order() : order});
  }
  void walkEnds(EndedHow how, const std::string& reason = "") { ends(EndedKind::kWalk, how, reason, walk_order); }
  // What it was told since the last call, without speed limits.
  std::vector<std::string> told() { return withoutSpeedLimits(std::exchange(client.told, {})); }
  std::string lastEnd() const { return textOf(told_ends.empty() ? nullptr : &told_ends.back()); }
  test_support::FakeClient client;
  SteadyTime now{1000s};
  JointTable table{"ERS-7", 3.0};
  MeasuredJoints measured{table};
  Mover mover{table, measured, client, 0.5, [this] { return now; }};
  std::uint64_t walk_order = 0;  // of the velocity that began the last walk
  std::vector<EndedMovement> told_ends;
};

class MoverTest : public ::testing::Test, protected Robot {};

// What may happen to a robot, for the tables below.
const std::map<std::string, std::function<void(Robot&)>> kEvents = {
    {"stop", [](Robot& robot) { robot.mover.stop(robot.order("/panel")); }},
    {"release", [](Robot& robot) { robot.mover.release(robot.order("/panel")); }},
    {"empty trajectory", [](Robot& robot) { robot.mover.hold(robot.order(), "an empty trajectory came"); }},
    {"motors off", [](Robot& robot) { robot.mover.setMotors(robot.order("/panel"), false); }},
    {"motors on", [](Robot& robot) { robot.mover.setMotors(robot.order("/panel"), true); }},
    {"motors go off", [](Robot& robot) { robot.says(MotorState::kOff, PostureNow::kStanding); }},
    {"rest", [](Robot& robot) { robot.mover.takePosture(robot.order("/panel"), Posture::kRest); }},
    {"sit", [](Robot& robot) { robot.sit(); }},
    {"posture cancelled",
     [](Robot& robot) {
       for (const Movement& movement : robot.mover.state().movements) {
         if (movement.kind == Kind::kPosture) {
           robot.mover.cancel(movement.order, "it was cancelled");
         }
       }
     }},
    {"head command", [](Robot& robot) { robot.command("head_pan", 0.1, "/other"); }},
    {"head trajectory", [](Robot& robot) { robot.follow("head_pan", 0.1); }},
    {"leg command", [](Robot& robot) { robot.command("left_front_knee", 0.1, "/other"); }},
    {"leg trajectory", [](Robot& robot) { robot.follow("left_front_knee", 0.1); }},
    {"motion", [](Robot& robot) { robot.play("WAG.MTN"); }},
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
    {"no telemetry", [](Robot& robot) { robot.measured.clear(); }},
    {"time passes", [](Robot& robot) { robot.pass(600ms); }},
    {"fallen", [](Robot& robot) { robot.says(MotorState::kOn, PostureNow::kFallen); }},
    {"lifted", [](Robot& robot) { robot.says(MotorState::kOn, PostureNow::kCarried); }},
    {"walk fell", [](Robot& robot) { robot.walkEnds(EndedHow::kFell, "it fell"); }},
    {"walk done", [](Robot& robot) { robot.walkEnds(EndedHow::kDone); }},
    {"walk not steered", [](Robot& robot) { robot.walkEnds(EndedHow::kStopped, "it was not steered for 500 ms"); }},
    {"edge", [](Robot& robot) { robot.walkEnds(EndedHow::kRefused, "an edge"); }},
    {"legs taken", [](Robot& robot) { robot.walkEnds(EndedHow::kReplaced, "a leg"); }},
    {"posture done", [](Robot& robot) { robot.ends(EndedKind::kPosture, EndedHow::kDone); }},
    {"joints done", [](Robot& robot) { robot.ends(EndedKind::kJoints, EndedHow::kDone); }},
    {"joints taken", [](Robot& robot) { robot.ends(EndedKind::kJoints, EndedHow::kReplaced, "WAG.MTN"); }},
    {"joints held", [](Robot& robot) { robot.ends(EndedKind::kJoints, EndedHow::kStopped, "the motors are off"); }},
    {"joint jams", [](Robot& robot) { robot.ends(EndedKind::kJoints, EndedHow::kRefused, "a jam"); }},
    {"joints accepted", [](Robot& robot) { robot.ends(EndedKind::kJoints, EndedHow::kUnknown, "version 1"); }},
    {"joints refused", [](Robot& robot) { robot.refuses(RefusedRequest::kJoints, RefusalCause::kRobot, "no"); }},
    {"joints too late", [](Robot& robot) { robot.refuses(RefusedRequest::kJoints, RefusalCause::kTooOld, "late"); }},
    {"joints dropped",
     [](Robot& robot) { robot.refuses(RefusedRequest::kJoints, RefusalCause::kReplaced, "legs walk"); }},
    {"walk refused",
     [](Robot& robot) {
       robot.refuses(RefusedRequest::kWalk, RefusalCause::kRobot, "no; let go first: send zero velocities");
     }},
    {"velocity too late", [](Robot& robot) { robot.refuses(RefusedRequest::kWalk, RefusalCause::kTooOld, "late"); }},
    {"velocity dropped", [](Robot& robot) { robot.refuses(RefusedRequest::kWalk, RefusalCause::kReplaced, "a 0"); }},
    {"velocity stopped",
     [](Robot& robot) { robot.refuses(RefusedRequest::kWalk, RefusalCause::kStopped, "a motion"); }},
    {"velocity of 0", [](Robot& robot) { robot.steer(0); }},
    {"velocity begins", [](Robot& robot) { robot.begins(); }},
    {"walk", [](Robot& robot) { robot.walk(); }},
    {"nobody steers", [](Robot& robot) { robot.mover.stopWalking("no cmd_vel came for 0.5 s"); }},
};

void happen(Robot& robot, const std::vector<std::string>& events) {
  for (const std::string& event : events) {
    kEvents.at(event)(robot);
  }
}

TEST(Ends, OfACommandAreThoseOfTheTable) {
  const struct {
    const char* end;
    std::vector<std::string> events;
  } rows[] = {
      {"-", {}},
      {"DONE", {"joints done"}},
      {"NOT_REACHED a jam", {"joint jams"}},
      {"REFUSED no", {"joints refused"}},
      {"REFUSED late", {"joints too late"}},
      {"REPLACED WAG.MTN", {"joints taken"}},
      {"REPLACED legs walk", {"joints dropped"}},
      {"STOPPED the motors are off", {"joints held"}},
      {"STOPPED /panel called stop", {"stop"}},
      {"UNKNOWN version 1", {"joints accepted"}},
      {"REFUSED a jam", {"version 1", "joint jams"}},  // of some of the joints
      {"LOST the connection to the robot was lost; the movement will not be resumed", {"disconnected"}},
  };
  for (const auto& row : rows) {
    Robot robot;
    const auto begun = robot.command("head_pan", 0.5);
    happen(robot, row.events);
    happen(robot, row.events);  // an order ends once
    EXPECT_EQ(textOf(begun), row.end);
    EXPECT_EQ(robot.told_ends.size(), row.events.empty() ? 0 : 1) << row.end;
  }
}

const std::map<std::string, std::function<void(Robot&)>> kMovements = {
    {"command", [](Robot& robot) { robot.command("head_pan", 0.5); }},
    {"trajectory", [](Robot& robot) { robot.follow("head_pan", 0.5); }},
    {"leg", [](Robot& robot) { robot.command("left_front_knee", 0.5); }},
    {"leg's trajectory", [](Robot& robot) { robot.follow("left_front_knee", 0.5); }},
    {"motion", [](Robot& robot) { robot.play("NOD.MTN"); }},
    {"posture", [](Robot& robot) { robot.sit(); }},
    {"walk", [](Robot& robot) { robot.walk(); }},
    {"goal", [](Robot& robot) { robot.walkToGoal(); }},
};

TEST(Ends, OfAllThatIsUnderWayComeFromTheseEvents) {
  const std::pair<const char*, const char*> rows[] = {
      {"stop", "STOPPED /panel called stop"},
      {"empty trajectory", "STOPPED an empty trajectory came"},
      {"motors off", "STOPPED /panel switched the motors off"},
      {"disconnected", "LOST"},
      {"reconnected unnoticed", "LOST"},
  };
  for (const auto& [event, end] : rows) {
    for (const auto& [movement, begin] : kMovements) {
      Robot robot;
      begin(robot);
      happen(robot, {event});
      robot.mover.advance();
      EXPECT_THAT(robot.lastEnd(), StartsWith(end)) << event << ", " << movement;
      EXPECT_THAT(robot.told_ends, SizeIs(1)) << event << ", " << movement;
      EXPECT_THAT(robot.mover.state().movements, IsEmpty()) << event << ", " << movement;
    }
  }
}

// A movement goes on until the robot has ended its last order.
TEST(Ends, OfWhatAnOrderHasTakenOverComeFromTheRobotAndNameTheOrder) {
  const struct {
    const char* movement;
    const char* event;
    EndedHow how;
    const char* end;
  } rows[] = {
      {"command", "head command", EndedHow::kReplaced, "REPLACED of the robot"},
      {"leg", "sit", EndedHow::kReplaced, "REPLACED of the robot"},
      {"trajectory", "head command", EndedHow::kReplaced, "REPLACED a command moves its joints"},
      {"trajectory", "head trajectory", EndedHow::kReplaced, "REPLACED a newer trajectory moves its joints"},
      {"trajectory", "motion", EndedHow::kDone, "REPLACED /user plays WAG.MTN"},
      {"trajectory", "sit", EndedHow::kReplaced, "REPLACED /user called sit"},
      {"trajectory", "motors go off", EndedHow::kStopped, "STOPPED the motors are off"},
      {"leg's trajectory", "velocity", EndedHow::kReplaced, "REPLACED /teleop lets the robot walk"},
      {"walk", "sit", EndedHow::kReplaced, "REPLACED /user called sit"},
      {"walk", "leg command", EndedHow::kReplaced, "REPLACED /other moves left_front_knee"},
      {"walk", "motors go off", EndedHow::kStopped, "STOPPED the motors are off"},
      {"walk", "fallen", EndedHow::kFell, "FELL of the robot"},
      {"walk", "goal", EndedHow::kDone, "REPLACED /user sends the robot to a goal"},
      {"goal", "velocity", EndedHow::kDone, "REPLACED /teleop steers now"},
  };
  for (const auto& row : rows) {
    Robot robot;
    kMovements.at(row.movement)(robot);
    const std::uint64_t order = robot.client.order();
    happen(robot, {row.event});
    EXPECT_THAT(robot.told_ends, IsEmpty()) << row.movement << ", " << row.event;
    robot.ends(EndedKind::kUnknown, row.how, "of the robot", order);
    EXPECT_EQ(robot.lastEnd(), row.end) << row.movement << ", " << row.event;
  }
}

TEST(Ends, OfWhatTheRobotMovesAreWhatItSaysOfThisOrder) {
  for (const auto& [movement, kind] :
       {std::pair("motion", EndedKind::kMotion), {"posture", EndedKind::kPosture}, {"walk", EndedKind::kWalk}}) {
    for (const EndedHow how :
         {EndedHow::kDone, EndedHow::kReplaced, EndedHow::kStopped, EndedHow::kRefused, EndedHow::kFell}) {
      Robot robot;
      kMovements.at(movement)(robot);
      robot.mover.ended({kind, how, "", "nobody's", 0});
      robot.ends(kind, how, "another's", robot.client.order() + 1000);
      EXPECT_EQ(robot.lastEnd(), "-");
      robot.ends(kind, how, "of the robot");
      ASSERT_THAT(robot.told_ends, SizeIs(1));
      EXPECT_EQ(robot.told_ends[0].how, how);
      EXPECT_EQ(robot.told_ends[0].reason, "of the robot");
    }
  }
}

TEST_F(MoverTest, ANodeThatCommandsTheSameJointsAgainGoesOnWithItsMovement) {
  const auto first = command("head_pan", 0.5);
  const std::uint64_t older = client.order();
  EXPECT_EQ(command("head_pan", 0.4).id, first.id);
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  ends(EndedKind::kJoints, EndedHow::kReplaced, "the next one", older);
  EXPECT_EQ(textOf(first), "-");
  EXPECT_NE(mover.command(order(), {"head_pan"}, {0.3}, {}, Kind::kLookAt).id, first.id)
      << "a look is another movement";
  EXPECT_EQ(command("head_pan", 0.2).id, first.id) << "the robot has not ended it";
}

TEST_F(MoverTest, AStreamThatIsRefusedAgainAndAgainHasOneEnd) {
  client.problem = "there is no robot";
  for (int i = 0; i < 10; ++i, now += 100ms) {
    command("head_pan", 0.1 * i);
    steer(0.1);
  }
  EXPECT_THAT(told_ends, SizeIs(2));
  command("head_pan", 0, "/other");
  EXPECT_THAT(told_ends, SizeIs(3)) << "of another node";
  now += 500ms;
  command("head_pan", 0);
  EXPECT_THAT(told_ends, SizeIs(4)) << "after a pause";
  EXPECT_EQ(textOf(play("NOD.MTN")), "REFUSED there is no robot");
  EXPECT_EQ(textOf(sit()), "REFUSED there is no robot");
  EXPECT_THAT(told_ends, SizeIs(6)) << "each call has its answer";
}

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
      EXPECT_THAT(robot.lastEnd(), testing::AllOf(StartsWith("REFUSED"), HasSubstr(row.reason))) << name;
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

TEST(Orders, GetTooOldHalfASecondAfterTheyCame) {
  for (const auto& [name, give] : kOrders) {
    Robot robot;
    const Order order = robot.order();
    robot.now += 500ms;
    robot.measure(0);
    give(robot, order);
    if (name == std::string("goal")) {
      robot.mover.steerToGoal(robot.mover.state().movements.at(0).order, {0.1, 0, 0});
    }
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
  EXPECT_EQ(mover.command(order(), {"head_pan", "a", "b", "c", "d"}, {0.1, 0, 0, 0, 0}, {}).remark,
            "The ERS-7 has no joint 'a'. The ERS-7 has no joint 'b'. The ERS-7 has no joint 'c'. and 1 more");
  EXPECT_EQ(textOf(command("a", 0.1)), "REFUSED The ERS-7 has no joint 'a'");
  EXPECT_THAT(textOf(follow("a\n\x1b[31m", 0)), Not(testing::AnyOf(HasSubstr("\n"), HasSubstr("\x1b"))));
  EXPECT_LE(textOf(follow(std::string(100000, 'a'), 0)).size(), 1020u);
}

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

TEST(Stop, OfEachMovementIsTheLastThatIsSentUntilRelease) {
  for (const auto& [movement, begin] : kMovements) {
    Robot robot;
    begin(robot);
    const MovementId moving = robot.mover.state().movements.at(0).order;
    robot.told();
    const auto try_to_move = [&robot, moving](const std::string& node) {
      for (const auto& [name, give] : kOrders) {
        give(robot, robot.order(node));
        EXPECT_EQ(robot.lastEnd(), "REFUSED stopped by /panel; call release") << name;
      }
      robot.pass(100ms);
      robot.mover.steerToGoal(moving, {0.1, 0, 0});
    };
    robot.client.meanwhile = [&] {
      try_to_move("/during");
      EXPECT_THROW(robot.mover.release(robot.order()), CommandException);
      EXPECT_THAT(robot.mover.state().movements, SizeIs(1)) << "the robot has not answered";
    };
    robot.mover.stop(robot.order("/panel"));
    try_to_move("/after");
    EXPECT_THAT(robot.told(), ElementsAre("hold")) << movement;
    EXPECT_THAT(robot.mover.state().movements, IsEmpty()) << movement;
    robot.mover.release(robot.order());
    robot.pass(100ms);
    robot.mover.steerToGoal(moving, {0.1, 0, 0});
    EXPECT_THAT(robot.told(), IsEmpty()) << movement << ": nothing starts by itself";
  }
}

TEST(Stop, ThatDoesNotReachTheRobotRefusesOrdersAllTheSame) {
  const std::pair<const char*, std::function<void()>> rows[] = {
      {"UNKNOWN /panel called stop, but no answer within 2000 ms", doNotAnswer},
      {"LOST there is no robot", [] { throw aibo_client::NetworkException("there is no robot."); }}};
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

TEST_F(MoverTest, WhatIsReportedDuringAStopHasTheReasonOfTheStop) {
  const auto motion = play("NOD.MTN");
  const std::uint64_t playing = client.order();
  const auto read = play("WAG.MTN");  // from the memory stick
  const std::uint64_t reading = client.order();
  const auto done = play("SIT.MTN");
  const auto done_order = client.order();
  const auto head = command("head_pan", 0.4);
  client.meanwhile = [&] {
    ends(EndedKind::kMotion, EndedHow::kDone, "", done_order);
    ends(EndedKind::kMotion, EndedHow::kStopped, "the client holds it", playing);
    refuses(RefusedRequest::kMotion, RefusalCause::kRobot, "it was stopped before it was read", reading);
    refuses(RefusedRequest::kJoints, RefusalCause::kStopped, "a stop came before it was sent");
  };
  mover.stop(order("/panel"));
  EXPECT_EQ(textOf(done), "DONE") << "before the stop";
  for (const auto& begun : {motion, read, head}) {
    EXPECT_EQ(textOf(begun), "STOPPED /panel called stop");
  }
  EXPECT_THAT(told_ends, SizeIs(4));
}

TEST_F(MoverTest, AWalkThatBeginsAfterItsMovementHasEndedIsStopped) {
  steer(0.1);
  const std::uint64_t late = client.order();
  client.meanwhile = doNotAnswer;
  EXPECT_THROW(mover.stop(order("/panel")), TimeoutException);
  told();
  mover.steered({0.1, 0, 0}, late, late);
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
}

TEST_F(MoverTest, CancellingEndsOneMovementAndHoldsItsJoints) {
  const auto posture = sit();
  const auto trajectory = follow("head_pan", 0.5);
  const auto waiting = mover.follow(order(), {{"mouth"}, {{1.0, {-0.2}, {}}}}, 5s);
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
TEST_F(MoverTest, AVersion1ServerHoldsWhereTheJointsShouldBe) {
  happen(*this, {"version 1"});
  follow("head_pan", 0.5);
  happen(*this, {"joints accepted"});
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.05 in 0", "stop ")) << "96 ms ahead";
  mover.release(order());
  measure(0.5);
  command("head_pan", -1);
  happen(*this, {"joints accepted"});
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.50 in 0", "stop ")) << "motions end, too";
  mover.release(order());
  const auto head = follow("head_pan", 0.6);
  told();
  mover.cancel(head.id, "the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre(StartsWith("J 2:")));
  measured.clear();
  command("head_pan", -0.7);
  told();
  mover.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:-0.70 in 0", "stop ")) << "nobody knows where it is";
}

TEST_F(MoverTest, TheMotorsAreWhatTheRobotSaysAndUnknownWithoutAConnection) {
  EXPECT_TRUE(mover.setMotors(order(), true));
  client.meanwhile = [this] { says(MotorState::kOff, PostureNow::kStanding); };
  EXPECT_TRUE(mover.setMotors(order(), true));
  EXPECT_EQ(mover.state().robot.motors, MotorState::kOff) << "the robot has said so since";
  client.motors_work = false;
  EXPECT_FALSE(mover.setMotors(order(), true));
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

TEST_F(MoverTest, AJointThatIsStoppedOnTheWayBeginsAgainSlowly) {
  command("head_pan", 1.0);
  mover.stop(order("/panel"));
  mover.release(order("/panel"));
  pass(5s);  // longer than the way would have taken
  command("head_pan", 1.0);
  EXPECT_EQ(client.speed_limits.at({client.connections, kHeadPan}), 0.5);
}

TEST_F(MoverTest, MotionsAndWalksHaveTheRobotsOwnSpeedsAndCommandsKeepTheirs) {
  const auto speed_limits = [this] {
    const std::vector<std::string> all = std::exchange(client.told, {});
    return all.size() - withoutSpeedLimits(all).size();
  };
  play("NOD.MTN");
  EXPECT_EQ(speed_limits(), table.size());
  command("head_pan", 0.1);
  EXPECT_THAT(client.told, ElementsAre("V 2:0.50", "J 2:0.10 in 0"));
  command("left_front_knee", 0.1);
  speed_limits();
  steer(0.1);
  EXPECT_EQ(speed_limits(), 1U) << "of this knee";
}

// What the client reports before the call returns, and what the call throws.
TEST(Motion, ThatDoesNotBeginEndsByWhatTheClientReports) {
  for (const bool is_posture : {false, true}) {
    const RefusedRequest request = is_posture ? RefusedRequest::kPosture : RefusedRequest::kMotion;
    const struct {
      const char* end;
      std::function<void(Robot&)> report;
      std::function<void()> fail;
    } rows[] = {
        {"REFUSED There is none", [&](Robot& robot) { robot.refuses(request, RefusalCause::kRobot, "There is none"); },
         [] { throw CommandException("There is none."); }},
        {"REFUSED it was not sent",
         [&](Robot& robot) { robot.refuses(request, RefusalCause::kTooOld, "it was not sent"); },
         [] { throw TimeoutException("it was not sent."); }},
        {"STOPPED a stop", [&](Robot& robot) { robot.refuses(request, RefusalCause::kStopped, "a stop"); },
         [] { throw CommandException("a stop."); }},
        {"LOST", [](Robot& robot) { robot.mover.disconnected(); },
         [] { throw aibo_client::NetworkException("it broke.", aibo_client::FaultKind::kNone, true); }},
        {"DONE", [](Robot& robot) { robot.ends(EndedKind::kUnknown, EndedHow::kDone); }, [] {}},
        {"-", [](Robot&) {}, doNotAnswer}};  // it may begin or not
    for (const auto& row : rows) {
      Robot robot;
      robot.client.meanwhile = [&] {
        row.report(robot);
        row.fail();
      };
      const auto begun = is_posture ? robot.sit() : robot.play("NOD.MTN");
      EXPECT_THAT(textOf(begun), StartsWith(row.end));
      EXPECT_EQ(begun.is_uncertain, begun.ended() == nullptr) << row.end;
    }
  }
}

TEST_F(MoverTest, WhatMayOrMayNotBeginStaysUntilTheRobotSays) {
  client.meanwhile = doNotAnswer;
  const auto plays = play("NOD.MTN");
  EXPECT_TRUE(plays.is_uncertain);
  EXPECT_EQ(plays.remark, "no answer within 2000 ms");
  ends(EndedKind::kMotion, EndedHow::kDone);
  EXPECT_EQ(textOf(plays), "DONE");
  client.meanwhile = doNotAnswer;
  const auto refused = sit();
  refuses(RefusedRequest::kPosture, RefusalCause::kRobot, "the motors do not answer");
  EXPECT_EQ(textOf(refused), "REFUSED the motors do not answer");
}

TEST_F(MoverTest, AtMost32MotionsGoOn) {
  for (int i = 0; i < 32; ++i) {
    EXPECT_EQ(textOf(play("NOD.MTN")), "-");
  }
  EXPECT_THAT(textOf(play("NOD.MTN")), StartsWith("REFUSED 32 others of this kind"));
  EXPECT_EQ(textOf(sit()), "-");
}

TEST_F(MoverTest, StoppingOneMotionLeavesTheOthers) {
  const auto nod = play("NOD.MTN");
  const auto wag = play("WAG.MTN");
  mover.stopMotion(order("/panel"), "NOD.MTN");
  EXPECT_EQ(client.told.back(), "stop NOD.MTN");
  EXPECT_EQ(textOf(nod), "STOPPED /panel stopped it");
  EXPECT_EQ(textOf(wag), "-");
}

TEST(Trajectory, IsRefusedUnlessItsJointsAreMeasured) {
  const struct {
    const char* end;
    int version;
    std::chrono::milliseconds age;
  } rows[] = {
      {"-", 2, 300ms},
      {"REFUSED head_pan was last measured 0.4 s ago", 2, 400ms},
      {"-", 1, 2000ms},
      {"REFUSED head_pan was last measured 2.1 s ago", 1, 2100ms},
  };
  for (const auto& row : rows) {
    Robot robot;
    robot.client.present.protocol_version = row.version;
    robot.now += row.age - 1ms;
    EXPECT_THAT(textOf(robot.follow("head_pan", 0.5)), StartsWith(row.end));
  }
  Robot robot;
  robot.measured.clear();
  robot.command("head_pan", 0.2);
  EXPECT_THAT(textOf(robot.follow("head_pan", 0.5)), HasSubstr("telemetry_rate above 0?"));
}

TEST_F(MoverTest, ATrajectorySaysWhereItWantsItsJointsAndWhenItEnds) {
  const auto trajectory = follow("head_pan", 0.5);
  EXPECT_EQ(mover.state().movements.at(0).end, now + 1s);
  ASSERT_THAT(mover.wantedBy(trajectory.id, now + 100ms), SizeIs(1));
  EXPECT_NEAR(mover.wantedBy(trajectory.id, now + 100ms)[0].position, 0.05, 1e-9);
}

// Of a trajectory of one second, whose steps the robot ends when it gets the next one.
TEST(Trajectory, EndsByItsLastStepOrByWhatInterruptsIt) {
  const struct {
    const char* end;
    std::vector<std::string> events;  // after 0.2 s
  } rows[] = {
      {"DONE", {}},
      {"NOT_REACHED head_pan is 0.10 rad away", {"it is not reached"}},
      {"NOT_REACHED a jam (head_pan is 0.10 rad away)", {"a step jams", "it is not reached"}},
      {"DONE", {"a step jams"}},
      {"DONE", {"joints done"}},  // of a step that was due before the next one was sent
      {"REFUSED no", {"joints refused"}},
      {"REFUSED late", {"joints too late"}},
      {"REPLACED WAG.MTN", {"joints taken"}},
      {"STOPPED the motors are off", {"joints held"}},
  };
  for (const auto& row : rows) {
    Robot robot;
    const auto trajectory = robot.follow("head_pan", 0.5);
    std::uint64_t older = robot.client.order();
    bool is_reached = true;
    const auto go_on = [&](int steps) {
      for (int i = 0; i < steps; ++i) {
        robot.pass(JointPlan::kPeriod);
        if (robot.client.order() != older) {
          robot.ends(EndedKind::kJoints, EndedHow::kReplaced, "the next step",
                     std::exchange(older, robot.client.order()));
        }
      }
    };
    go_on(6);
    for (const std::string& event : row.events) {
      if (event == "a step jams") {
        robot.pass(JointPlan::kPeriod);
        robot.ends(EndedKind::kJoints, EndedHow::kRefused, "a jam", std::exchange(older, robot.client.order()));
      } else if (event == "it is not reached") {
        is_reached = false;
      } else {
        happen(robot, {event});
      }
    }
    go_on(40);
    is_reached ? robot.ends(EndedKind::kJoints, EndedHow::kDone)
               : robot.ends(EndedKind::kJoints, EndedHow::kRefused, "head_pan is 0.10 rad away");
    EXPECT_EQ(textOf(trajectory), row.end);
    EXPECT_THAT(robot.told_ends, SizeIs(1)) << row.end;
    EXPECT_FALSE(robot.mover.advance()) << row.end << ": nothing is left";
  }
}

TEST_F(MoverTest, ATrajectoryWithTolerancesOrInVersion1IsMeasured) {
  Arrival arrival;
  arrival.is_measured = true;
  arrival.tolerances["head_pan"].position = 0.2;
  const std::pair<Arrival, double> rows[] = {{arrival, 0.35}, {{}, 0.5}};
  for (const auto& [allowed, pan] : rows) {
    const auto trajectory = mover.follow(order(), {{"head_pan"}, {{1.0, {0.5}, {}}}}, 0ms, allowed);
    pass(992ms, pan);
    ends(EndedKind::kJoints, EndedHow::kRefused, "0.15 rad away");
    EXPECT_EQ(textOf(trajectory), "-");
    pass(96ms, pan);
    EXPECT_EQ(textOf(trajectory), "DONE");
    happen(*this, {"version 1"});
  }
}

TEST_F(MoverTest, AStepIsAsOldAsTheStepBefore) {
  const auto received = now;
  follow("head_pan", 0.5);
  EXPECT_EQ(client.terms.not_after, received + 500ms);
  pass(64ms);
  EXPECT_EQ(client.terms.not_after, now - 32ms + 500ms);
  const auto last = now;
  now += 1s;
  measure(0);
  follow("mouth", -0.1);
  EXPECT_EQ(client.terms.not_after, last + 500ms) << "what the driver sends after a stall is too old";
}

TEST_F(MoverTest, ATrajectoryWhoseStepCannotBeSentIsLost) {
  const auto trajectory = follow("head_pan", 0.5);
  client.problem = "there is no robot";
  pass(32ms);
  EXPECT_EQ(textOf(trajectory), "LOST there is no robot");
}

TEST(Walk, HasToBeLetGoFirstAfterTheseEvents) {
  const struct {
    std::string reason;
    std::vector<std::string> events;
  } rows[] = {
      {"the robot was stopped", {"stop", "release"}},
      {"an empty trajectory came", {"empty trajectory"}},
      {"the connection is a new one", {"reconnected"}},
      {"/user called sit", {"sit"}},
      {"it was cancelled", {"sit", "velocity of 0", "velocity", "posture cancelled"}},
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
      {"/user plays WAG.MTN", {"walk not steered", "motion"}},
      {"a motion", {"walk not steered", "velocity", "velocity stopped"}},
  };
  for (const auto& row : rows) {
    for (const bool by_a_zero : {true, false}) {
      Robot robot;
      robot.walk();
      happen(robot, row.events);
      robot.told();
      for (int i = 0; i < 20; ++i, robot.now += 50ms) {  // a joystick that is held
        robot.steer(0.1);
        robot.steer(0, "/other");
        EXPECT_EQ(robot.lastEnd(), "REFUSED " + row.reason + kLetGo);
      }
      EXPECT_THAT(robot.told(), testing::Each("steer 0.00 0.00 0.00")) << row.reason;
      by_a_zero ? robot.steer(0) : robot.pass(500ms);
      robot.told();
      robot.steer(0.1);
      EXPECT_THAT(robot.told(), ElementsAre("steer 0.00 0.00 0.00", "steer 0.10 0.00 0.00"))
          << row.reason << ": the robot is told that this node has let go";
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

// A frozen link looks the same.
TEST_F(MoverTest, ARobotThatWasNotSteeredForAWhileIsNotLetGo) {
  walk();
  walkEnds(EndedHow::kStopped, "it was not steered for 500 ms");
  EXPECT_EQ(lastEnd(), "STOPPED it was not steered for 500 ms");
  told();
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00", "steer 0.10 0.00 0.00"));
}

TEST(Walk, GoesOnAfterTheseEvents) {
  const std::vector<std::string> rows[] = {
      {"head command"},
      {"head trajectory"},
      {"no telemetry", "leg trajectory"},
      {"release"},
      {"velocity", "velocity too late"},
      {"motion"},
      {"velocity", "velocity stopped"},
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

TEST_F(MoverTest, ATrajectoryOfTheHeadGoesOnWhenAWalkBegins) {
  const auto head = follow("head_pan", 0.5);
  walk();
  pass(64ms);
  EXPECT_EQ(textOf(head), "-");
  EXPECT_EQ(told().back().rfind("J 2:", 0), 0U);
}

TEST_F(MoverTest, AWalkBrakesAtAVelocityOf0AndIsDoneWhenTheRobotSaysSo) {
  walk();
  steer(0.2);
  mover.steered({0.2, 0, 0}, client.order(), walk_order);
  steer(0);
  mover.steered({}, 0, walk_order);
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00", "steer 0.10 0.00 0.00", "steer 0.20 0.00 0.00",
                                  "steer 0.00 0.00 0.00"));
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  walkEnds(EndedHow::kDone);
  EXPECT_EQ(lastEnd(), "DONE");
}

// "walk" has begun, and "velocity" is on its way.
TEST(Walk, EndsAsTheseEventsSay) {
  const std::string refused = "REFUSED no; let go first: send zero velocities";
  const struct {
    std::string end;
    std::size_t left;  // walks that have not ended
    std::vector<std::string> events;
  } rows[] = {
      {refused, 0, {"velocity", "walk refused"}},
      {"REFUSED late", 0, {"velocity", "velocity too late"}},
      {"STOPPED it was let go before the robot walked", 0, {"velocity", "velocity of 0", "velocity dropped"}},
      {"FELL it fell", 0, {"walk", "velocity", "walk fell"}},
      {"-", 1, {"walk", "velocity", "walk refused"}},
      {refused, 0, {"walk", "velocity", "walk refused", "walk done"}},
      {"DONE", 1, {"walk", "velocity of 0", "velocity", "walk done"}},  // another walk
      {"-", 1, {"walk", "velocity", "walk done", "velocity begins"}},   // it crossed the end, and goes on
      {"DONE", 0, {"walk", "velocity", "walk done", "velocity begins", "walk done"}},
      {"-", 1, {"walk", "nobody steers"}},
      {"STOPPED no cmd_vel came for 0.5 s", 0, {"walk", "nobody steers", "walk done"}},
      {"FELL it fell", 0, {"walk", "nobody steers", "walk fell"}},
  };
  for (const auto& row : rows) {
    Robot robot;
    happen(robot, row.events);
    EXPECT_EQ(robot.lastEnd(), row.end) << ::testing::PrintToString(row.events);
    EXPECT_THAT(robot.mover.state().movements, SizeIs(row.left)) << ::testing::PrintToString(row.events);
    const bool is_let_go = row.events[1] == "nobody steers";
    EXPECT_TRUE(!is_let_go || robot.told().back() == "steer 0.00 0.00 0.00");
  }
}

TEST_F(MoverTest, OneWalkMayBeSteeredByTwoNodesAndIsTheOthersAfterAPause) {
  walk();
  steer(0.1, "/navigation");
  EXPECT_THAT(mover.state().movements, SizeIs(1));
  mover.steered({0.1, 0, 0}, client.order(), walk_order);
  pass(600ms);
  steer(0.1, "/navigation");
  EXPECT_EQ(mover.state().movements.back().source, "/navigation");
  walkEnds(EndedHow::kDone);
  EXPECT_EQ(lastEnd(), "REPLACED /navigation steers now");
}

TEST_F(MoverTest, AGoalIsReachedWhenTheRobotStandsThere) {
  const auto goal = mover.walkToGoal(order(), "1 m ahead");
  EXPECT_EQ(mover.state().movements.at(0).name, "1 m ahead");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00")) << "it lets go of an earlier walk";
  mover.steerToGoal(goal.id, {0.1, 0, 0});
  begins();
  mover.steerToGoal(goal.id, {});
  EXPECT_EQ(textOf(goal), "-");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00", "steer 0.10 0.00 0.00", "steer 0.00 0.00 0.00"));
  walkEnds(EndedHow::kDone);
  EXPECT_EQ(textOf(goal), "DONE");
  const auto here = mover.walkToGoal(order(), "here");
  told();
  mover.steerToGoal(here.id, {});
  EXPECT_EQ(textOf(here), "DONE") << "it is there already";
  steer(0);
  EXPECT_THAT(told(), IsEmpty()) << "a robot that stands is not told to";
}

TEST(Goal, IsNotWalkedToAfterTheseEvents) {
  const struct {
    const char* end;
    bool has_begun;  // if the robot does not walk for it yet, nothing else could end it
    std::vector<std::string> events;
  } rows[] = {
      {"STOPPED /panel called stop", true, {"stop"}},
      {"LOST the connection to the robot was lost", true, {"reconnected"}},
      {"LOST the connection to the robot was lost", true, {"reconnected unnoticed"}},
      {"LOST there is no robot", true, {"no robot"}},
      {"STOPPED no velocity came to the robot for 0.5 s", true, {"walk done"}},
      {"STOPPED it was not steered for 500 ms", true, {"walk not steered"}},
      {"REFUSED an edge", true, {"edge"}},
      {"FELL it fell", true, {"walk fell"}},
      {"REPLACED a leg", true, {"legs taken"}},
      {"REPLACED /user sends the robot to a goal", false, {"goal"}},
      {"REPLACED /teleop steers now", false, {"velocity"}},
      {"REPLACED /user called sit", false, {"sit"}},
      {"REPLACED /other moves left_front_knee", false, {"leg command"}},
      {"STOPPED the motors are off", false, {"motors go off"}},
      {"STOPPED /panel called stop", false, {"stop"}},
      {"FELL the robot was lifted", false, {"lifted"}},
  };
  for (const auto& row : rows) {
    Robot robot;
    const auto goal = row.has_begun ? robot.walkToGoal() : robot.mover.walkToGoal(robot.order(), "1 m ahead");
    happen(robot, row.events);
    robot.told();
    robot.mover.steerToGoal(goal.id, {0.1, 0, 0});
    EXPECT_THAT(robot.told(), Not(Contains("steer 0.10 0.00 0.00"))) << row.end;
    EXPECT_THAT(textOf(goal), StartsWith(row.end));
  }
}

TEST_F(MoverTest, AVelocityToAGoalIsAsOldAsTheOneBefore) {
  const auto received = now;
  const auto goal = mover.walkToGoal(order(), "1 m ahead");
  now += 100ms;
  mover.steerToGoal(goal.id, {0.1, 0, 0});
  EXPECT_EQ(client.terms.not_after, received + 500ms);
  now += 3s;  // the driver stalls
  mover.steerToGoal(goal.id, {0.1, 0, 0});
  EXPECT_EQ(client.terms.not_after, received + 600ms);
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
    robot.mover.steerToGoal(goal.id, {0.1, 0, 0});
    EXPECT_EQ(textOf(goal), "-") << "the robot has not said that it stands";
    EXPECT_THAT(robot.told(), ElementsAre("steer 0.00 0.00 0.00"));
    robot.walkEnds(EndedHow::kDone);
    EXPECT_EQ(textOf(goal), end);
  }
}

}  // namespace
}  // namespace aibo_driver::movement
