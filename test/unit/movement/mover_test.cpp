#include "movement/mover.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::movement {

using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::MotorState;
using aibo_client::Posture;
using aibo_client::PostureNow;
using aibo_client::RefusalCause;
using aibo_client::RefusedRequest;
using aibo_client::TimeoutException;

namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::SizeIs;
using ::testing::StartsWith;
using Kind = Movement::Kind;

constexpr int kHeadPan = 2;
constexpr int kLeftFrontRotator = 11;
constexpr int kTailTilt = 52;

constexpr milliseconds kOnItsWay{3};  // how long an order has waited

[[noreturn]] void doNotAnswer() {
  throw TimeoutException("no answer within 2000 ms.", aibo_client::FaultKind::kNone, true);
}

// A different value in each direction.
aibo_client::WalkVelocity velocity(double forward) {
  return {forward, -0.4 * forward, 3 * forward};
}

const aibo_client::WalkVelocity kAhead = velocity(0.1);

// The speed limit of the head's pan is 3.0 rad/s, the approach speed 0.5 rad/s. The time stands still unless the test
// lets it pass.
class MoverTest : public ::testing::Test {
 protected:
  MoverTest() {
    table_.setSpeedScale(0.5);
    client_.present.robot.capabilities = {"I", "S", "E", "O"};
    mover_.setListener({[this] { changed(); }, [this] { moving_ = mover_.state().movements.size(); },
                        [this](const EndedMovement& ended) { ends_.push_back(ended); },
                        [this](const std::string& text) { warnings_.push_back(text); }});
    liveThroughMuch();
  }

  // What was before: movements of each kind, each of which ended badly.
  void liveThroughMuch() {
    measure(0.3);
    command("head_tilt", 0.2, "/past");
    follow("head_pan", -0.5, 2.0);
    play("PAST.MTN");
    walk();
    mover_.ended({EndedKind::kWalk, EndedHow::kFell, "walk", "it fell in the past"});
    client_.meanwhile = doNotAnswer;
    problem<TimeoutException>([this] { mover_.stop(order("/past")); });
    mover_.release(order("/past"));
    now_ += std::chrono::seconds(1);
    mover_.takePosture(order("/past"), Posture::kSit);
    mover_.disconnected();
    ++client_.connections;
    mover_.connected();
    now_ += std::chrono::seconds(1);
    measure(0.0);
    client_.told.clear();
    past_ = std::exchange(ends_, {});
    EXPECT_THAT(warnings_, IsEmpty());
  }

  // Whatever happens: the state has the ends that were told, and joints are sent on behalf of what moves them.
  void changed() {
    shown_ = mover_.state();
    std::vector<EndedMovement> told = past_;
    told.insert(told.end(), ends_.begin(), ends_.end());
    ASSERT_EQ(shown_.ends, told.size());
    ASSERT_EQ(shown_.ended.size(), std::min(told.size(), Mover::kEndsRemembered));
    for (std::size_t i = 1; i <= shown_.ended.size(); ++i) {
      EXPECT_EQ(textOf(shown_.ended[shown_.ended.size() - i]), textOf(told[told.size() - i]));
    }
    for (const auto& [joint, number] : std::exchange(client_.joint_orders, {})) {
      const std::vector<std::string> joints = mover_.jointsOf(number);
      EXPECT_TRUE(joints.empty() || testing::Value(joints, Contains(table_[*table_.findById(joint)].name))) << joint;
    }
  }

  static std::string textOf(const EndedMovement& ended) {
    return describe(ended.movement) + " " + ended.movement.name + " of " + ended.movement.source + " ends " +
           std::to_string(static_cast<int>(ended.how)) + " " + ended.reason;
  }

  void measure(double pan, double rotator = 0.07) {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = now_;
    telemetry.joints = {{kHeadPan, pan}, {1, -0.2}, {kLeftFrontRotator, rotator}};
    measured_.update(telemetry);
  }

  // As the driver does.
  void pass(milliseconds time, double pan) {
    const SteadyTime end = now_ + time;
    while (now_ < end) {
      now_ += JointPlan::kPeriod;
      measure(pan);
      mover_.goOn();
    }
  }

  void useVersion1() {
    client_.can_hold = false;
    client_.present.protocol_version = 1;
    client_.present.robot.capabilities.clear();
  }

  Order order(const std::string& source = "/user") const { return {source, now_ - kOnItsWay}; }

  Mover::Begun command(const std::string& joint, double position, const std::string& source = "/user") {
    return mover_.command(order(source), {joint}, {position}, {});
  }

  Mover::Begun play(const std::string& motion) { return mover_.play(order(), motion, 1); }

  Mover::Begun follow(const std::string& joint, double position, double time) {
    return mover_.follow(order(), {{joint}, {{time, {position}, {}}}}, milliseconds(0));
  }

  void steer(double forward, const std::string& source = "/teleop") { mover_.steer(order(source), velocity(forward)); }

  // Ten times a second, for a second.
  void steerOn(double forward) {
    for (int i = 0; i < 10; ++i) {
      now_ += milliseconds(100);
      steer(forward);
    }
  }

  // The robot walks.
  void walk() {
    steer(0.1);
    mover_.steered(kAhead, client_.steering_order);
    client_.told.clear();
  }

  // What the robot was told to do, without speed limits.
  std::vector<std::string> told() {
    std::vector<std::string> told;
    for (const std::string& each : std::exchange(client_.told, {})) {
      if (each.rfind("V ", 0) != 0) {
        told.push_back(each);
      }
    }
    return told;
  }

  static std::string reasonOf(const Mover::Begun& begun) {
    return begun.ended() != nullptr ? begun.ended()->reason : "it goes on";
  }
  static EndedHow endOf(const Mover::Begun& begun) {
    EXPECT_NE(begun.ended(), nullptr);
    return begun.ended() != nullptr ? begun.ended()->how : EndedHow::kUnknown;
  }

  template <typename Error>
  static std::string problem(const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }

  test_support::FakeClient client_;
  SteadyTime now_{milliseconds(1000137)};
  JointTable table_{"ERS-7", 6.0, 9.0};
  MeasuredJoints measured_{table_};
  bool telemetry_ = true;
  Mover mover_{table_, measured_, client_, 0.5, false, [this] { return telemetry_; }, [this] { return now_; }};
  Mover::State shown_;               // when the mover last said that it had changed
  std::size_t moving_ = 0;           // movements when the mover last asked to be called regularly
  std::vector<EndedMovement> past_;  // what ended before the test
  std::vector<EndedMovement> ends_;
  std::vector<std::string> warnings_;
};

TEST(Movement, IsDescribedInWordsThatBeginASentence) {
  const std::vector<std::string> joints{"head_pan", "mouth"};
  EXPECT_EQ(describe({Kind::kCommand, "", "/user", joints, {}}), "The command of head_pan, mouth");
  EXPECT_EQ(describe({Kind::kCommand, "", "/user", {}, {}}), "The command");
  EXPECT_EQ(describe({Kind::kTrajectory, "", "/user", joints, {}}), "The trajectory of head_pan, mouth");
  EXPECT_EQ(describe({Kind::kMotion, "NOD.MTN", "/user", {}, {}}), "The motion NOD.MTN");
  EXPECT_EQ(describe({Kind::kWalk, "", "/user", {}, {}}), "The walk");
  EXPECT_EQ(describe({Kind::kPosture, "sit", "/user", {}, {}}), "The posture sit");
  EXPECT_EQ(describe({Kind::kLookAt, "", "/user", joints, {}}), "The look_at");
}

// ---- Ends

TEST_F(MoverTest, ACommandIsDoneWhenItsJointIsMeasuredThere) {
  const auto begun = command("head_pan", 0.5);
  EXPECT_THAT(told(), ElementsAre("J 2:0.50 in 0"));
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].source, "/user");
  pass(milliseconds(1200), 0.47);
  EXPECT_EQ(endOf(begun), EndedHow::kDone);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  EXPECT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(mover_.state().ended.back().movement.joints, std::vector<std::string>{"head_pan"});
}

TEST_F(MoverTest, ACommandWhoseJointDoesNotMoveIsNotReached) {
  const auto begun = command("head_pan", 0.5);
  pass(milliseconds(3200), 0.0);
  EXPECT_EQ(endOf(begun), EndedHow::kNotReached);
  EXPECT_EQ(reasonOf(begun), "head_pan is 0.50 rad from where it was sent");
}

TEST_F(MoverTest, SaysThatItHasChangedAndWhenItHasToGoOn) {
  command("head_pan", 0.5);
  EXPECT_EQ(moving_, 1u);
  follow("left_front_rotator", 0.1, 1.0);
  EXPECT_EQ(moving_, 2u);
  EXPECT_THAT(shown_.movements, SizeIs(2));
  mover_.robotChanged({MotorState::kOn, PostureNow::kStanding});
  EXPECT_EQ(shown_.robot.posture, PostureNow::kStanding);
  mover_.stop(order("/panel"));
  EXPECT_THAT(shown_.movements, IsEmpty());
  EXPECT_THAT(ends_, SizeIs(2));
  EXPECT_EQ(shown_.stopped_by, "/panel");
}

TEST_F(MoverTest, MovesAndHoldsEveryJoint) {
  useVersion1();
  std::vector<std::string> names;
  std::vector<double> positions;
  aibo_client::Telemetry there;
  for (const JointProperties& joint : table_.joints()) {
    names.push_back(joint.name);
    positions.push_back(joint.lowest);
    there.joints.push_back({joint.id, joint.lowest});
  }
  const std::vector<std::string> backwards(names.rbegin(), names.rend());
  const auto commanded = mover_.command(order(), backwards, {positions.rbegin(), positions.rend()}, {});
  EXPECT_EQ(mover_.jointsOf(commanded.id), names);
  const std::vector<std::string> sent = told();
  EXPECT_EQ(std::count(sent.back().begin(), sent.back().end(), ':'), 18);
  mover_.stop(order());
  EXPECT_EQ(commanded.ended()->movement.joints, names);
  const std::vector<std::string> held = told();
  ASSERT_THAT(held, SizeIs(1));
  EXPECT_EQ(std::count(held[0].begin(), held[0].end(), ':'), 18);
  mover_.release(order());
  now_ += std::chrono::seconds(10);
  const auto again = mover_.command(order(), names, positions, {});
  EXPECT_EQ(mover_.command(order(), names, positions, {}).id, again.id);
  now_ += std::chrono::seconds(10);
  there.arrival = now_;
  there.joints.front().position += 0.2;
  there.joints.back().position += 0.3;
  measured_.update(there);
  EXPECT_FALSE(mover_.goOn());
  EXPECT_EQ(reasonOf(again),
            "neck_tilt is 0.20 rad from where it was sent, tail_tilt is 0.30 rad from where it was sent");
  EXPECT_EQ(again.ended()->movement.joints, names);
  const auto refused = mover_.command({"/user", now_ - std::chrono::hours(1)}, backwards, positions, {});
  EXPECT_EQ(refused.ended()->movement.joints, names);
}

TEST_F(MoverTest, WhatTheRobotRefusesIsRefused) {
  const auto commanded = command("head_pan", 0.5);
  const auto other = command("head_tilt", 0.1);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kRobot, {kHeadPan}, "the motors are off", commanded.id});
  EXPECT_EQ(endOf(commanded), EndedHow::kRefused);
  EXPECT_EQ(reasonOf(commanded), "the motors are off");
  EXPECT_THAT(ends_.back().movement.joints, ElementsAre("head_pan"));
  EXPECT_EQ(other.ended(), nullptr);
  EXPECT_THAT(mover_.jointsOf(other.id), ElementsAre("head_tilt"));
  const auto followed = follow("head_pan", 0.5, 1.0);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kRobot, {4, kHeadPan}, "the motors are off", 0});
  EXPECT_EQ(reasonOf(followed), "the motors are off");
  told();
  mover_.goOn();
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverTest, ARefusalIsAboutTheOrderThatItNames) {
  const auto older = command("head_pan", 0.5, "/older");
  const auto newer = command("head_pan", 0.4, "/newer");
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kTooOld, {kHeadPan}, "too old", older.id});
  EXPECT_EQ(newer.ended(), nullptr);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kReplaced, {1}, "a motion plays", 0});
  EXPECT_EQ(newer.ended(), nullptr) << "it moves another joint";
  mover_.refused({RefusedRequest::kLeds, RefusalCause::kRobot, {kHeadPan}, "no such LED", 0});
  EXPECT_EQ(newer.ended(), nullptr);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kReplaced, {kHeadPan}, "a motion plays", 0});
  EXPECT_EQ(endOf(newer), EndedHow::kReplaced);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kStopped, {kHeadPan}, "a stop came before", 0});
  const auto last = command("head_pan", 0.4);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kStopped, {kHeadPan}, "another client has stopped it", 0});
  EXPECT_EQ(reasonOf(last), "another client has stopped it") << "the driver is not stopping it";
  const auto pan = command("head_pan", 0.4);
  const auto tilt = command("neck_tilt", -0.4, "/other");
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kReplaced, {kHeadPan, 1}, "a motion plays", 0});
  EXPECT_EQ(reasonOf(pan) + ", " + reasonOf(tilt), "a motion plays, a motion plays");
}

TEST_F(MoverTest, AJointThatDoesNotFollowIsTheReasonInTheEnd) {
  const auto commanded = command("head_pan", 0.5);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kJointFault, {kTailTilt, kHeadPan}, "head_pan is jammed", 0});
  EXPECT_EQ(commanded.ended(), nullptr) << "it may become free";
  pass(milliseconds(3200), 0.0);
  EXPECT_EQ(endOf(commanded), EndedHow::kNotReached);
  EXPECT_EQ(reasonOf(commanded), "head_pan is jammed (head_pan is 0.50 rad from where it was sent)");
  const auto both = mover_.command(order(), {"head_pan", "left_front_rotator"}, {0.5, 0.5}, {});
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kJointFault, {kTailTilt, kHeadPan}, "head_pan is jammed", 0});
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kJointFault, {kLeftFrontRotator}, "a leg is jammed", 0});
  pass(milliseconds(3200), 0.5);
  EXPECT_EQ(reasonOf(both), "a leg is jammed (left_front_rotator is 0.43 rad from where it was sent)")
      << "the head became free";
  const auto again = command("head_pan", 0.0);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kJointFault, {kTailTilt, kHeadPan}, "head_pan is jammed", 0});
  command("head_pan", 0.1);
  pass(milliseconds(3200), 0.2);
  EXPECT_EQ(reasonOf(again), "head_pan is 0.10 rad from where it was sent") << "it followed the second command";
  const auto replaced = command("head_pan", 0.0);
  mover_.refused({RefusedRequest::kJoints, RefusalCause::kJointFault, {kTailTilt, kHeadPan}, "head_pan is jammed", 0});
  command("head_pan", 0.3, "/other");
  EXPECT_EQ(reasonOf(replaced), "head_pan was commanded to go elsewhere");
}

TEST_F(MoverTest, ATrajectoryMayTakeLongerThanAHoldUp) {
  const auto followed = follow("head_pan", 1.0, 2.0);
  pass(milliseconds(1900), 0.9);
  EXPECT_EQ(followed.ended(), nullptr);
}

TEST_F(MoverTest, TrajectoriesDoNotGoOnAfterAHoldUp) {
  const auto followed = follow("head_pan", 1.0, 2.0);
  pass(milliseconds(200), 0.1);
  now_ += milliseconds(600);
  measure(0.1);
  told();
  mover_.goOn();
  EXPECT_EQ(endOf(followed), EndedHow::kRefused);
  EXPECT_EQ(reasonOf(followed), "the driver was held up");
  EXPECT_THAT(told(), IsEmpty());
  now_ += std::chrono::hours(1);
  measure(0.1);
  const auto later = follow("head_pan", 1.0, 2.0);
  mover_.goOn();
  EXPECT_EQ(later.ended(), nullptr);
  now_ += milliseconds(600);
  measure(0.1);
  EXPECT_EQ(follow("neck_tilt", -0.1, 1.0).ended(), nullptr);
  EXPECT_EQ(reasonOf(later), "the driver was held up") << "even if an order comes first";
}

TEST_F(MoverTest, ANodeThatCommandsTheSameJointsAgainGoesOnWithItsMovement) {
  const auto first = command("head_pan", 0.5);
  const auto second = command("head_pan", 0.4);
  EXPECT_EQ(first.id, second.id);
  const auto other = command("head_pan", 0.3, "/other");
  EXPECT_EQ(endOf(first), EndedHow::kReplaced);
  EXPECT_EQ(reasonOf(first), "head_pan was commanded to go elsewhere");
  EXPECT_EQ(other.ended(), nullptr);
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].source, "/other");
  EXPECT_THAT(ends_, SizeIs(1));
}

TEST_F(MoverTest, ALookIsAnotherMovementThanACommandOfTheSameNodeToTheSameJoint) {
  const auto commanded = command("head_pan", 0.5);
  mover_.command(order(), {"head_pan"}, {0.4}, {}, Kind::kLookAt);
  EXPECT_EQ(endOf(commanded), EndedHow::kReplaced);
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].kind, Kind::kLookAt);
}

TEST_F(MoverTest, ACommandEndsATrajectoryAndSaysSo) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  command("head_pan", 0.3);
  EXPECT_EQ(reasonOf(followed), "head_pan was commanded to go elsewhere");
  EXPECT_EQ(endOf(followed), EndedHow::kReplaced);
  told();
  mover_.goOn();
  EXPECT_THAT(told(), IsEmpty()) << "no step of the trajectory";
}

TEST_F(MoverTest, ReadsNoOrderThatNamesFarMoreJointsThanARobotHas) {
  std::vector<std::string> names(kMostNames, "head_pan");
  std::vector<double> positions(kMostNames, 0.1);
  EXPECT_EQ(mover_.command(order(), names, positions, {}).ended(), nullptr);
  names.emplace_back("head_pan");
  positions.push_back(0.1);
  const std::string refusal = "it names 1001, and at most 1000 names are allowed";
  EXPECT_EQ(reasonOf(mover_.command(order(), names, positions, {})), refusal);
  TrajectoryRequest request;
  request.joints = names;
  request.points = {{1.0, positions, {}}};
  EXPECT_EQ(reasonOf(mover_.follow(order(), request, std::chrono::seconds(0))), refusal);
}

TEST_F(MoverTest, TellsOfAllJointsThatWereLeftOutInOneLine) {
  mover_.command(order(), {"head_pan", "a", "b", "c", "d"}, {0.1, 0, 0, 0, 0}, {});
  EXPECT_THAT(warnings_, ElementsAre("The ERS-7 has no joint 'a'. The ERS-7 has no joint 'b'. The ERS-7 has no joint "
                                     "'c'. and 1 more"));
  EXPECT_EQ(reasonOf(follow("a\n\x1b[31mb", 0, 1)).find_first_of("\n\x1b"), std::string::npos);
  EXPECT_LE(reasonOf(follow(std::string(100000, 'a'), 0, 1)).size(), 1010u);
  const auto nothing = mover_.command(order(), {"a"}, {0.1}, {});
  EXPECT_EQ(reasonOf(nothing), "The ERS-7 has no joint 'a'");
  EXPECT_EQ(endOf(nothing), EndedHow::kRefused);
}

TEST_F(MoverTest, AJointThatIsLeftOutIsNoPartOfTheMovement) {
  walk();
  const auto incomplete = [this] {
    return mover_.command(order(), {"head_pan", "left_front_rotator"}, {0.1, NAN}, {});
  };
  const auto first = incomplete();
  EXPECT_THAT(mover_.state().movements.back().joints, ElementsAre("head_pan"));
  EXPECT_EQ(incomplete().id, first.id) << "it goes on with its movement";
  told();
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30")) << "the legs are the walk's";
}

TEST_F(MoverTest, NotesTheSameRefusalOfAStreamOnce) {
  client_.problem = "there is no robot";
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(reasonOf(command("head_pan", 0.1 * i)), "there is no robot");
    now_ += milliseconds(100);
  }
  EXPECT_THAT(ends_, SizeIs(1));
  now_ += milliseconds(500);
  command("head_pan", 0);
  EXPECT_THAT(ends_, SizeIs(2));
  command("head_pan", 0, "/other");
  command("head_tilt", 0);
  mover_.command(order(), {"head_pan"}, {0.0}, {}, Kind::kLookAt);
  mover_.command(order(), {"head_pan"}, {0.0}, {}, Kind::kLookAt);
  EXPECT_THAT(ends_, SizeIs(5)) << "another node, another joint, another kind";
  client_.problem = "another reason";
  command("head_pan", 0);
  EXPECT_THAT(ends_, SizeIs(6));
  play("NOD.MTN");
  play("NOD.MTN");
  EXPECT_THAT(ends_, SizeIs(8)) << "each call has its answer";
}

TEST_F(MoverTest, RemembersTheLatestEnds) {
  for (std::size_t i = 0; i < 2 * Mover::kEndsRemembered; ++i) {
    follow("third_leg", 0, 1.0);
    play("M" + std::to_string(i) + ".MTN");
    mover_.stopMotion(order("/panel"), "");
  }
  EXPECT_THAT(ends_, SizeIs(4 * Mover::kEndsRemembered));
  EXPECT_THAT(mover_.state().ended, SizeIs(Mover::kEndsRemembered));
}

TEST_F(MoverTest, AtMost32MotionsAndPosturesWaitForTheirEnds) {
  for (std::size_t i = 0; i < Mover::kMostOfAKind; ++i) {
    play("NOD.MTN");
    mover_.takePosture(order(), Posture::kStand);
  }
  EXPECT_THAT(ends_, IsEmpty());
  EXPECT_EQ(reasonOf(play("WAG.MTN")), "32 others of its kind have not ended yet, and no more may begin");
  EXPECT_EQ(endOf(mover_.takePosture(order(), Posture::kStand)), EndedHow::kRefused);
  mover_.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""});
  EXPECT_EQ(play("WAG.MTN").ended(), nullptr);
}

// ---- Stop and release

TEST_F(MoverTest, NothingMovesTheRobotBetweenStopAndRelease) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  told();
  mover_.stop(order("/panel"));
  EXPECT_THAT(told(), ElementsAre("hold"));
  EXPECT_EQ(endOf(followed), EndedHow::kStopped);
  EXPECT_EQ(reasonOf(followed), "/panel called stop");
  EXPECT_EQ(mover_.state().stopped_by, "/panel");
  for (const auto& begun : {command("head_pan", 0.5), follow("head_pan", 0.5, 1.0), mover_.play(order(), "NOD.MTN", 1),
                            mover_.takePosture(order(), Posture::kStand)}) {
    EXPECT_EQ(endOf(begun), EndedHow::kRefused);
    EXPECT_EQ(reasonOf(begun), "stopped by /panel; call release");
  }
  steer(0.1);
  EXPECT_EQ(ends_.back().reason, "stopped by /panel; call release");
  EXPECT_THAT(problem<aibo_client::CommandException>([this] { mover_.setMotors(order(), true); }),
              HasSubstr("call release"));
  mover_.goOn();
  EXPECT_THAT(told(), IsEmpty());
  mover_.setMotors(order(), false);
  mover_.takePosture(order(), Posture::kRest);
  EXPECT_THAT(told(), ElementsAre("motors off", "rest"));
  mover_.release(order());
  EXPECT_FALSE(mover_.state().stopped_by);
  command("head_pan", 0.5);
  EXPECT_THAT(told(), ElementsAre("J 2:0.50 in 0"));
  mover_.stop(order("/panel"));
  EXPECT_EQ(reasonOf(command("head_pan", 0.2)), "stopped by /panel; call release") << "a second time";
  mover_.stop(order("/gamepad"));
  mover_.disconnected();
  ++client_.connections;
  mover_.connected();
  EXPECT_EQ(mover_.state().stopped_by, "/gamepad") << "also over another connection";
}

TEST_F(MoverTest, WhatWaitedWhileStoppedDoesNotMoveTheRobotAfterTheRelease) {
  mover_.stop(order("/panel"));
  const Order waiting = order();
  now_ += milliseconds(100);
  mover_.release(order("/panel"));
  EXPECT_EQ(reasonOf(mover_.command(waiting, {"head_pan"}, {0.5}, {})), "it came before /panel called release");
  const Order earlier = order();
  now_ += milliseconds(100);
  mover_.setMotors(order("/panel"), true);
  EXPECT_EQ(reasonOf(mover_.command(earlier, {"head_pan"}, {0.5}, {})), "it came before /panel switched the motors on");
}

TEST_F(MoverTest, AStopEndsNothingBeforeTheRobotHolds) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  told();
  client_.meanwhile = [&] {
    EXPECT_EQ(followed.ended(), nullptr);
    EXPECT_EQ(reasonOf(command("mouth", -0.1)), "stopped by /panel; call release") << "from the beginning";
    now_ += milliseconds(100);
    EXPECT_TRUE(mover_.goOn());
    EXPECT_THAT(problem<aibo_client::CommandException>([this] { mover_.release(order()); }),
                HasSubstr("still being told"));
    mover_.stop(order("/other"));
    EXPECT_THAT(problem<aibo_client::CommandException>([this] { mover_.release(order()); }),
                HasSubstr("still being told"))
        << "the robot has answered the second stop only";
  };
  mover_.stop(order("/panel"));
  EXPECT_THAT(told(), ElementsAre("hold", "hold")) << "and no step of the trajectory";
  EXPECT_EQ(endOf(followed), EndedHow::kStopped);
}

TEST_F(MoverTest, AStopThatTheRobotDoesNotAnswerRefusesOrdersAllTheSame) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  client_.meanwhile = doNotAnswer;
  EXPECT_THAT(problem<TimeoutException>([this] { mover_.stop(order("/panel")); }), HasSubstr("no answer"));
  EXPECT_EQ(endOf(followed), EndedHow::kUnknown);
  EXPECT_EQ(reasonOf(command("head_pan", 0.5)), "stopped by /panel; call release");
  client_.problem = "there is no robot";
  EXPECT_EQ(problem<aibo_client::NetworkException>([this] { mover_.stop(order()); }), "there is no robot");
  client_.problem.clear();
  mover_.release(order());
  EXPECT_EQ(command("head_pan", 0.5).ended(), nullptr);
}

TEST_F(MoverTest, AMotionThatBeginsDuringAStopIsStopped) {
  client_.meanwhile = [this] { mover_.stop(order("/panel")); };
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  EXPECT_EQ(reasonOf(played), "/panel called stop");
  EXPECT_EQ(client_.told.back(), "stop NOD.MTN");
  mover_.release(order());
  client_.meanwhile = [this] { mover_.stop(order("/panel")); };
  EXPECT_EQ(endOf(mover_.takePosture(order(), Posture::kSit)), EndedHow::kStopped);
  EXPECT_EQ(client_.told.back(), "hold");
}

TEST_F(MoverTest, WhatCannotBeStoppedIsWarnedOf) {
  client_.meanwhile = [this] {
    mover_.stop(order("/panel"));
    client_.meanwhile = [this] { client_.problem = "there is no robot"; };
  };
  const auto played = play("NOD.MTN");
  EXPECT_THAT(warnings_, IsEmpty());
  client_.meanwhile = nullptr;
  mover_.release(order());
  client_.meanwhile = [this] {
    mover_.stop(order("/panel"));
    client_.problem = "there is no robot";
  };
  EXPECT_EQ(endOf(play("NOD.MTN")), EndedHow::kStopped);
  EXPECT_THAT(warnings_, ElementsAre("The motion NOD.MTN may go on: there is no robot"));
}

TEST_F(MoverTest, ARobotThatRefusesToHoldLeavesTheEndUnknown) {
  const auto commanded = command("head_pan", 0.5);
  client_.meanwhile = [] { throw aibo_client::CommandException("it is busy."); };
  EXPECT_THAT(problem<aibo_client::CommandException>([this] { mover_.setMotors(order("/panel"), false); }),
              HasSubstr("busy"));
  EXPECT_EQ(endOf(commanded), EndedHow::kUnknown);
  EXPECT_EQ(reasonOf(commanded), "/panel switched the motors off, but it is busy");
  const auto unheld = command("head_pan", 0.5);
  client_.problem = "there is no robot";
  EXPECT_EQ(problem<aibo_client::NetworkException>([this] { mover_.hold(order(), "/user said so"); }),
            "there is no robot");
  EXPECT_EQ(endOf(unheld), EndedHow::kLost);
  const auto lost = follow("head_pan", 0.5, 1.0);
  EXPECT_EQ(endOf(lost), EndedHow::kLost) << "its first step cannot be sent";
}

TEST_F(MoverTest, ARobotThatCanHoldButRefusesToIsNotSentPositions) {
  const auto commanded = command("head_pan", 0.5);
  told();
  client_.meanwhile = [] { throw aibo_client::CommandException("it is busy."); };
  EXPECT_EQ(problem<aibo_client::CommandException>([this] { mover_.stop(order("/panel")); }), "it is busy.");
  EXPECT_THAT(told(), ElementsAre("hold"));
  EXPECT_EQ(endOf(commanded), EndedHow::kUnknown);
  EXPECT_EQ(reasonOf(commanded), "/panel called stop, but it is busy");
}

TEST_F(MoverTest, TheRobotsReportsDuringAStopHaveItsReason) {
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  const auto done = mover_.play(order(), "WAG.MTN", 1);
  client_.meanwhile = [this] {
    mover_.ended({EndedKind::kMotion, EndedHow::kStopped, "NOD.MTN", "the client holds it"});
    mover_.ended({EndedKind::kMotion, EndedHow::kDone, "WAG.MTN", "it took longer"});
    mover_.refused({RefusedRequest::kJoints, RefusalCause::kStopped, {kHeadPan}, "a stop came before it was sent", 0});
  };
  const auto commanded = command("head_pan", 0.4);
  mover_.stop(order("/panel"));
  EXPECT_EQ(reasonOf(played), "/panel called stop");
  EXPECT_EQ(reasonOf(commanded), "/panel called stop");
  EXPECT_EQ(endOf(done), EndedHow::kDone);
  EXPECT_EQ(reasonOf(done), "it took longer") << "the stop did not end it";
  mover_.release(order("/panel"));
  const auto later = play("NOD.MTN");
  mover_.ended({EndedKind::kMotion, EndedHow::kStopped, "NOD.MTN", "another client stopped it"});
  EXPECT_EQ(reasonOf(later), "another client stopped it");
}

TEST_F(MoverTest, HoldsWithoutStopping) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  mover_.hold(order(), "/user sent an empty trajectory");
  EXPECT_EQ(reasonOf(followed), "/user sent an empty trajectory");
  told();
  command("head_pan", 0.5);
  EXPECT_THAT(told(), SizeIs(1));
}

TEST_F(MoverTest, HoldsATrajectoryOfAVersion1ServerWhereItWasSent) {
  useVersion1();
  follow("head_pan", 1.0, 1.0);
  told();
  measure(-0.3);  // it lags behind
  mover_.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.10 in 0"));
  mover_.release(order());
  measure(0);
  const auto pan = follow("head_pan", 1.0, 1.0);
  follow("neck_tilt", -0.5, 1.0);
  told();
  mover_.cancel(pan.id, "the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre("J 2:0.10 in 0")) << "the neck goes on";
}

TEST_F(MoverTest, HoldsACommandOfAVersion1ServerOnItsWay) {
  useVersion1();
  measure(0.5);
  command("head_pan", -1.0);
  told();
  mover_.stop(order());
  EXPECT_THAT(told(), ElementsAre("J 2:0.50 in 0")) << "not at its target, and at its speed";
}

TEST_F(MoverTest, StopsMotionsOfAVersion1ServerIfOneWasPlayed) {
  useVersion1();
  mover_.stop(order());
  EXPECT_THAT(told(), IsEmpty());
  mover_.release(order());
  mover_.play(order(), "NOD.MTN", 1);
  told();
  for (int i = 0; i < 2; ++i) {
    mover_.stop(order());
    EXPECT_THAT(told(), ElementsAre("stop ")) << "the first may not have got through";
  }
  ++client_.connections;
  mover_.stop(order());
  EXPECT_THAT(told(), IsEmpty()) << "the robot has stopped it when the connection ended";
  mover_.release(order());
  mover_.connected();
  now_ += kOnItsWay;
  mover_.play(order(), "NOD.MTN", 1);
  told();
  mover_.stop(order());
  EXPECT_THAT(told(), ElementsAre("stop ")) << "one was played over this connection, too";
}

TEST_F(MoverTest, CancelsOneTrajectoryOnly) {
  const auto pan = follow("head_pan", 1.0, 1.0);
  const auto neck = follow("neck_tilt", -0.35, 0.15);
  const auto later = mover_.follow(order(), {{"head_pan"}, {{1.0, {0.0}, {}}}}, std::chrono::seconds(5));
  told();
  mover_.cancel(later.id, "the goal was cancelled");
  EXPECT_EQ(reasonOf(later), "the goal was cancelled");
  EXPECT_THAT(told(), IsEmpty()) << "it has not begun";
  now_ += milliseconds(100);
  mover_.goOn();
  EXPECT_THAT(told(), ElementsAre("J 2:0.20 in 96", "J 1:-0.35 in 50")) << "both go on";
  mover_.cancel(pan.id, "the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre("hold 2"));
  EXPECT_EQ(reasonOf(pan), "the goal was cancelled");
  EXPECT_EQ(neck.ended(), nullptr);
  mover_.cancel(pan.id, "the goal was cancelled");
  EXPECT_THAT(told(), IsEmpty()) << "it is over";
}

// ---- Age

TEST_F(MoverTest, OldOrdersDoNotMoveTheRobot) {
  command("head_tilt", 0);
  told();
  const Order old = order();
  now_ += milliseconds(600);
  measure(0);
  const TrajectoryRequest way{{"head_pan"}, {{1.0, {0.5}, {}}}};
  for (const auto& begun : {mover_.command(old, {"head_pan"}, {0.5}, {}), mover_.follow(old, way, milliseconds(0)),
                            mover_.play(old, "NOD.MTN", 1), mover_.takePosture(old, Posture::kSit)}) {
    EXPECT_EQ(endOf(begun), EndedHow::kRefused);
    EXPECT_THAT(reasonOf(begun), StartsWith("too old"));
  }
  mover_.steer(old, kAhead);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverTest, WhatCameBeforeAPostureOrAStopOrTheMotorsDoesNotAct) {
  command("head_tilt", 0);
  const Order old = order();
  now_ += milliseconds(10);
  mover_.takePosture(order("/panel"), Posture::kRest);
  EXPECT_EQ(reasonOf(mover_.command(old, {"head_pan"}, {0.5}, {})), "it came before /panel called rest");
  EXPECT_EQ(command("head_pan", 0.1).ended(), nullptr) << "what comes later does";
  const Order before_off = order();
  now_ += milliseconds(10);
  mover_.setMotors(order("/panel"), false);
  EXPECT_EQ(reasonOf(mover_.command(before_off, {"head_pan"}, {0.5}, {})),
            "it came before /panel switched the motors off");
  now_ += milliseconds(10);
  mover_.setMotors(order("/panel"), true);
  EXPECT_EQ(mover_.takePosture(order(), Posture::kStand).ended(), nullptr) << "at once";
}

TEST_F(MoverTest, WhatCameAfterACallThatHadToWaitActs) {
  command("head_tilt", 0);
  const std::function<void(const Order&)> calls[] = {
      [this](const Order& order) { mover_.takePosture(order, Posture::kSit); },
      [this](const Order& order) { mover_.setMotors(order, false); },
      [this](const Order& order) { mover_.setMotors(order, true); },
      [this](const Order& order) { mover_.hold(order, "/user sent an empty trajectory"); },
      [this](const Order& order) { mover_.release(order); }};
  for (const auto& call : calls) {
    now_ += milliseconds(10);
    const Order earlier = order();
    now_ += milliseconds(10);
    const Order later = order();
    now_ += milliseconds(10);
    call(earlier);
    EXPECT_EQ(mover_.command(later, {"head_pan"}, {0.5}, {}).ended(), nullptr);
  }
}

TEST_F(MoverTest, WhatCameBeforeTheConnectionDoesNotAct) {
  const Order old = order();
  now_ += milliseconds(10);
  ++client_.connections;
  mover_.connected();
  EXPECT_EQ(reasonOf(mover_.command(old, {"head_pan"}, {0.5}, {})), "it came before the robot was connected");
}

// Nobody has told the mover of the connection yet.
TEST_F(MoverTest, EveryOrderNoticesANewConnection) {
  const TrajectoryRequest way{{"head_pan"}, {{1.0, {0.5}, {}}}};
  const std::function<void(const Order&)> orders[] = {
      [this](const Order& order) { mover_.command(order, {"head_pan"}, {0.5}, {}); },
      [&](const Order& order) { mover_.follow(order, way, milliseconds(0)); },
      [this](const Order& order) { mover_.play(order, "NOD.MTN", 1); },
      [this](const Order& order) { mover_.takePosture(order, Posture::kRest); },
      [this](const Order& order) { mover_.steer(order, kAhead); },
      [this](const Order& order) { mover_.walkToGoal(order, "1 m ahead"); }};
  for (const auto& give : orders) {
    command("head_tilt", 0.1);
    const Order old = order();
    now_ += milliseconds(10);
    ++client_.connections;
    told();
    give(old);
    EXPECT_EQ(ends_.back().reason, "it came before the robot was connected");
    EXPECT_EQ(ends_.at(ends_.size() - 2).how, EndedHow::kLost);
    EXPECT_THAT(told(), IsEmpty());
    now_ += milliseconds(500);
    measure(0);
  }
}

TEST_F(MoverTest, AnOrderThatStillWaitsInTheClientGetsTooOldThereAndHasTheNumberOfItsMovement) {
  command("head_tilt", 0);
  const Order earlier = order();
  const auto expect_terms = [&](std::uint64_t number, SteadyTime since) {
    EXPECT_EQ(client_.terms.number, number);
    EXPECT_EQ(client_.terms.not_after - since, milliseconds(500));
  };
  now_ += milliseconds(200);
  measure(0);
  expect_terms(mover_.command(earlier, {"head_pan"}, {0.5}, {}).id, earlier.received);
  expect_terms(mover_.command(order(), {"head_pan"}, {0.4}, {}).id, order().received);
  expect_terms(mover_.play(earlier, "NOD.MTN", 1).id, earlier.received);
  expect_terms(mover_.takePosture(earlier, Posture::kStand).id, earlier.received);
  const TrajectoryRequest way{{"head_pan"}, {{1.0, {0.5}, {}}}};
  expect_terms(mover_.follow(order(), way, milliseconds(0)).id, now_);
  now_ += milliseconds(32);
  mover_.steer({"/teleop", now_ - milliseconds(20)}, kAhead);
  EXPECT_EQ(client_.terms.not_after - now_, milliseconds(480));
  mover_.steered(kAhead, client_.terms.number);
  ASSERT_EQ(mover_.state().movements.back().kind, Kind::kWalk);
  steer(0);
  EXPECT_EQ(client_.terms.not_after - now_, milliseconds(500));
  const auto walk = mover_.walkToGoal(order(), "1 m ahead");
  now_ += milliseconds(100);
  mover_.walkOn(walk.id, kAhead);
  expect_terms(walk.id, now_);
}

// ---- The robot's own movements

TEST_F(MoverTest, PlaysAMotionAtTheRobotsOwnSpeedsAndEndsTrajectories) {
  command("head_pan", 0.1);
  const auto tilted = command("head_tilt", 0.1);
  const auto followed = follow("head_pan", 1.0, 1.0);
  client_.told.clear();
  mover_.play(order(), "NOD.MTN", 2);
  EXPECT_EQ(client_.told.back(), "play NOD.MTN 2");
  client_.told.pop_back();
  EXPECT_THAT(client_.told, SizeIs(table_.size()));
  EXPECT_THAT(client_.told, Each(StartsWith("V ")));
  EXPECT_THAT(client_.told, Contains("V 2:4.50"));
  EXPECT_EQ(reasonOf(followed), "/user plays NOD.MTN");
  EXPECT_EQ(tilted.ended(), nullptr) << "the robot says so if the motion moves its joint";
}

TEST_F(MoverTest, ACommandAfterAMotionKeepsItsOwnSpeedLimit) {
  mover_.play(order(), "NOD.MTN", 1);
  mover_.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""});
  command("head_pan", 0.1);
  ASSERT_GE(client_.told.size(), 2u);
  const std::string limit = client_.told[client_.told.size() - 2];
  EXPECT_THAT(limit, StartsWith("V 2:"));
  EXPECT_LE(std::stod(limit.substr(4)), 3.0);
  EXPECT_THAT(client_.told.back(), StartsWith("J 2:")) << "the limit goes first";
}

TEST_F(MoverTest, AMotionPlaysUntilTheRobotReportsItsEnd) {
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].name, "NOD.MTN");
  mover_.ended({EndedKind::kMotion, EndedHow::kDone, "WAG.MTN", ""});
  mover_.ended({EndedKind::kJam, EndedHow::kDone, "NOD.MTN", ""});
  EXPECT_EQ(played.ended(), nullptr);
  mover_.ended({EndedKind::kMotion, EndedHow::kReplaced, "NOD.MTN", "head_tilt was commanded"});
  EXPECT_EQ(endOf(played), EndedHow::kReplaced);
  EXPECT_EQ(reasonOf(played), "head_tilt was commanded");
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(MoverTest, AMotionMayEndBeforeTheCallReturns) {
  client_.meanwhile = [this] { mover_.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""}); };
  EXPECT_EQ(endOf(mover_.play(order(), "NOD.MTN", 1)), EndedHow::kDone);
}

TEST_F(MoverTest, AMotionThatMayOrMayNotPlayStaysUntilTheRobotSays) {
  const auto commanded = command("head_tilt", 0.1);
  client_.meanwhile = doNotAnswer;
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  EXPECT_TRUE(played.is_uncertain);
  EXPECT_EQ(played.remark, "no answer within 2000 ms");
  EXPECT_THAT(mover_.state().movements, SizeIs(2));
  mover_.answeredLate({played.id, true, "", ""});
  EXPECT_EQ(played.ended(), nullptr) << "it plays";
  mover_.ended({EndedKind::kMotion, EndedHow::kDone, "NOD.MTN", ""});
  EXPECT_EQ(endOf(played), EndedHow::kDone);
  client_.meanwhile = doNotAnswer;
  const auto refused = mover_.play(order(), "NOD.MTN", 1);
  mover_.answeredLate({refused.id, false, "There is no such motion.", ""});
  EXPECT_EQ(endOf(refused), EndedHow::kRefused);
  EXPECT_EQ(reasonOf(refused), "There is no such motion");
  EXPECT_EQ(commanded.ended(), nullptr);
}

TEST_F(MoverTest, AMotionThatWasNotSentIsRefusedAndOneThatWasSentIsLostWithTheConnection) {
  client_.meanwhile = [] { throw TimeoutException("no answer within 2000 ms."); };
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  EXPECT_EQ(endOf(played), EndedHow::kRefused);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  for (const bool was_sent : {false, true}) {
    client_.meanwhile = [was_sent] {
      throw aibo_client::NetworkException("it broke.", aibo_client::FaultKind::kNone, was_sent);
    };
    EXPECT_EQ(endOf(play("NOD.MTN")), was_sent ? EndedHow::kLost : EndedHow::kRefused);
  }
}

TEST_F(MoverTest, StopsAMotionAlone) {
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  const auto other = mover_.play(order(), "WAG.MTN", 1);
  mover_.stopMotion(order("/panel"), "NOD.MTN");
  EXPECT_EQ(client_.told.back(), "stop NOD.MTN");
  EXPECT_EQ(reasonOf(played), "/panel stopped it");
  client_.problem = "there is no robot";
  problem<aibo_client::NetworkException>([this] { mover_.stopMotion(order("/panel"), "WAG.MTN"); });
  client_.problem.clear();
  EXPECT_EQ(other.ended(), nullptr);
  const auto commanded = command("head_pan", 0.5);
  const auto again = play("NOD.MTN");
  mover_.stopMotion(order("/panel"), "");
  EXPECT_EQ(reasonOf(other), "/panel stopped it");
  EXPECT_EQ(reasonOf(again), "/panel stopped it");
  EXPECT_EQ(commanded.ended(), nullptr);
}

TEST_F(MoverTest, DoesNotKnowHowLongAMotionOfAnOlderServerPlays) {
  useVersion1();
  EXPECT_EQ(endOf(mover_.play(order(), "NOD.MTN", 1)), EndedHow::kUnknown);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  client_.meanwhile = doNotAnswer;
  const auto late = play("NOD.MTN");
  EXPECT_EQ(late.ended(), nullptr);
  mover_.answeredLate({late.id, true, "", ""});
  EXPECT_EQ(endOf(late), EndedHow::kUnknown);
}

TEST_F(MoverTest, APostureTakesTheLegsAndLeavesTheHead) {
  const auto leg = command("left_front_rotator", 0.5);
  const auto last = command("right_hind_knee", 0.5);
  const auto both = mover_.command(order(), {"head_pan", "left_front_knee"}, {0.5, 0.5}, {});
  mover_.takePosture(order("/panel"), Posture::kSit);
  EXPECT_EQ(reasonOf(leg), "/panel called sit");
  EXPECT_EQ(reasonOf(last), "/panel called sit");
  EXPECT_EQ(both.ended(), nullptr);
  EXPECT_THAT(mover_.jointsOf(both.id), ElementsAre("head_pan"));
  EXPECT_THAT(mover_.state().movements.at(0).joints, ElementsAre("head_pan"));
  mover_.stop(order());
  EXPECT_EQ(endOf(both), EndedHow::kStopped);
  EXPECT_THAT(both.ended()->movement.joints, ElementsAre("head_pan")) << "that it moved last";
  mover_.release(order());
  const auto way = follow("left_front_rotator", 0.5, 1.0);
  const auto head = follow("head_pan", 0.5, 1.0);
  const auto later =
      mover_.follow(order(), {{"neck_tilt", "left_front_rotator"}, {{1.0, {0.0, 0.0}, {}}}}, std::chrono::seconds(5));
  mover_.takePosture(order("/panel"), Posture::kStand);
  for (const auto& trajectory : {way, later}) {
    EXPECT_EQ(endOf(trajectory), EndedHow::kReplaced);
    EXPECT_EQ(reasonOf(trajectory), "/panel called stand");
  }
  told();
  mover_.goOn();
  EXPECT_THAT(told(), ElementsAre(StartsWith("J 2:"))) << "no step for a leg";
  EXPECT_EQ(head.ended(), nullptr);
}

TEST_F(MoverTest, EndsEverythingWithTheConnection) {
  const auto played = mover_.play(order(), "NOD.MTN", 1);
  const auto followed = follow("head_pan", 1.0, 1.0);
  mover_.robotChanged({MotorState::kOn, PostureNow::kStanding});
  mover_.disconnected();
  EXPECT_EQ(endOf(played), EndedHow::kLost);
  EXPECT_EQ(endOf(followed), EndedHow::kLost);
  EXPECT_EQ(mover_.state().robot, aibo_client::MotorsAndPosture());
  const auto next = follow("head_pan", 1.0, 1.0);
  ++client_.connections;
  told();
  EXPECT_FALSE(mover_.goOn());
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(endOf(next), EndedHow::kLost);
}

TEST_F(MoverTest, TheMotorsEndEverythingThatTheyMove) {
  const auto commanded = command("head_pan", 0.5);
  mover_.robotChanged({MotorState::kOff, PostureNow::kLying});
  EXPECT_EQ(commanded.ended(), nullptr) << "the first report; the robot itself refuses";
  mover_.robotChanged({MotorState::kOn, PostureNow::kLying});
  mover_.robotChanged({MotorState::kOn, PostureNow::kStanding});
  EXPECT_EQ(commanded.ended(), nullptr);
  client_.meanwhile = [this] { mover_.robotChanged({MotorState::kOff, PostureNow::kStanding}); };
  mover_.setMotors(order("/panel"), false);
  EXPECT_EQ(endOf(commanded), EndedHow::kStopped);
  EXPECT_EQ(reasonOf(commanded), "/panel switched the motors off");
  EXPECT_EQ(mover_.state().robot.motors, MotorState::kOff);
  mover_.setMotors(order(), true);
  const auto again = command("head_pan", 0.5);
  mover_.robotChanged({MotorState::kOff, PostureNow::kLying});
  EXPECT_EQ(reasonOf(again), "the motors are off") << "the battery, for instance";
  client_.motors_work = false;
  EXPECT_FALSE(mover_.setMotors(order(), true));
  EXPECT_EQ(mover_.state().robot.motors, MotorState::kOff) << "whatever was wanted";
}

TEST_F(MoverTest, ApproachesAgainAfterWhateverMayHaveMovedTheJointsOrKeptThemFromMoving) {
  const std::function<void()> causes[] = {
      [this] { mover_.setMotors(order(), true); },
      [this] {
        ++client_.connections;
        mover_.connected();
        now_ += kOnItsWay;
      },
      [this] {
        client_.problem = "there is no robot";
        command("head_pan", 0.1);
        client_.problem.clear();
      },
      [this] {
        mover_.refused({RefusedRequest::kJoints, RefusalCause::kRobot, {kHeadPan}, "the motors are off", 0});
      },
      [this] {
        mover_.robotChanged({MotorState::kOn, PostureNow::kLying});
        mover_.robotChanged({MotorState::kOff, PostureNow::kLying});
      },
      [this] {
        walk();
        mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
      },
      [this] {
        mover_.takePosture(order(), Posture::kRest);
        mover_.ended({EndedKind::kPosture, EndedHow::kDone, "rest", ""});
      }};
  for (const auto& cause : causes) {
    command("head_pan", 0.0);
    command("head_pan", 0.2);  // the joint is measured at 0: the approach is over
    EXPECT_THAT(client_.told, IsSupersetOf({"V 2:3.00", "J 2:0.20 in 0"}));
    cause();
    client_.told.clear();
    command("head_pan", 1.0);
    EXPECT_THAT(client_.told, ElementsAre("V 2:0.50", "J 2:1.00 in 0"));
    client_.told.clear();
    now_ += std::chrono::seconds(10);
    measure(0);
    mover_.setMotors(order(), true);
  }
}

TEST_F(MoverTest, GoesOnWithAnApproachThatWasStopped) {
  measure(0);
  command("head_pan", 1.0);
  mover_.stop(order());
  now_ += std::chrono::seconds(10);
  mover_.release(order());
  client_.told.clear();
  command("head_pan", 1.0);
  EXPECT_THAT(client_.told, ElementsAre("J 2:1.00 in 0")) << "as slowly as before";
  measure(0.95);
  mover_.stop(order());
  mover_.release(order());
  command("head_pan", 0.5);
  EXPECT_THAT(client_.told, Contains("V 2:3.00")) << "it had arrived before the stop";
}

// ---- Trajectories

TEST_F(MoverTest, SendsWhereTheJointsOfATrajectoryShouldBeSoon) {
  follow("head_pan", 1.0, 1.0);
  EXPECT_THAT(client_.told, ElementsAre("V 2:3.00", "J 2:0.10 in 96"));
  EXPECT_TRUE(mover_.goOn());
  told();
  follow("head_pan", 0.1, 0.05);
  EXPECT_THAT(told(), ElementsAre("J 2:0.10 in 50")) << "its end is not late";
}

TEST_F(MoverTest, SaysWhereATrajectoryWantsItsJointsAndWhenItEnds) {
  follow("neck_tilt", -0.3, 2.0);
  const auto followed = follow("head_pan", 1.0, 1.0);
  EXPECT_EQ(mover_.state().movements.at(1).end, now_ + std::chrono::seconds(1));
  EXPECT_EQ(mover_.state().movements.at(1).joints, std::vector<std::string>{"head_pan"});
  now_ += milliseconds(100);
  ASSERT_THAT(mover_.wantedBy(followed.id, now_), SizeIs(1));
  EXPECT_NEAR(mover_.wantedBy(followed.id, now_)[0].position, 0.1, 1e-9);
}

TEST_F(MoverTest, SaysByHowMuchATrajectoryIsSlowedDown) {
  Mover slow{table_, measured_, client_, 0.5, true, [] { return true; }, [this] { return now_; }};
  slow.connected();
  now_ += kOnItsWay;
  const TrajectoryRequest way{{"head_pan"}, {{0.1, {0.6}, {}}}};
  EXPECT_THAT(slow.follow(order(), way, milliseconds(0)).remark, StartsWith("slowed down 2.0"));
  EXPECT_EQ(follow("head_pan", 0.6, 1.0).remark, "");
}

TEST_F(MoverTest, RefusesTrajectoriesOfOldMeasurements) {
  now_ += milliseconds(500);
  EXPECT_THAT(reasonOf(follow("head_pan", 1.0, 1.0)), HasSubstr("head_pan was last measured 0.5 s ago"));
  useVersion1();
  EXPECT_EQ(follow("head_pan", 1.0, 1.0).ended(), nullptr) << "it reports one joint after the other";
  now_ += milliseconds(2000);
  EXPECT_THAT(reasonOf(follow("head_pan", 1.0, 1.0)), HasSubstr("head_pan was last measured 2.5 s ago"));
  EXPECT_THAT(reasonOf(follow("head_tilt", 0.1, 2.0)), HasSubstr("has not been measured"));
}

TEST_F(MoverTest, RefusesTrajectoriesAtOnceWithoutTelemetry) {
  telemetry_ = false;
  walk();
  EXPECT_THAT(reasonOf(follow("left_front_rotator", 1.0, 1.0)), HasSubstr("telemetry_rate is 0"));
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30")) << "a refused one does not end a walk";
}

TEST_F(MoverTest, RefusesTrajectoriesAndCommandsForARobotOfAnotherDesign) {
  const auto under_way = follow("head_pan", 1.0, 1.0);
  const auto leg = command("left_front_rotator", 0.1);
  client_.told.clear();
  client_.present.robot.design = "ERS-210";
  mover_.goOn();
  EXPECT_EQ(endOf(under_way), EndedHow::kRefused);
  EXPECT_THAT(reasonOf(under_way), HasSubstr("it is an ERS-210"));
  EXPECT_THAT(reasonOf(follow("head_pan", 1.0, 1.0)), HasSubstr("it is an ERS-210"));
  EXPECT_THAT(reasonOf(command("head_pan", 1.0)), HasSubstr("it is an ERS-210"));
  EXPECT_THAT(reasonOf(mover_.takePosture(order(), Posture::kSit)), HasSubstr("it is an ERS-210"));
  EXPECT_THAT(reasonOf(mover_.walkToGoal(order(), "1 m ahead")), HasSubstr("it is an ERS-210"));
  steer(0.1);
  EXPECT_THAT(ends_.back().reason, HasSubstr("it is an ERS-210"));
  EXPECT_THAT(client_.told, IsEmpty());
  EXPECT_EQ(leg.ended(), nullptr) << "nothing has replaced it";
}

// ---- Walking

TEST_F(MoverTest, AStreamOfVelocitiesThatWasStoppedMovesTheRobotOnlyAfterItsNodeHasLetGo) {
  walk();
  mover_.stop(order("/panel"));
  told();
  steerOn(0.1);
  EXPECT_EQ(ends_.back().reason, "stopped by /panel; call release");
  EXPECT_THAT(ends_, SizeIs(2));
  mover_.release(order("/panel"));
  steerOn(0.1);
  EXPECT_THAT(told(), IsEmpty()) << "nothing starts by itself";
  EXPECT_EQ(ends_.back().reason, "the robot was stopped; let go first: 0, or nothing for 0.5 s");
  EXPECT_THAT(ends_, SizeIs(3)) << "the walk was stopped, and the stream was refused for two reasons";
  steer(0);
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
}

TEST_F(MoverTest, AStreamThatBeginsWhileStoppedHasToLetGo) {
  mover_.stop(order("/panel"));
  told();
  steerOn(0.1);
  mover_.release(order("/panel"));
  steerOn(0.1);
  EXPECT_THAT(told(), IsEmpty());
  now_ += milliseconds(500);
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
}

TEST_F(MoverTest, AStreamThatWasStoppedForAMomentHasToLetGo) {
  walk();
  mover_.stop(order("/panel"));
  mover_.release(order("/panel"));
  told();
  steerOn(0.1);
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(ends_.back().reason, "/panel called stop; let go first: 0, or nothing for 0.5 s");
}

TEST_F(MoverTest, AStreamThatGoesOnOverAReconnectHasToLetGo) {
  walk();
  mover_.disconnected();
  client_.problem = "there is no robot";
  steerOn(0.1);
  client_.problem.clear();
  ++client_.connections;
  mover_.connected();
  steerOn(0.1);
  EXPECT_THAT(told(), IsEmpty()) << "nothing starts by itself";
  EXPECT_EQ(ends_.back().reason, "the connection is a new one; let go first: 0, or nothing for 0.5 s");
  steer(0);
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
}

TEST_F(MoverTest, AReleaseWithoutAStopLeavesAWalkAlone) {
  walk();
  mover_.release(order("/panel"));
  steer(0.1);
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
}

TEST_F(MoverTest, PosturesFallsMotorsAndLegsOverruleAStream) {
  const std::vector<std::pair<const char*, std::function<void()>>> overrules{
      {"/user called sit", [this] { mover_.takePosture(order(), Posture::kSit); }},
      {"/user switched the motors off", [this] { mover_.setMotors(order(), false); }},
      {"/user moves right_hind_knee", [this] { command("right_hind_knee", 0.1); }},
      {"/user moves left_hind_elevator",
       [this] {
         mover_.command(order(), {"head_pan", "left_hind_elevator"}, {0.1, 0.1}, {});
       }},
      {"/user moves left_front_rotator", [this] { follow("left_front_rotator", 0.1, 1.0); }},
      {"it was carried off",
       [this] {
         mover_.ended({EndedKind::kWalk, EndedHow::kFell, "walk", "it was carried off"});
       }},
      {"the floor ends ahead",
       [this] {
         mover_.ended({EndedKind::kWalk, EndedHow::kRefused, "walk", "the floor ends ahead"});
       }},
      {"left_front_knee was commanded",
       [this] {
         mover_.ended({EndedKind::kWalk, EndedHow::kReplaced, "walk", "left_front_knee was commanded"});
       }},
      {"the robot was lifted",
       [this] {
         mover_.robotChanged({MotorState::kOn, PostureNow::kCarried});
       }},
      {"the robot has fallen",
       [this] {
         mover_.robotChanged({MotorState::kOn, PostureNow::kFallen});
       }},
      {"the motors are off",
       [this] {
         mover_.robotChanged({MotorState::kOff, PostureNow::kStanding});
       }},
      {"the robot is hot", [this] {
         mover_.refused({RefusedRequest::kWalk,
                         RefusalCause::kRobot,
                         {},
                         "the robot is hot; let go first: send zero velocities",
                         0});
       }}};
  for (const auto& [reason, overrule] : overrules) {
    walk();
    overrule();
    measure(0);
    told();
    steerOn(0.1);
    EXPECT_THAT(told(), IsEmpty()) << reason;
    EXPECT_EQ(ends_.back().reason, std::string(reason) + "; let go first: 0, or nothing for 0.5 s");
    mover_.ended({EndedKind::kWalk, EndedHow::kStopped, "walk", ""});
    now_ += milliseconds(500);
    measure(0);
  }
}

TEST_F(MoverTest, AVelocityThatCameTooLateDoesNotOverruleTheNext) {
  walk();
  mover_.refused({RefusedRequest::kWalk, RefusalCause::kTooOld, {}, "too old", client_.steering_order});
  EXPECT_THAT(ends_, IsEmpty()) << "the robot walks on";
  steerOn(0.1);
  EXPECT_THAT(told(), SizeIs(10));
  mover_.ended({EndedKind::kWalk, EndedHow::kStopped, "walk", "it was not steered for 500 ms"});
  steerOn(0.1);
  EXPECT_THAT(told(), SizeIs(10)) << "nor does an orderly end";
}

TEST_F(MoverTest, AWalkThatCannotBeSentIsRefusedOnceAndGoesOnAfterwards) {
  client_.problem = "there is no robot";
  steerOn(0.1);
  EXPECT_THAT(ends_, SizeIs(1));
  EXPECT_EQ(ends_.back().reason, "there is no robot");
  client_.problem.clear();
  now_ += std::chrono::seconds(1);
  walk();
  client_.problem = "there is no robot";
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  steer(0.1);
  EXPECT_THAT(mover_.state().movements, SizeIs(1)) << "the connection says how it ends";
  EXPECT_THAT(ends_, SizeIs(1));
  client_.problem.clear();
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
}

TEST_F(MoverTest, AWalkBeginsWhenItIsAskedForAndEndsAsTheRobotSays) {
  steer(0.1);
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].kind, Kind::kWalk);
  EXPECT_EQ(mover_.state().movements[0].source, "/teleop");
  mover_.steered(kAhead, client_.steering_order);
  steer(0);
  mover_.steered({}, client_.steering_order);
  EXPECT_THAT(mover_.state().movements, SizeIs(1)) << "the robot brakes";
  mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  EXPECT_EQ(ends_.back().how, EndedHow::kDone);
}

TEST_F(MoverTest, ANodeThatSteersAgainAfterAPauseGoesOnWithItsWalk) {
  walk();
  now_ += std::chrono::seconds(1);
  steer(0.1);
  EXPECT_THAT(ends_, IsEmpty());
  EXPECT_THAT(mover_.state().movements, SizeIs(1));
}

TEST_F(MoverTest, AWalkThatTheRobotRefusesHasNotBegun) {
  steer(0.1);
  mover_.refused({RefusedRequest::kWalk, RefusalCause::kRobot, {}, "the motors are off", 0});
  EXPECT_EQ(ends_.back().how, EndedHow::kRefused);
  EXPECT_EQ(ends_.back().reason, "the motors are off");
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(MoverTest, AWalkThatIsLetGoBeforeItBeginsEndsToo) {
  steer(0.1);
  steer(0);
  mover_.steered({}, client_.steering_order);
  EXPECT_EQ(ends_.back().how, EndedHow::kStopped);
  EXPECT_THAT(mover_.state().movements, IsEmpty());
  steer(0.1);
  steer(0);
  mover_.steered(kAhead, client_.steering_order);
  mover_.steered({}, client_.steering_order);
  EXPECT_THAT(mover_.state().movements, SizeIs(1)) << "this one has begun, and the robot says when it ends";
}

TEST_F(MoverTest, AWalkThatWasStoppedHasThatReasonThoughItsNodeSteersOnBeforeTheRobotSaysSo) {
  walk();
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  steer(0.1);
  mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(ends_.back().how, EndedHow::kStopped);
  EXPECT_EQ(ends_.back().reason, "no cmd_vel came for 0.5 s");
  walk();
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  steer(0.1);
  steer(0);
  mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(ends_.back().how, EndedHow::kDone) << "its node has let go since";
}

TEST_F(MoverTest, AWalkWhoseNodeHasLetGoIsDoneThoughNothingComesAfterwards) {
  walk();
  steer(0);
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(ends_.back().how, EndedHow::kDone);
}

TEST_F(MoverTest, TwoNodesThatSteerAgainstEachOtherAreBothNamed) {
  for (const double other : {0.0, -0.1}) {
    now_ += std::chrono::seconds(1);
    warnings_.clear();
    for (int i = 0; i < 40; ++i) {
      now_ += milliseconds(50);
      steer(0.1, "/walker");
      now_ += milliseconds(50);
      steer(other, "/panel");
    }
    ASSERT_THAT(mover_.state().movements, SizeIs(1)) << other;
    EXPECT_EQ(mover_.state().movements[0].source, "/walker, /panel") << other;
    EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("/walker"), HasSubstr("/panel"), HasSubstr("contradict"))));
    mover_.steered(kAhead, client_.steering_order);
    mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
    EXPECT_EQ(ends_.back().movement.source, "/walker, /panel") << other;
    if (other == 0) {
      EXPECT_EQ(ends_.back().how, EndedHow::kStopped);
      EXPECT_EQ(ends_.back().reason, "/panel sent a velocity of 0");
    }
  }
}

TEST_F(MoverTest, ANodeThatStopsAWalkOrTakesItOverContradictsNobody) {
  walk();
  steer(0, "/panel");
  mover_.ended({EndedKind::kWalk, EndedHow::kDone, "walk", ""});
  EXPECT_EQ(ends_.back().reason, "/panel sent a velocity of 0");
  EXPECT_EQ(ends_.back().movement.source, "/teleop");
  now_ += milliseconds(500);
  walk();
  steer(0.1, "/navigation");
  steer(0.1, "/navigation");
  EXPECT_EQ(mover_.state().movements.at(0).source, "/teleop");
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MoverTest, AWalkThatFallsWhileItIsBeingStoppedHasFallen) {
  walk();
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  mover_.ended({EndedKind::kWalk, EndedHow::kFell, "walk", "the robot lies on its side"});
  EXPECT_EQ(ends_.back().how, EndedHow::kFell);
}

// On a slow link, what the robot says of the walk before comes late.
TEST_F(MoverTest, TheEndOfAnOlderWalkIsNotThatOfTheNextOne) {
  steer(0.1);
  const std::uint64_t older = client_.steering_order;
  mover_.refused({RefusedRequest::kWalk, RefusalCause::kReplaced, {}, "the legs were commanded", older});
  EXPECT_EQ(ends_.back().how, EndedHow::kReplaced);
  now_ += milliseconds(500);
  steer(0.1);
  mover_.steered(kAhead, older);
  mover_.ended({EndedKind::kWalk, EndedHow::kReplaced, "walk", "left_front_knee was commanded"});
  mover_.refused({RefusedRequest::kWalk, RefusalCause::kTooOld, {}, "too old", older});
  EXPECT_THAT(mover_.state().movements, SizeIs(1)) << "the robot has not said anything of this one yet";
  told();
  steerOn(0.1);
  EXPECT_THAT(told(), IsEmpty()) << "what ended the older one counts";
  mover_.steered(kAhead, client_.steering_order);
  mover_.ended({EndedKind::kWalk, EndedHow::kStopped, "walk", "it was not steered for 500 ms"});
  EXPECT_THAT(mover_.state().movements, IsEmpty());
}

TEST_F(MoverTest, AWalkThatATrajectoryOfTheHeadWasCancelledInIsStillStopped) {
  const auto followed = follow("head_pan", 1.0, 1.0);
  walk();
  mover_.cancel(followed.id, "the goal was cancelled");
  told();
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
}

class MoverGoalTest : public MoverTest {
 protected:
  Mover::Begun walkToGoal(const std::string& source = "/user") { return mover_.walkToGoal(order(source), "1 m ahead"); }

  // The robot walks to the goal.
  Mover::Begun walksToGoal() {
    Mover::Begun begun = walkToGoal();
    EXPECT_TRUE(mover_.walkOn(begun.id, kAhead));
    mover_.steered(kAhead, client_.steering_order);
    told();
    return begun;
  }

  void robotEnds(EndedHow how, const std::string& reason) { mover_.ended({EndedKind::kWalk, how, "walk", reason}); }
};

TEST_F(MoverGoalTest, AWalkToAGoalIsDoneWhenTheRobotStandsThere) {
  const Mover::Begun begun = walkToGoal();
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00")) << "it lets go of an earlier walk";
  ASSERT_THAT(mover_.state().movements, SizeIs(1));
  EXPECT_EQ(mover_.state().movements[0].name, "1 m ahead");
  EXPECT_TRUE(mover_.walkOn(begun.id, kAhead));
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
  mover_.steered(kAhead, client_.steering_order);
  EXPECT_TRUE(mover_.walkOn(begun.id, {}));
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
  EXPECT_EQ(begun.ended(), nullptr) << "the robot has not said so";
  robotEnds(EndedHow::kDone, "");
  ASSERT_NE(begun.ended(), nullptr);
  EXPECT_EQ(begun.ended()->how, EndedHow::kDone);
  EXPECT_FALSE(mover_.walkOn(begun.id, kAhead));
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverGoalTest, WhoIsThereAlreadyDoesNotWalk) {
  walksToGoal();
  robotEnds(EndedHow::kFell, "the robot lies on its side");
  const Mover::Begun begun = walkToGoal();
  told();
  EXPECT_FALSE(mover_.walkOn(begun.id, {}));
  EXPECT_EQ(endOf(begun), EndedHow::kDone);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverGoalTest, WhateverEndsTheWalkEndsItWithTheSameReasonAndTheNextGoalWalksAsTheFirst) {
  const std::vector<std::pair<EndedHow, std::string>> ends = {{EndedHow::kRefused, "the floor ends ahead"},
                                                              {EndedHow::kFell, "the robot lies on its side"},
                                                              {EndedHow::kReplaced, "left_front_knee was commanded"},
                                                              {EndedHow::kStopped, "the motors were switched off"}};
  for (const auto& [how, reason] : ends) {
    const Mover::Begun begun = walksToGoal();
    robotEnds(how, reason);
    ASSERT_NE(begun.ended(), nullptr) << reason;
    EXPECT_EQ(begun.ended()->how, how);
    EXPECT_EQ(begun.ended()->reason, reason);
    EXPECT_EQ(ends_.back().reason, reason);
    EXPECT_FALSE(mover_.walkOn(begun.id, kAhead)) << "it does not go on";
    EXPECT_THAT(told(), IsEmpty());
  }
}

TEST_F(MoverGoalTest, AVelocityReplacesTheGoalWhoeverSendsIt) {
  for (const char* source : {"/user", "/teleop"}) {
    const Mover::Begun begun = walksToGoal();
    steer(0.05, source);
    EXPECT_THAT(told(), ElementsAre("steer 0.05 -0.02 0.15")) << source;
    EXPECT_EQ(endOf(begun), EndedHow::kReplaced) << source;
    EXPECT_FALSE(mover_.walkOn(begun.id, kAhead)) << source;
    EXPECT_THAT(told(), IsEmpty()) << source;
  }
}

TEST_F(MoverGoalTest, ANewGoalReplacesTheOldOneAndTheRobotWalksOn) {
  const Mover::Begun first = walksToGoal();
  const Mover::Begun second = walkToGoal("/other");
  EXPECT_THAT(told(), IsEmpty()) << "it does not stop in between";
  EXPECT_EQ(first.ended()->how, EndedHow::kReplaced);
  EXPECT_THAT(first.ended()->reason, HasSubstr("/other sends the robot to a goal"));
  EXPECT_FALSE(mover_.walkOn(first.id, kAhead));
  EXPECT_TRUE(mover_.walkOn(second.id, velocity(0.05)));
  robotEnds(EndedHow::kFell, "the robot lies on its side");
  EXPECT_EQ(second.ended()->how, EndedHow::kFell);
}

TEST_F(MoverGoalTest, ANewGoalWhileTheRobotIsStoppingWalksToIt) {
  const Mover::Begun first = walksToGoal();
  mover_.cancel(first.id, "the goal was cancelled");
  const Mover::Begun second = walkToGoal();
  told();
  robotEnds(EndedHow::kDone, "");
  EXPECT_EQ(second.ended(), nullptr) << "it was the end of the first walk";
  EXPECT_TRUE(mover_.walkOn(second.id, kAhead));
  EXPECT_THAT(told(), ElementsAre("steer 0.10 -0.04 0.30"));
  mover_.steered(kAhead, client_.steering_order);
  EXPECT_TRUE(mover_.walkOn(second.id, {}));
  robotEnds(EndedHow::kDone, "");
  EXPECT_EQ(second.ended()->how, EndedHow::kDone);
}

TEST_F(MoverGoalTest, CancellingStopsTheRobotAndTheReasonStays) {
  const Mover::Begun begun = walksToGoal();
  mover_.cancel(begun.id, "the goal was cancelled");
  EXPECT_TRUE(mover_.walkOn(begun.id, kAhead)) << "the robot has not said that it stands";
  EXPECT_TRUE(mover_.walkOn(begun.id, {}));
  mover_.steered({}, client_.steering_order);
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00")) << "it does not go on";
  EXPECT_EQ(begun.ended(), nullptr);
  robotEnds(EndedHow::kDone, "");
  EXPECT_EQ(begun.ended()->how, EndedHow::kStopped);
  EXPECT_EQ(begun.ended()->reason, "the goal was cancelled");
  const Mover::Begun unbegun = walkToGoal();
  mover_.cancel(unbegun.id, "the goal was cancelled");
  EXPECT_EQ(unbegun.ended()->reason, "the goal was cancelled");
}

TEST_F(MoverGoalTest, StopEndsItAndRefusesTheNext) {
  const Mover::Begun begun = walksToGoal();
  mover_.stop(order("/panel"));
  EXPECT_EQ(begun.ended()->how, EndedHow::kStopped);
  EXPECT_THAT(begun.ended()->reason, HasSubstr("/panel called stop"));
  told();
  const Mover::Begun next = walkToGoal();
  EXPECT_THAT(next.ended()->reason, HasSubstr("stopped by /panel; call release"));
  EXPECT_FALSE(mover_.walkOn(next.id, kAhead));
  EXPECT_THAT(told(), IsEmpty());
  mover_.release(order());
  EXPECT_FALSE(mover_.walkOn(begun.id, kAhead)) << "nothing goes on by itself";
  now_ += milliseconds(1);
  EXPECT_EQ(walkToGoal().ended(), nullptr);
}

TEST_F(MoverGoalTest, ItDoesNotGoOnWhileTheRobotIsToldToStop) {
  const Mover::Begun begun = walksToGoal();
  client_.meanwhile = [&] { EXPECT_TRUE(mover_.walkOn(begun.id, kAhead)); };
  mover_.stop(order("/panel"));
  EXPECT_THAT(told(), ElementsAre("hold"));
}

TEST_F(MoverGoalTest, AfterAHaltThatFailedTrajectoriesAndGoalsMoveOnAsBefore) {
  const std::function<void()> halts[] = {
      [this] { mover_.setMotors(order(), false); }, [this] { mover_.stop(order()); },
      [this] { mover_.cancel(follow("head_pan", 0.5, 1.0).id, "it was cancelled"); }};
  const std::function<void()> failures[] = {doNotAnswer, [] { throw aibo_client::CommandException("it is busy."); },
                                            [] { throw aibo_client::NetworkException("there is no robot."); }};
  for (const auto& halt : halts) {
    for (const auto& failure : failures) {
      client_.meanwhile = failure;
      problem<aibo_client::Exception>(halt);
      EXPECT_EQ(problem<aibo_client::CommandException>([this] { mover_.release(order()); }), "none");
      now_ += milliseconds(100);
      measure(0);
      follow("head_pan", 0.5, 1.0);
      const Mover::Begun begun = walkToGoal();
      told();
      mover_.goOn();
      mover_.walkOn(begun.id, kAhead);
      EXPECT_THAT(told(), ElementsAre(StartsWith("J 2:"), "steer 0.10 -0.04 0.30"));
    }
  }
}

TEST_F(MoverGoalTest, AnotherConnectionDoesNotResumeIt) {
  const Mover::Begun begun = walksToGoal();
  mover_.disconnected();
  EXPECT_EQ(begun.ended()->how, EndedHow::kLost);
  mover_.connected();
  EXPECT_FALSE(mover_.walkOn(begun.id, kAhead));
  EXPECT_THAT(told(), IsEmpty());
  now_ += milliseconds(1);
  const Mover::Begun again = walksToGoal();
  ++client_.connections;  // nobody has told the mover yet
  EXPECT_FALSE(mover_.walkOn(again.id, kAhead));
  EXPECT_EQ(endOf(again), EndedHow::kLost);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverGoalTest, AnOldGoalIsRefused) {
  mover_.connected();
  now_ += milliseconds(1);
  const Order old = order();
  now_ += milliseconds(501);
  EXPECT_THAT(mover_.walkToGoal(old, "1 m ahead").ended()->reason, HasSubstr("too old"));
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(MoverGoalTest, ADriverThatWasHeldUpDoesNotWalkOn) {
  const Mover::Begun begun = walksToGoal();
  now_ += milliseconds(501);
  EXPECT_FALSE(mover_.walkOn(begun.id, kAhead));
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00"));
  EXPECT_THAT(begun.ended()->reason, HasSubstr("held up"));
  const Mover::Begun next = walkToGoal();
  for (int i = 0; i < 10; ++i) {
    now_ += milliseconds(100);
    EXPECT_TRUE(mover_.walkOn(next.id, kAhead)) << "the robot may need a second before it walks";
  }
  now_ += milliseconds(501);
  EXPECT_FALSE(mover_.walkOn(next.id, kAhead)) << "the robot has not walked yet";
}

TEST_F(MoverGoalTest, WhoSteeredBeforeHasToLetGoFirstAndThenTakesTheWalkOver) {
  walk();
  const Mover::Begun begun = walksToGoal();
  steer(0.05);
  EXPECT_THAT(ends_.back().reason, HasSubstr("let go first"));
  EXPECT_EQ(begun.ended(), nullptr);
  mover_.stopWalking("no cmd_vel came for 0.5 s");
  EXPECT_EQ(begun.ended(), nullptr);
  EXPECT_THAT(told(), IsEmpty());
  now_ += milliseconds(500);
  steer(0.05);
  EXPECT_EQ(begun.ended()->how, EndedHow::kReplaced);
  EXPECT_THAT(begun.ended()->reason, HasSubstr("/teleop steers now"));
}

TEST_F(MoverGoalTest, AVelocityOf0StopsIt) {
  const Mover::Begun begun = walksToGoal();
  steer(0);
  EXPECT_TRUE(mover_.walkOn(begun.id, kAhead));
  EXPECT_THAT(told(), ElementsAre("steer 0.00 0.00 0.00")) << "it does not go on";
  robotEnds(EndedHow::kDone, "");
  EXPECT_EQ(begun.ended()->how, EndedHow::kStopped);
  EXPECT_THAT(begun.ended()->reason, HasSubstr("/teleop sent a velocity of 0"));
}

TEST_F(MoverGoalTest, AVelocityThatCannotBeSentEndsIt) {
  const Mover::Begun begun = walksToGoal();
  client_.problem = "there is no robot";
  EXPECT_FALSE(mover_.walkOn(begun.id, kAhead));
  EXPECT_EQ(begun.ended()->how, EndedHow::kLost);
  EXPECT_EQ(begun.ended()->reason, "there is no robot");
  EXPECT_EQ(walkToGoal().ended()->reason, "there is no robot") << "nor does another begin";
}

TEST_F(MoverGoalTest, ARefusalOfTheRobotEndsIt) {
  const Mover::Begun begun = walkToGoal();
  mover_.walkOn(begun.id, kAhead);
  mover_.refused(
      {RefusedRequest::kWalk, RefusalCause::kRobot, {}, "the motors are off; switch them on first", begun.id});
  EXPECT_EQ(begun.ended()->how, EndedHow::kRefused);
  EXPECT_EQ(begun.ended()->reason, "the motors are off; switch them on first");
}

TEST_F(MoverGoalTest, ARefusalEndsItEvenIfItReplacesAWalkThatHasNotBegun) {
  steer(0.1);
  const Mover::Begun begun = walkToGoal();
  EXPECT_TRUE(mover_.walkOn(begun.id, kAhead));
  mover_.refused({RefusedRequest::kWalk, RefusalCause::kRobot, {}, "the motors are off", begun.id});
  EXPECT_EQ(endOf(begun), EndedHow::kRefused);
}

TEST_F(MoverTest, TheEndOfAnOlderPostureIsNotThatOfTheNextOne) {
  mover_.takePosture(order(), Posture::kSit);
  mover_.stop(order());
  mover_.release(order());
  const Mover::Begun begun = mover_.takePosture(order(), Posture::kStand);
  mover_.ended({EndedKind::kPosture, EndedHow::kStopped, "sit", "everything was told to hold"});
  EXPECT_EQ(begun.ended(), nullptr);
  mover_.ended({EndedKind::kPosture, EndedHow::kDone, "stand", ""});
  EXPECT_EQ(endOf(begun), EndedHow::kDone);
}

TEST_F(MoverTest, CancellingAPostureHoldsTheLegs) {
  const Mover::Begun begun = mover_.takePosture(order(), Posture::kSit);
  told();
  mover_.cancel(begun.id, "the goal was cancelled");
  ASSERT_NE(begun.ended(), nullptr);
  EXPECT_EQ(begun.ended()->how, EndedHow::kStopped);
  EXPECT_EQ(begun.ended()->reason, "the goal was cancelled");
  EXPECT_THAT(told(), ElementsAre(StartsWith("hold 11")));
}

TEST_F(MoverTest, AWalkThatIsSlowerThanTheRobotSaysEndsAsOthersDo) {
  steer(0.0004);
  mover_.steered({}, client_.steering_order);
  EXPECT_THAT(ends_, IsEmpty());
  mover_.ended({EndedKind::kWalk, EndedHow::kStopped, "walk", "it was not steered for 500 ms"});
  EXPECT_THAT(ends_, SizeIs(1));
}

TEST_F(MoverTest, AnotherNodeThatSteersOnHasAWalkOfItsOwn) {
  walk();
  steer(0.1, "/navigation");
  EXPECT_THAT(ends_, IsEmpty()) << "both steer: it is one walk";
  EXPECT_EQ(mover_.state().movements.at(0).source, "/teleop");
  now_ += milliseconds(600);
  steer(0.1, "/navigation");
  EXPECT_EQ(ends_.back().reason, "/navigation steers now");
  EXPECT_EQ(mover_.state().movements[0].source, "/navigation");
}

}  // namespace
}  // namespace aibo_driver::movement
