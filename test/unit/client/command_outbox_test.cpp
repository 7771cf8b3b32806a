#include "client/command_outbox.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

using namespace aibo_driver;
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

TEST(JointCommandsTest, JointsCommandedTogetherStayTogetherAndInOrder) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}, {2, 0.2}}});
  commands.add({milliseconds(200), {{3, 0.3}}});
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("1:1 2:2 in 100", "3:3 in 200"));
}

TEST(JointCommandsTest, TheLatestTargetOfAJointWinsAndTakesTheOlderOnesPlace) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}, {2, 0.2}}});
  commands.add({milliseconds(200), {{3, 0.3}}});
  commands.add({milliseconds(300), {{2, 0.4}}});
  commands.add({milliseconds(400), {{3, 0.5}}});
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("2:4 in 300", "1:1 in 100", "3:5 in 400"));
}

TEST(JointCommandsTest, AMillionCommandsLeaveOneOfEachJoint) {
  JointCommands commands;
  for (int i = 0; i < 1000000; ++i) {
    commands.add({milliseconds(0), {{1 + i % 18, i * 1e-6}}});
  }
  EXPECT_EQ(18u, takeAll(commands).size());
}

TEST(JointCommandsTest, OneByOneEachJointHasItsTurnHoweverFastCommandsCome) {
  JointCommands commands;
  std::string taken;
  int last = 0;
  for (int i = 0; i < 6; ++i) {
    commands.add({milliseconds(0), {{1, 0.1 * i}, {2, 0.1 * i}, {3, 0.1 * i}}});
    const JointTarget target = commands.takeTargetAfter(last);
    last = target.id;
    taken += describe(target);
  }
  EXPECT_EQ("1:0 2:1 3:2 1:3 2:4 3:5 ", taken);
}

TEST(JointCommandsTest, NewerCommandsAreAppended) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}}});
  JointCommands newer;
  newer.add({milliseconds(200), {{1, 0.2}}});
  commands.append(newer, JointCommands::TimePoint());
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("1:2 in 200"));
}

TEST(JointCommandsTest, OldCommandsCanBeDroppedAndNewerOnesStay) {
  const auto at = [](int time) { return JointCommands::TimePoint(milliseconds(time)); };
  JointCommands old;
  old.add({milliseconds(100), {{1, 0.1}, {2, 0.2}}});
  JointCommands newer;
  newer.add({milliseconds(200), {{2, 0.3}}});
  JointCommands commands;
  commands.append(old, at(1000));
  commands.append(newer, at(2000));
  EXPECT_FALSE(commands.dropOlderThan(at(1000)));
  EXPECT_TRUE(commands.dropOlderThan(at(1500)));
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("2:3 in 200"));
}

TEST(JointCommandsTest, CommandsToSomeJointsOrToAllCanBeDropped) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}, {2, 0.2}}});
  commands.add({milliseconds(200), {{3, 0.3}}});
  commands.add({milliseconds(300), {{4, 0.4}}});
  commands.drop({1, 3, 9});
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("2:2 in 100", "4:4 in 300"));
  commands.drop({});
  EXPECT_TRUE(commands.empty());
}

std::string takeAll(LatestById<LedCommand> leds) {
  std::string taken;
  while (!leds.empty()) {
    const LedCommand led = leds.take(1).front();
    taken += std::to_string(led.id) + ":" + std::to_string(led.intensity) + " ";
  }
  return taken;
}

TEST(LatestByIdTest, TheLatestWinsAndTakesThePlaceOfTheOldest) {
  LatestById<LedCommand> leds;
  leds.add({{5, 10}, {6, 20}});
  leds.add({{7, 30}, {5, 40}});
  EXPECT_EQ("5:40 6:20 7:30 ", takeAll(leds));
}

TEST(LatestByIdTest, NoMoreAreTakenThanThereAre) {
  LatestById<LedCommand> leds;
  leds.add({{5, 10}, {6, 20}, {7, 30}});
  EXPECT_EQ(2u, leds.take(2).size());
  EXPECT_EQ(1u, leds.take(2).size());
  EXPECT_TRUE(leds.empty());
}

}  // namespace
