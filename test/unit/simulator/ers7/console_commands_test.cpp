// Commands typed at the simulated robot's console.
#include "simulator/ers7/console_commands.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "effector_command.h"
#include "robot_model/robot_model.h"

namespace simulated_ers7 {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// It has stepped aside and turned by more than half a turn. Its joints differ from each other, and one of them jams.
/// Its lights differ, too, and an ear is too hot.
class ConsoleCommandsTest : public testing::Test {
 protected:
  ConsoleCommandsTest() {
    robot_.setMotorPower(opowerON);
    robot_.jam("mouth", true);
    for (int stroke = 0; stroke < 25; ++stroke) {
      robot_.lift(true);
      pass(8);
      pass(40, moved(0));
      robot_.lift(false);
      pass(50);
      for (int step = 1; step <= 25; ++step) {
        pass(1, moved(step / 25.0));
      }
    }
    pass(1, {effectorCommand(open("PRM:/r1/c1/c2/c3/e5-Joint4:15"), odataJOINT_COMMAND4,
                             OJointCommandValue4{ojoint4_STATE1, 1, 0})});
    testing::internal::CaptureStdout();
    pass(125);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("left_ear was energised for 1000 ms"));
    pass(20, {effectorCommand(open("PRM:/r1/c1/c2/c3/la-LED3:la"), odataLED_COMMAND3,
                              OLEDCommandValue3{100, oled3_MODE_B, 1, 0}),
              effectorCommand(open("PRM:/r1/c1/c2/c3/lb-LED3:lb"), odataLED_COMMAND3,
                              OLEDCommandValue3{201, oled3_MODE_A, 1, 0})});
  }

  /// Commands for a share of the way in kMoved.
  openr_host::EffectorCommands moved(double share) {
    openr_host::EffectorCommands commands;
    for (const auto& [joint, microradians] : kMoved) {
      const OPrimitiveID id = open(model_.joints[robot_model::findJointByName(model_, joint)].locator);
      robot_.enableJointGain(id);
      robot_.setDefaultJointGain(id);
      const auto way = static_cast<slongword>(share * microradians);
      commands.push_back(
          effectorCommand(id, odataJOINT_COMMAND2, OJointCommandValue2{restingPosition(joint) + way, 0}));
    }
    return commands;
  }

  OPrimitiveID open(const char* locator) {
    OPrimitiveID id = oprimitiveID_UNDEF;
    EXPECT_EQ(robot_.openPrimitive(locator, &id), oSUCCESS) << locator;
    return id;
  }

  void pass(int frames, const openr_host::EffectorCommands& commands = {}) {
    for (int i = 0; i < frames; ++i) {
      robot_.passFrame(frame_++, commands);
    }
  }

  std::string say(const std::string& line) { return obeyConsole(robot_, line).value_or("no command"); }

  int chin() { return valueOf("PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"); }

  /// What all four paws report, two seconds later.
  bool allPawsAre(bool down) {
    pass(250);
    const auto paws = {"PRM:/r2/c1/c2/c3/c4-Sensor:24", "PRM:/r3/c1/c2/c3/c4-Sensor:34",
                       "PRM:/r4/c1/c2/c3/c4-Sensor:44", "PRM:/r5/c1/c2/c3/c4-Sensor:54"};
    return std::all_of(paws.begin(), paws.end(), [&](const char* paw) { return valueOf(paw) == down; });
  }

  int valueOf(const char* locator) {
    pass(1);
    OSensorValue value = {};
    robot_.getSensorValue(open(locator), &value);
    return value.value;
  }

  /// From rest, in microradians.
  const std::map<const char*, int> kMoved = {{"left_front_rotator", -200000},
                                             {"left_hind_rotator", -180000},
                                             {"right_front_rotator", 150000},
                                             {"right_hind_rotator", 90000},
                                             {"left_front_knee", 40000},
                                             {"neck_tilt", -70000},
                                             {"mouth", -300000}};
  const robot_model::RobotModel& model_ = *robot_model::findRobotModel("ERS-7");
  SimulatedErs7 robot_;
  longword frame_ = 7500;
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
  const auto told = [&](const char* begin) {
    char text[80];
    std::snprintf(text, sizeof(text), "ok: %s %.4f %.4f %.4f\n", begin, robot_.pose().x, robot_.pose().y,
                  robot_.pose().yaw + 2 * std::acos(-1.0));
    return std::string(text);
  };
  EXPECT_EQ(say("where"), told("where"));
  EXPECT_LT(robot_.pose().yaw, -3.2) << "it is told as an angle to the left";
}

TEST_F(ConsoleCommandsTest, TheBatteryIsSetInPercent) {
  EXPECT_EQ(say("battery 11.7"), "ok: battery 11.7\n");
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
  const OPrimitiveID pan = open("PRM:/r1/c1/c2-Joint2:12");
  robot_.enableJointGain(pan);
  robot_.setJointGain(pan, 8, 2, 4, 0x0E, 0x02, 0x0F);
  const openr_host::EffectorCommands commands = {
      effectorCommand(pan, odataJOINT_COMMAND2, OJointCommandValue2{100000, 0})};
  EXPECT_EQ(say("jam head_pan"), "ok: jam head_pan\n");
  pass(60, commands);
  EXPECT_EQ(robot_.joints().named("head_pan").position(), 0);
  EXPECT_EQ(say("free head_pan"), "ok: free head_pan\n");
  pass(60, commands);
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
  EXPECT_EQ(say("joint neck_tilt"), "ok: joint neck_tilt -29.01\n");
  EXPECT_EQ(say("joint left_front_rotator"), "ok: joint left_front_rotator -34.46\n");
  EXPECT_EQ(say("joint right_front_knee"), "ok: joint right_front_knee 44.00\n");
  EXPECT_EQ(say("joint left_front_knee"), "ok: joint left_front_knee 46.29\n");
  EXPECT_EQ(say("joint mouth"), "ok: joint mouth -4.00\n") << "not where it is to go";
  EXPECT_THAT(say("joint nose"), StartsWith("error: "));
  EXPECT_EQ(say("light face_1"), "ok: light face_1 100\n");
  EXPECT_EQ(say("light face_2"), "ok: light face_2 201\n");
  EXPECT_THAT(say("light nose"), StartsWith("error: "));
  pass(1, {effectorCommand(open("PRM:/r1/c1/c2/c3/e6-Joint4:16"), odataJOINT_COMMAND4,
                           OJointCommandValue4{ojoint4_STATE1, 1, 0})});
  EXPECT_EQ(say("ear left_ear"), "ok: ear left_ear let go\n");
  EXPECT_EQ(say("ear right_ear"), "ok: ear right_ear drawn\n");
}

}  // namespace
}  // namespace simulated_ers7
