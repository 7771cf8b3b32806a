// Commands typed at the simulated robot's console.
#include "simulator/ers7/console_commands.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace simulated_ers7 {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ConsoleCommandsTest : public testing::Test {
 protected:
  std::string say(const std::string& line) { return obeyConsole(robot_, line).value_or("no command"); }

  int chin() { return valueOf("PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"); }

  /// What all four paws report, two seconds later.
  bool allPawsAre(bool down) {
    for (int frame = 0; frame < 250; ++frame) {
      robot_.passFrame(frame_++, {});
    }
    const auto paws = {"PRM:/r2/c1/c2/c3/c4-Sensor:24", "PRM:/r3/c1/c2/c3/c4-Sensor:34",
                       "PRM:/r4/c1/c2/c3/c4-Sensor:44", "PRM:/r5/c1/c2/c3/c4-Sensor:54"};
    return std::all_of(paws.begin(), paws.end(), [&](const char* paw) { return valueOf(paw) == down; });
  }

  int valueOf(const char* locator) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    robot_.openPrimitive(locator, &id);
    robot_.passFrame(frame_++, {});
    OSensorValue value = {};
    robot_.getSensorValue(id, &value);
    return value.value;
  }

  SimulatedErs7 robot_;
  longword frame_ = 0;
};

TEST_F(ConsoleCommandsTest, AButtonIsPressedUntilItIsReleased) {
  EXPECT_EQ(say("press chin"), "ok: press chin\n");
  EXPECT_EQ(chin(), 1);
  EXPECT_EQ(chin(), 1);
  EXPECT_EQ(say("  release   chin "), "ok: release chin\n");
  EXPECT_EQ(chin(), 0);
}

TEST_F(ConsoleCommandsTest, ThePauseButtonShowsInThePowerStatusUntilItIsReleased) {
  const auto is_paused = [&] {
    OPowerStatus status;
    robot_.getPowerStatus(&status);
    return (status.robotStatus & orsbPAUSE) != 0;
  };
  EXPECT_FALSE(is_paused());
  EXPECT_EQ(say("press pause"), "ok: press pause\n");
  EXPECT_TRUE(is_paused());
  EXPECT_EQ(say("release pause"), "ok: release pause\n");
  EXPECT_FALSE(is_paused());
}

TEST_F(ConsoleCommandsTest, LiftedOrOnItsSideTheRobotHasItsPawsUp) {
  EXPECT_TRUE(allPawsAre(true));
  EXPECT_EQ(say("lift on"), "ok: lift on\n");
  EXPECT_TRUE(allPawsAre(false));
  EXPECT_EQ(say("lift off"), "ok: lift off\n");
  EXPECT_TRUE(allPawsAre(true));
  for (const std::string side : {"left", "right", "back"}) {
    EXPECT_EQ(say("lie " + side), "ok: lie " + side + "\n");
    EXPECT_TRUE(allPawsAre(false)) << side;
    const int gravity = side == "left" ? -9806650 : side == "right" ? 9806650 : 0;
    EXPECT_NEAR(valueOf("PRM:/a2-Sensor:a2"), gravity, 100000) << side;
    EXPECT_NEAR(valueOf("PRM:/a3-Sensor:a3"), side == "back" ? 9806650 : 0, 100000) << side;
  }
  EXPECT_EQ(say("lie feet"), "ok: lie feet\n");
  EXPECT_TRUE(allPawsAre(true));
  EXPECT_THAT(say("lift up"), StartsWith("error: lift on or lift off"));
  EXPECT_THAT(say("lie down"), StartsWith("error: lie left, right, back or feet"));
}

TEST_F(ConsoleCommandsTest, TheMemoryStickIsFullLockedOutSlowOrReady) {
  const auto status = [this] {
    OMemoryStickStatus state = omemorystickUNDEF;
    robot_.getMemoryStickStatus(&state);
    return state;
  };
  const size_t* const room = robot_.stick().room();
  EXPECT_EQ(say("stick full"), "ok: stick full\n");
  EXPECT_EQ(*room, 0U);
  EXPECT_EQ(status(), omemorystickWRITABLE);
  EXPECT_EQ(say("stick locked"), "ok: stick locked\n");
  EXPECT_GT(*room, 1000000U);
  EXPECT_EQ(status(), omemorystickWRITE_PROTECTED);
  EXPECT_EQ(say("stick out"), "ok: stick out\n");
  EXPECT_EQ(status(), omemorystickNOT_EXIST);
  EXPECT_EQ(say("stick slow"), "ok: stick slow\n");
  EXPECT_EQ(robot_.stick().jobTime(), StickSlot::kSlowJob);
  EXPECT_EQ(say("stick ready"), "ok: stick ready\n");
  EXPECT_EQ(status(), omemorystickWRITABLE);
  EXPECT_EQ(robot_.stick().jobTime().count(), 0);
  EXPECT_THAT(say("stick gone"), StartsWith("error: stick ready, full, locked, out or slow"));
}

TEST_F(ConsoleCommandsTest, WhereTellsPlaceAndDirection) {
  EXPECT_EQ(say("where"), "ok: where 0.0000 0.0000 0.0000\n");
}

TEST_F(ConsoleCommandsTest, TheBatteryIsSetInPercent) {
  EXPECT_EQ(say("battery 12"), "ok: battery 12\n");
  OPowerStatus status;
  robot_.getPowerStatus(&status);
  EXPECT_EQ(status.remainingCapacity, 12);
  for (const char* wrong : {"battery 101", "battery -1", "battery nan", "battery full", "battery 5%"}) {
    EXPECT_THAT(say(wrong), StartsWith("error: battery PERCENT: a number from 0 to 100")) << wrong;
  }
  robot_.getPowerStatus(&status);
  EXPECT_EQ(status.remainingCapacity, 12);
  EXPECT_EQ(say("battery 0"), "ok: battery 0\n");
  EXPECT_EQ(say("battery 100"), "ok: battery 100\n");
}

TEST_F(ConsoleCommandsTest, AJointIsJammedUntilItIsFreed) {
  const char* locator = "PRM:/r1/c1/c2-Joint2:12";
  OPrimitiveID pan = oprimitiveID_UNDEF;
  robot_.openPrimitive(locator, &pan);
  robot_.setMotorPower(opowerON);
  robot_.enableJointGain(pan);
  robot_.setJointGain(pan, 8, 2, 4, 0x0E, 0x02, 0x0F);
  openr_host::EffectorCommand command = {pan, odataJOINT_COMMAND2, {{100000, 0}}};
  EXPECT_EQ(say("jam head_pan"), "ok: jam head_pan\n");
  for (int i = 0; i < 60; ++i) {
    robot_.passFrame(frame_++, {command});
  }
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 0);
  EXPECT_EQ(say("free head_pan"), "ok: free head_pan\n");
  for (int i = 0; i < 60; ++i) {
    robot_.passFrame(frame_++, {command});
  }
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 100000);
}

TEST_F(ConsoleCommandsTest, OtherLinesAreNoCommands) {
  EXPECT_THAT(say("press nose"), AllOf(StartsWith("error: "), HasSubstr("\"nose\""), HasSubstr("paw_left_front")));
  EXPECT_THAT(say("press range_near"), StartsWith("error: "));
  EXPECT_THAT(say("jam nose"), AllOf(StartsWith("error: "), HasSubstr("\"nose\"")));
  for (const char* wrong : {"", "sit", "press", "press chin head_touch", "PRESS chin", "help me"}) {
    EXPECT_EQ(say(wrong), "no command") << wrong;
  }
  EXPECT_THAT(say("help"), HasSubstr("battery PERCENT"));
}

TEST_F(ConsoleCommandsTest, TellsWhereJointsAreAndWhatLightsAndEarsDo) {
  EXPECT_EQ(say("joint neck_tilt"), "ok: joint neck_tilt -25.00\n");
  EXPECT_THAT(say("joint nose"), StartsWith("error: "));
  EXPECT_EQ(say("light face_1"), "ok: light face_1 0\n");
  EXPECT_THAT(say("light nose"), StartsWith("error: "));
  EXPECT_EQ(say("ear left_ear"), "ok: ear left_ear let go\n");
}

}  // namespace
}  // namespace simulated_ers7
