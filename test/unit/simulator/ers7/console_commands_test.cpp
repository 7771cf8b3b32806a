// Commands typed at the simulated robot's console: docs/simulated_robot.md, "Pressing its buttons". What they do to
// the robot is tested where it happens.
#include "simulator/ers7/console_commands.h"

#include <gmock/gmock.h>

#include "simulator/ers7/simulated_ers7.h"

namespace simulated_ers7 {
namespace {

class ConsoleCommands : public testing::Test {
 protected:
  std::string say(const std::string& line) { return obeyConsole(robot_, line).value_or("no command"); }

  OPowerStatus power() {
    OPowerStatus status;
    robot_.getPowerStatus(&status);
    return status;
  }
  OMemoryStickStatus stick() {
    OMemoryStickStatus status = omemorystickUNDEF;
    robot_.getMemoryStickStatus(&status);
    return status;
  }

  SimulatedErs7 robot_;
};

TEST_F(ConsoleCommands, AreEachAnsweredWithTheirWords) {
  for (const std::string line :
       {"press chin",  "release chin", "press pause",   "release pause", "battery 12",   "battery 0",
        "battery 100", "jam head_pan", "free head_pan", "lift on",       "lift off",     "lie left",
        "lie right",   "lie back",     "lie feet",      "stick full",    "stick locked", "stick out",
        "stick slow",  "stick ready",  "hear silence"}) {
    EXPECT_EQ(say(line), "ok: " + line + "\n");
  }
  EXPECT_EQ(say("  release   chin "), "ok: release chin\n");
  EXPECT_THAT(say("help"), testing::HasSubstr("battery PERCENT"));
}

TEST_F(ConsoleCommands, WithAWrongWordAreAnsweredWithTheRightOnes) {
  const std::pair<std::string, std::vector<std::string>> rows[] = {
      {"press nose", {"\"nose\"", "paw_left_front", "chin"}},
      {"press range_near", {"there is no \"range_near\" to press"}},
      {"jam nose", {"\"nose\""}},
      {"joint nose", {"\"nose\""}},
      {"light nose", {"\"nose\""}},
      {"ear nose", {"\"nose\""}},
      {"lift up", {"lift on or lift off"}},
      {"lie down", {"lie left, right, back or feet"}},
      {"stick gone", {"stick ready, full, locked, out or slow"}},
      {"battery 101", {"a number from 0 to 100"}},
      {"battery -1", {"a number from 0 to 100"}},
      {"battery nan", {"a number from 0 to 100"}},
      {"battery 5%", {"a number from 0 to 100"}},
      {"hear nothing.wav", {"nothing.wav", "cannot be read"}},
  };
  for (const auto& [line, parts] : rows) {
    EXPECT_THAT(say(line), testing::StartsWith("error: ")) << line;
    for (const std::string& part : parts) {
      EXPECT_THAT(say(line), testing::HasSubstr(part)) << line;
    }
  }
  EXPECT_EQ(power().remainingCapacity, 100);
}

TEST_F(ConsoleCommands, AreNotOtherLines) {
  for (const char* line : {"", "sit", "press", "press chin head_touch", "PRESS chin", "help me", "GET / HTTP/1.1"}) {
    EXPECT_EQ(say(line), "no command") << line;
  }
}

TEST_F(ConsoleCommands, PressThePauseButtonUntilItIsReleasedAndSetTheBattery) {
  say("press pause");
  EXPECT_NE(power().robotStatus & orsbPAUSE, 0U);
  say("release pause");
  EXPECT_EQ(power().robotStatus & orsbPAUSE, 0U);
  say("battery 11.7");
  EXPECT_EQ(power().remainingCapacity, 12);
}

TEST_F(ConsoleCommands, MakeTheMemoryStickFullLockedOutSlowOrReady) {
  say("stick full");
  EXPECT_EQ(*robot_.stick().room(), 0U);
  EXPECT_EQ(stick(), omemorystickWRITABLE);
  say("stick locked");
  EXPECT_GT(*robot_.stick().room(), 1000000U);
  EXPECT_EQ(stick(), omemorystickWRITE_PROTECTED);
  say("stick out");
  EXPECT_EQ(stick(), omemorystickNOT_EXIST);
  say("stick slow");
  EXPECT_EQ(robot_.stick().jobTime(), StickSlot::kSlowJob);
  say("stick ready");
  EXPECT_EQ(stick(), omemorystickWRITABLE);
  EXPECT_EQ(robot_.stick().jobTime().count(), 0);
}

}  // namespace
}  // namespace simulated_ers7
