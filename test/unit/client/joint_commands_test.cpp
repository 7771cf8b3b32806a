#include "client/joint_commands.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "aibo_driver/exceptions.h"

using namespace aibo_driver;
using std::chrono::milliseconds;
using testing::HasSubstr;

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
  while (commands.hasTargets()) {
    taken.push_back(describe(commands.takeCommand()));
  }
  return taken;
}

TEST(JointCommandsTest, JointsThatAreToldTogetherStayTogetherAndInOrder) {
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

TEST(JointCommandsTest, WhatCameLaterIsAppended) {
  JointCommands commands;
  commands.add({milliseconds(100), {{1, 0.1}}});
  commands.add({{1, 1.0}, {2, 2.0}});
  JointCommands newer;
  newer.add({milliseconds(200), {{1, 0.2}}});
  newer.add({{2, 3.0}, {3, 4.0}});
  commands.append(newer);
  EXPECT_THAT(takeAll(commands), testing::ElementsAre("1:2 in 200"));
  const std::vector<JointSpeedLimit> limits = commands.takeSpeedLimits(2);
  ASSERT_EQ(2u, limits.size());
  EXPECT_EQ(1, limits[0].id);
  EXPECT_EQ(3.0, limits[1].speed);
  EXPECT_EQ(3, commands.takeSpeedLimits(2).at(0).id);
  EXPECT_FALSE(commands.hasSpeedLimits());
}

std::string complaintAbout(const std::vector<JointTarget>& targets, milliseconds duration = milliseconds(0)) {
  try {
    checkJointTargets(targets, duration);
  } catch (const InvalidArgumentException& error) {
    return error.what();
  }
  return "";
}

TEST(JointCommandsTest, TargetsAreChecked) {
  EXPECT_EQ("", complaintAbout({{1, 0}, {255, -6.28}}, milliseconds(65535)));
  EXPECT_THAT(complaintAbout({}), HasSubstr("the number of joints is 0"));
  EXPECT_THAT(complaintAbout(std::vector<JointTarget>(33)), HasSubstr("the number of joints is 33"));
  EXPECT_THAT(complaintAbout({{0, 0}}), HasSubstr("a joint's id is 0")) << "0 would be all joints";
  EXPECT_THAT(complaintAbout({{256, 0}}), HasSubstr("a joint's id is 256"));
  EXPECT_THAT(complaintAbout({{3, 0}, {3, 1}}), HasSubstr("joint 3 is named twice"));
  EXPECT_THAT(complaintAbout({{3, std::nan("")}}), HasSubstr("joint 3: its position is"));
  EXPECT_THAT(complaintAbout({{3, -INFINITY}}), HasSubstr("joint 3: its position is"));
  EXPECT_THAT(complaintAbout({{3, 7}}), HasSubstr("joint 3: its position is 7.0"));
  EXPECT_THAT(complaintAbout({{3, 0}}, milliseconds(-1)), HasSubstr("duration is -1 ms"));
  EXPECT_THAT(complaintAbout({{3, 0}}, milliseconds(65536)), HasSubstr("duration is 65536 ms"));
}

TEST(JointCommandsTest, SpeedLimitsAreChecked) {
  EXPECT_NO_THROW(checkJointSpeedLimits({{1, 0.001}, {2, 100}}));
  EXPECT_THROW(checkJointSpeedLimits({{1, 0}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, -1}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, 101}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, std::nan("")}}), InvalidArgumentException);
  EXPECT_THROW(checkJointSpeedLimits({{1, 1}, {1, 2}}), InvalidArgumentException);
}

}  // namespace
