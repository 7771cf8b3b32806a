#include "tools/teleop/joy_steering.h"

#include <gmock/gmock.h>

namespace teleop {
namespace {

using ::testing::HasSubstr;

enum Axis { kLeft, kNothing, kTurn, kTilt, kNothingElse, kForward, kPan };
enum Button { kWag, kDeadMan, kPicture, kRelease, kNod, kStop, kStand, kRest };

// Nothing is where it usually is.
JoyMapping mapping() {
  return {kDeadMan,
          kForward,
          kTurn,
          kLeft,
          kPan,
          kTilt,
          kStop,
          kRelease,
          kPicture,
          {{"NOD", kNod}, {"WAG", kWag}},
          {{"rest", kRest}, {"stand", kStand}},
          {0.2, 0.07, 1.5},
          0.6,
          0.2};
}

std::string describe(const JoyOrders& orders) {
  std::ostringstream text;
  if (orders.walk) {
    text << "walk " << orders.walk->forward << " " << orders.walk->left << " " << orders.walk->turn << ",";
  }
  if (orders.head) {
    text << "head " << orders.head->pan << " " << orders.head->tilt << ",";
  }
  text << (orders.stop ? "stop," : "") << (orders.release ? "release," : "") << (orders.take_picture ? "picture," : "")
       << orders.motion << orders.posture;
  return text.str();
}

class JoySteeringTest : public ::testing::Test {
 protected:
  std::string steer(bool pressed, float forward, float left = 0, float turn = 0) {
    axes_[kForward] = forward;
    axes_[kLeft] = left;
    axes_[kTurn] = turn;
    return press({pressed ? kDeadMan : kRelease});
  }

  std::string press(const std::vector<int>& pressed) {
    std::vector<int> buttons(8, 0);
    for (const int button : pressed) {
      buttons.at(static_cast<std::size_t>(button)) = 1;
    }
    return describe(joy_.read(axes_, buttons));
  }

  // A hand trembles, and what has no meaning is deflected.
  std::vector<float> axes_ = {0.1F, 1, -0.05F, 0.15F, -1, -0.1F, -0.15F};
  JoySteering joy_{mapping()};
};

TEST_F(JoySteeringTest, SteersWhileTheDeadManButtonIsPressedAndThenStopsOnce) {
  EXPECT_EQ(steer(false, 1), "");
  EXPECT_EQ(steer(true, 1, -1, 0.6F), "walk 0.2 -0.07 0.75,");
  EXPECT_EQ(steer(false, 1), "walk 0 0 0,");
  EXPECT_EQ(steer(false, 1), "") << "others may steer";
}

TEST_F(JoySteeringTest, TakesASmallDeflectionAndWhatIsNotANumberForNone) {
  EXPECT_EQ(steer(true, 0.19F), "walk 0 0 0,");
  EXPECT_EQ(steer(true, 0.6F), "walk 0.1 0 0,");
  EXPECT_EQ(steer(true, 7.0F), "walk 0.2 0 0,") << "not more than all of it";
  EXPECT_EQ(steer(true, std::nanf("")), "walk 0 0 0,");
}

TEST_F(JoySteeringTest, TurnsTheHeadByTheOtherStick) {
  axes_[kPan] = 1;
  axes_[kTilt] = -0.6F;
  EXPECT_EQ(press({}), "") << "only with the dead-man button";
  EXPECT_EQ(press({kDeadMan}), "walk 0 0 0,head 0.6 -0.3,");
  axes_[kPan] = axes_[kTilt] = 0;
  EXPECT_EQ(press({kDeadMan}), "walk 0 0 0,") << "others may move it";
  EXPECT_EQ(press({}), "walk 0 0 0,") << "another node may have let it walk meanwhile";
}

TEST_F(JoySteeringTest, StopsAtOnceAndDoesNotGoOnBeforeTheDeadManButtonWasLetGo) {
  EXPECT_EQ(press({kStop}), "stop,") << "without the dead-man button";
  EXPECT_EQ(press({kStop}), "") << "once";
  press({});
  axes_[kForward] = 1;
  EXPECT_EQ(press({kStop}), "stop,");
  EXPECT_EQ(press({kDeadMan}), "walk 0.2 0 0,") << "it was let go";
  EXPECT_EQ(press({kDeadMan, kStop}), "walk 0 0 0,stop,");
  EXPECT_EQ(press({kDeadMan}), "") << "the stick is still deflected";
  press({});
  EXPECT_EQ(press({kDeadMan}), "walk 0.2 0 0,");
}

TEST_F(JoySteeringTest, ReleasesWithTheDeadManButtonWhichThenHasToBeLetGo) {
  axes_[kForward] = 1;
  EXPECT_EQ(press({kRelease}), "");
  EXPECT_EQ(press({kDeadMan, kRelease}), "walk 0.2 0 0,") << "it was pressed before";
  press({kDeadMan});
  EXPECT_EQ(press({kDeadMan, kRelease}), "walk 0 0 0,release,") << "the stick is deflected";
  EXPECT_EQ(press({kDeadMan, kRelease}), "") << "once";
  EXPECT_EQ(press({kDeadMan}), "");
  press({});
  EXPECT_EQ(press({kDeadMan}), "walk 0.2 0 0,");
  EXPECT_EQ(press({kDeadMan, kStop, kRelease}), "walk 0 0 0,stop,") << "no release together with a stop";
}

TEST_F(JoySteeringTest, GivesEachOrderOnceAndThoseThatMoveOnlyWithTheDeadManButton) {
  EXPECT_EQ(press({kPicture, kNod, kRest}), "picture,");
  EXPECT_EQ(press({kPicture, kNod, kRest}), "");
  press({kDeadMan});
  EXPECT_EQ(press({kDeadMan, kWag}), "walk 0 0 0,WAG");
  EXPECT_EQ(press({kDeadMan, kWag}), "walk 0 0 0,");
  EXPECT_EQ(press({kDeadMan, kStand}), "walk 0 0 0,stand");
  EXPECT_EQ(press({kDeadMan, kRest}), "walk 0 0 0,rest");
}

TEST_F(JoySteeringTest, OnlyStopsWithAJoystickThatHasOtherParts) {
  EXPECT_EQ(joy_.problem(7, 8), "");
  EXPECT_THAT(joy_.problem(6, 8), HasSubstr("6 axes and 8 buttons, but its mapping names axis 6 and button 7"));
  EXPECT_THAT(joy_.problem(7, 7), HasSubstr("7 buttons"));
  const auto read = [this](const std::vector<int>& buttons) { return describe(joy_.read({1, 1}, buttons)); };
  EXPECT_EQ(read({1, 1, 1, 0, 1, 0}), "");
  EXPECT_EQ(read({1, 1, 1, 1, 1, 1}), "stop,");
  EXPECT_EQ(read({1, 1, 1, 1, 1, 1}), "") << "once";
  EXPECT_EQ(read({1, 1, 1, 1, 1, 0}), "") << "it does not release";
  press({});
  steer(true, 1);
  EXPECT_EQ(read({1, 1, 1, 1, 1, 0}), "walk 0 0 0,");
}

TEST(JoyMappingTest, NamesNoPartThatTheJoystickDoesNotHave) {
  using Change = std::function<void(JoyMapping&)>;
  const std::pair<Change, const char*> rows[] = {
      {[](JoyMapping& wrong) { wrong.forward_axis = 7; }, "axis 7"},
      {[](JoyMapping& wrong) { wrong.turn_axis = 7; }, "axis 7"},
      {[](JoyMapping& wrong) { wrong.left_axis = 7; }, "axis 7"},
      {[](JoyMapping& wrong) { wrong.pan_axis = 7; }, "axis 7"},
      {[](JoyMapping& wrong) { wrong.tilt_axis = 7; }, "axis 7"},
      {[](JoyMapping& wrong) { wrong.dead_man_button = 8; }, "button 8"},
      {[](JoyMapping& wrong) { wrong.stop_button = 8; }, "button 8"},
      {[](JoyMapping& wrong) { wrong.release_button = 8; }, "button 8"},
      {[](JoyMapping& wrong) { wrong.picture_button = 8; }, "button 8"},
      {[](JoyMapping& wrong) { wrong.motions["NOD"] = 8; }, "button 8"},
      {[](JoyMapping& wrong) { wrong.postures["stand"] = 8; }, "button 8"},
  };
  for (const auto& [change, named] : rows) {
    JoyMapping wrong = mapping();
    change(wrong);
    EXPECT_THAT(JoySteering(wrong).problem(7, 8), HasSubstr(named));
  }
}

TEST(JoyMappingTest, NeedNotNameEveryPart) {
  JoyMapping few;
  few.left_axis = few.pan_axis = few.tilt_axis = few.stop_button = few.picture_button = kNoPlace;
  JoySteering joy(few);
  EXPECT_EQ(joy.problem(2, 5), "");
  const JoyOrders orders = joy.read({0, 1}, {1, 1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(orders.walk->forward, 0.1);
  EXPECT_EQ(orders.walk->left, 0);
  EXPECT_FALSE(orders.head || orders.stop || orders.take_picture || orders.release);
}

}  // namespace
}  // namespace teleop
