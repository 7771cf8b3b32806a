#include "client/command_outbox.h"

#include <gmock/gmock.h>

#include <cmath>

using namespace aibo_client;
using std::chrono::milliseconds;

namespace {

std::string describe(const JointTarget& target) {
  return std::to_string(target.id) + ":" + std::to_string(std::lround(target.position * 10)) + " ";
}

std::string describe(const JointCommand& command) {
  std::string text;
  for (const JointTarget& target : command.targets) {
    text += describe(target);
  }
  return text + "in " + std::to_string(command.duration.count());
}

/// All commands in the order in which they are taken.
std::vector<std::string> takeAll(JointCommands commands) {
  std::vector<std::string> taken;
  while (!commands.empty()) {
    taken.push_back(describe(commands.takeCommand()));
  }
  return taken;
}

TEST(JointCommandsTest, TheLatestTargetOfAJointWinsAndTakesTheOlderOnesPlace) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}, {2, 0.2}, {4, 0.1}}});
  commands.add({milliseconds(200), {{3, 0.3}}});
  commands.add({milliseconds(300), {{2, 0.4}}});
  commands.add({milliseconds(400), {{3, 0.5}}});
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("2:4 in 300", "1:1 4:1 in 100", "3:5 in 400"));
}

TEST(JointCommandsTest, OneByOneEachJointHasItsTurnHoweverFastCommandsCome) {
  JointCommands commands;
  std::string taken;
  int last = 0;
  for (int i = 0; i < 6; ++i) {
    commands.add({milliseconds(0), {{1, 0.1 * i}, {2, 0.1 * i}, {3, 0.1 * i}}});
    const JointTarget target = commands.takeTargetAfter(last, {}).targets.front();
    last = target.id;
    taken += describe(target);
  }
  EXPECT_EQ("1:0 2:1 3:2 1:3 2:4 3:5 ", taken);
}

JointCommands::TimePoint at(int time) {
  return JointCommands::TimePoint(milliseconds(time));
}

/// Keeps what it has dropped.
struct Outbox : public CommandOutbox {
  Outbox() : CommandOutbox([this](const Refusal& refusal) { dropped.push_back(refusal); }) {}

  std::vector<Refusal> dropped;
};

/// The orders that were dropped: request, cause, order, joints, reason.
std::string takeDropped(Outbox* outbox) {
  std::string text;
  for (const Refusal& refusal : std::exchange(outbox->dropped, {})) {
    text += refusal.request == RefusedRequest::kWalk ? "walk " : "joints ";
    text += refusal.cause == RefusalCause::kTooOld     ? "too old"
            : refusal.cause == RefusalCause::kReplaced ? "replaced"
            : refusal.cause == RefusalCause::kStopped  ? "stopped"
                                                       : "refused";
    text += " #" + std::to_string(refusal.order);
    for (const int id : refusal.ids) {
      text += " " + std::to_string(id);
    }
    text += " " + refusal.reason + ";";
  }
  return text;
}

constexpr int kLegJoint = 11;
constexpr WalkVelocity kForward = {0.1, 0, 0};

TEST(CommandOutboxTest, EachOrderIsDroppedWhenItsOwnTimeHasPassed) {
  Outbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}}, {at(1000), 1}});
  outbox.command({milliseconds(100), {{2, 0.3}}, {at(2000), 2}});
  outbox.steer({{}, {at(0), 4}});
  outbox.steer({kForward, {at(1500), 3}});
  outbox.dropTooOld(at(1000), "old");
  EXPECT_EQ("", takeDropped(&outbox));
  outbox.dropTooOld(at(1001), "old");
  EXPECT_EQ("joints too old #1 1 old;", takeDropped(&outbox));
  outbox.dropTooOld(at(2000), "old");
  EXPECT_EQ("walk too old #3 old;", takeDropped(&outbox));
  EXPECT_TRUE(outbox.let_go) << "a velocity of 0 is never too old";
}

TEST(CommandOutboxTest, CommandsToSomeJointsOrToAllCanBeStopped) {
  Outbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}, {9, 0.4}}, {at(1000), 1}});
  outbox.command({milliseconds(200), {{3, 0.3}}, {at(1000), 2}});
  outbox.stopJoints({1, 3, 9}, "a stop");
  EXPECT_EQ("joints stopped #0 1 9 a stop;joints stopped #2 3 a stop;", takeDropped(&outbox)) << "order 1 goes on";
  EXPECT_THAT(takeAll(outbox.joints), testing::ElementsAre("2:2 in 100"));
  outbox.stopJoints({}, "another");
  EXPECT_EQ("joints stopped #1 2 another;", takeDropped(&outbox));
  EXPECT_TRUE(outbox.joints.empty());
}

TEST(CommandOutboxTest, AnOrderOfWhichNothingIsLeftIsReplaced) {
  Outbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}}, {at(1000), 1}});
  outbox.command({milliseconds(100), {{1, 0.3}}, {at(1000), 0}});
  EXPECT_EQ("", takeDropped(&outbox)) << "joint 2 is left";
  outbox.command({milliseconds(100), {{1, 0.4}, {2, 0.4}}, {at(1000), 2}});
  EXPECT_EQ("joints replaced #1 2 newer commands took all joints of this one before it was sent;", takeDropped(&outbox))
      << "the one without a number is replaced silently";
}

TEST(CommandOutboxTest, OfVelocitiesTheNewestWaitsAndAVelocityOf0BeforeIt) {
  const std::string why = " another velocity came before this one was sent;";
  Outbox outbox;
  std::uint64_t number = 0;
  const std::pair<WalkVelocity, const char*> rows[] = {
      {kForward, ""}, {{}, "1"}, {{}, "2"}, {kForward, ""}, {kForward, "4"}};
  for (const auto& [velocity, replaced] : rows) {
    outbox.steer({velocity, {at(1000), ++number}});
    EXPECT_EQ(*replaced == 0 ? "" : std::string("walk replaced #") + replaced + why, takeDropped(&outbox));
  }
  EXPECT_EQ(3u, outbox.let_go->terms.number);
  EXPECT_EQ(5u, outbox.steering->terms.number);
  outbox.stopWalk(false, "a posture");
  EXPECT_EQ("walk stopped #5 a posture;", takeDropped(&outbox));
  outbox.stopWalk(true, "a stop");
  EXPECT_EQ("walk stopped #3 a stop;", takeDropped(&outbox));
  EXPECT_FALSE(outbox.let_go || outbox.steering);
  outbox.steer({kForward, {at(1000), 0}});
  outbox.steer({kForward, {at(1000), 0}});
  EXPECT_EQ("", takeDropped(&outbox)) << "one without a number is replaced silently";
}

TEST(CommandOutboxTest, OfAWalkAndACommandToTheLegsTheNewerOneCounts) {
  Outbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {kLegJoint, 0.2}}, {at(1000), 1}});
  outbox.steer({kForward, {at(1000), 2}});
  EXPECT_EQ("joints replaced #0 11 a walk was commanded before this was sent;", takeDropped(&outbox));
  EXPECT_THAT(takeAll(outbox.joints), testing::ElementsAre("1:1 in 100"));
  outbox.command({milliseconds(100), {{2, 0.1}}, {at(1000), 3}});
  EXPECT_TRUE(outbox.steering) << "the head is free";
  outbox.command({milliseconds(100), {{43, 0.3}}, {at(1000), 4}});  // the last joint of the legs
  EXPECT_EQ("walk replaced #2 a command to the legs came before this one was sent;", takeDropped(&outbox));
  EXPECT_FALSE(outbox.steering);
  outbox.steer({{}, {at(1000), 5}});
  EXPECT_EQ("", takeDropped(&outbox)) << "not to walk leaves the legs as they are";
  outbox.command({milliseconds(100), {{kLegJoint, 0.3}}, {at(1000), 0}});
  EXPECT_TRUE(outbox.let_go) << "it is sent before the command";
}

}  // namespace
