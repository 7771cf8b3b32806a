#include "client/command_outbox.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

TEST(JointCommandsTest, WhatRemainsOfACommandThatHasBegunMayWaitAgain) {
  JointCommands commands;
  commands.add({milliseconds(0), {{1, 0.1}, {2, 0.2}}, {at(1000), 7}});
  commands.add({milliseconds(0), {{3, 0.3}}, {at(1000), 8}});
  EXPECT_EQ(7u, commands.takeTargetAfter(0, at(999)).terms.number);
  EXPECT_TRUE(commands.takeTooOld(at(1000)).empty());
  EXPECT_EQ(8u, commands.takeTooOld(at(1001)).at(0).terms.number);
  EXPECT_TRUE(commands.takeTooOld(at(1499)).empty());
  EXPECT_TRUE(commands.has(7));
  EXPECT_EQ(0u, commands.takeTooOld(at(1500)).at(0).terms.number) << "the order has begun";
  EXPECT_FALSE(commands.has(7));
}

/// The orders that were dropped: request, cause, order, joints, reason.
std::string takeDropped(CommandOutbox* outbox) {
  std::string text;
  for (const Refusal& refusal : std::exchange(outbox->dropped, {})) {
    text += refusal.request == RefusedRequest::kWalk ? "S" : "J";
    text += std::to_string(static_cast<int>(refusal.cause)) + "#" + std::to_string(refusal.order);
    for (const int id : refusal.ids) {
      text += " " + std::to_string(id);
    }
    text += " " + refusal.reason + ";";
  }
  return text;
}

constexpr int kTooOld = static_cast<int>(RefusalCause::kTooOld);
constexpr int kStopped = static_cast<int>(RefusalCause::kStopped);
constexpr int kReplaced = static_cast<int>(RefusalCause::kReplaced);
constexpr int kLegJoint = 11;
constexpr WalkVelocity kForward = {0.1, 0, 0};

TEST(CommandOutboxTest, EachOrderIsDroppedWhenItsOwnTimeHasPassed) {
  CommandOutbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}}, {at(1000), 1}});
  outbox.command({milliseconds(100), {{2, 0.3}}, {at(2000), 2}});
  outbox.command({milliseconds(100), {{3, 0.1}}, {at(2000), 5}});
  outbox.steer({{}, {at(0), 4}});
  outbox.steer({kForward, {at(1500), 3}});
  outbox.dropTooOld(at(1000), "old");
  EXPECT_EQ("", takeDropped(&outbox));
  outbox.dropTooOld(at(1001), "old");
  const std::string too_old = std::to_string(kTooOld);
  EXPECT_EQ("J" + too_old + "#1 1 old;", takeDropped(&outbox));
  outbox.dropTooOld(at(2000), "old");
  EXPECT_EQ("S" + too_old + "#3 old;", takeDropped(&outbox));
  EXPECT_TRUE(outbox.let_go) << "a velocity of 0 is never too old";
}

TEST(CommandOutboxTest, CommandsToSomeJointsOrToAllCanBeStopped) {
  CommandOutbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}, {9, 0.4}}, {at(1000), 1}});
  outbox.command({milliseconds(200), {{3, 0.3}}, {at(1000), 2}});
  outbox.stopJoints({1, 3, 9}, "a stop");
  const std::string stopped = std::to_string(kStopped);
  EXPECT_EQ("J" + stopped + "#0 1 9 a stop;J" + stopped + "#2 3 a stop;", takeDropped(&outbox)) << "order 1 goes on";
  EXPECT_THAT(takeAll(outbox.joints), testing::ElementsAre("2:2 in 100"));
  outbox.stopJoints({}, "another");
  EXPECT_EQ("J" + stopped + "#1 2 another;", takeDropped(&outbox));
  EXPECT_TRUE(outbox.joints.empty());
}

TEST(CommandOutboxTest, AnOrderOfWhichNothingIsLeftIsReplaced) {
  CommandOutbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {2, 0.2}}, {at(1000), 1}});
  outbox.command({milliseconds(100), {{1, 0.3}}, {at(1000), 0}});
  EXPECT_EQ("", takeDropped(&outbox)) << "joint 2 is left";
  outbox.command({milliseconds(100), {{1, 0.4}, {2, 0.4}}, {at(1000), 2}});
  EXPECT_EQ("J" + std::to_string(kReplaced) + "#1 2 newer commands took all joints of this one before it was sent;",
            takeDropped(&outbox))
      << "the one without a number is replaced silently";
}

TEST(CommandOutboxTest, AVelocityOf0IsSentBeforeAVelocityThatCameAfterIt) {
  const std::string why = " another velocity came before this one was sent;";
  const std::string replaced = "S" + std::to_string(kReplaced) + "#";
  CommandOutbox outbox;
  outbox.steer({kForward, {at(1000), 1}});
  outbox.steer({{}, {at(1000), 2}});
  EXPECT_EQ(replaced + "1" + why, takeDropped(&outbox));
  EXPECT_FALSE(outbox.steering);
  outbox.steer({{}, {at(1000), 3}});
  EXPECT_EQ(replaced + "2" + why, takeDropped(&outbox));
  outbox.steer({kForward, {at(1000), 4}});
  outbox.steer({kForward, {at(1000), 0}});
  EXPECT_EQ(replaced + "4" + why, takeDropped(&outbox));
  outbox.steer({kForward, {at(1000), 5}});
  EXPECT_EQ("", takeDropped(&outbox));
  CommandOutbox all;
  all.append(outbox);
  EXPECT_EQ(3u, all.let_go->terms.number);
  EXPECT_EQ(5u, all.steering->terms.number);
  all.stopWalk(false, "a posture");
  const std::string stopped = "S" + std::to_string(kStopped) + "#";
  EXPECT_EQ(stopped + "5 a posture;", takeDropped(&all));
  EXPECT_TRUE(all.let_go);
  all.stopWalk(true, "a stop");
  EXPECT_EQ(stopped + "3 a stop;", takeDropped(&all));
  EXPECT_FALSE(all.let_go || all.steering);
}

TEST(CommandOutboxTest, OfAWalkAndACommandToTheLegsTheNewerOneCounts) {
  CommandOutbox outbox;
  outbox.command({milliseconds(100), {{1, 0.1}, {kLegJoint, 0.2}}, {at(1000), 1}});
  outbox.steer({kForward, {at(1000), 2}});
  EXPECT_EQ("J" + std::to_string(kReplaced) + "#0 11 a walk was commanded before this was sent;", takeDropped(&outbox))
      << "joint 1 goes on";
  EXPECT_THAT(takeAll(outbox.joints), testing::ElementsAre("1:1 in 100"));
  outbox.command({milliseconds(100), {{2, 0.1}}, {at(1000), 3}});
  EXPECT_TRUE(outbox.steering) << "the head is free";
  CommandOutbox newer;
  newer.command({milliseconds(100), {{1, 0.3}, {43, 0.3}}, {at(1000), 4}});  // the head and the last joint of the legs
  outbox.append(newer);
  EXPECT_EQ("S" + std::to_string(kReplaced) + "#2 a command to the legs came before this one was sent;J" +
                std::to_string(kReplaced) + "#1 1 newer commands took all joints of this one before it was sent;",
            takeDropped(&outbox));
  EXPECT_FALSE(outbox.steering);
  outbox.steer({{}, {at(1000), 5}});
  EXPECT_EQ("", takeDropped(&outbox)) << "not to walk leaves the legs as they are";
  outbox.command({milliseconds(100), {{kLegJoint, 0.3}}, {at(1000), 0}});
  EXPECT_TRUE(outbox.let_go) << "it is sent before the command";
}

}  // namespace
