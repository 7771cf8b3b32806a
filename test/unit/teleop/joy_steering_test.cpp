#include "tools/teleop/joy_steering.h"

#include <gmock/gmock.h>

#include <utility>

namespace teleop {
namespace {

using ::testing::HasSubstr;

JoyMapping mapping() {
  JoyMapping mapping;
  mapping.motions = {{"NOD", 2}, {"WAG", 3}};
  mapping.postures = {{"rest", 6}, {"stand", 7}};
  return mapping;
}

class JoySteeringTest : public ::testing::Test {
 protected:
  // Axes: turn, forward, -, pan, tilt, -, left.
  JoyOrders steer(bool pressed, float forward, float left = 0, float turn = 0) {
    axes_ = {turn, forward, 0, 0, 0, 0, left};
    return press({pressed ? 4 : 5});
  }

  JoyOrders press(const std::vector<int>& pressed) {
    std::vector<int> buttons(8, 0);
    for (const int button : pressed) {
      buttons.at(static_cast<std::size_t>(button)) = 1;
    }
    return joy_.read(axes_, buttons);
  }

  std::vector<float> axes_ = std::vector<float>(7, 0.0F);
  JoySteering joy_{mapping()};
};

TEST_F(JoySteeringTest, SteersWhileTheDeadManButtonIsPressed) {
  EXPECT_FALSE(steer(false, 1).walk);
  const auto velocity = steer(true, 1, -1, 1).walk;
  ASSERT_TRUE(velocity);
  EXPECT_DOUBLE_EQ(velocity->forward, 0.15);
  EXPECT_DOUBLE_EQ(velocity->left, -0.06);
  EXPECT_DOUBLE_EQ(velocity->turn, 1.0);
}

TEST_F(JoySteeringTest, StopsOnceWhenTheButtonIsLetGo) {
  steer(true, 1);
  const auto velocity = steer(false, 1).walk;
  ASSERT_TRUE(velocity);
  EXPECT_TRUE(velocity->isZero());
  EXPECT_FALSE(steer(false, 1).walk) << "others may steer";
}

TEST_F(JoySteeringTest, TakesASmallDeflectionForNone) {
  EXPECT_TRUE(steer(true, 0.09F).walk->isZero());
  EXPECT_NEAR(steer(true, 0.55F).walk->forward, 0.075, 1e-6);
  EXPECT_NEAR(steer(true, -0.55F).walk->forward, -0.075, 1e-6);
  EXPECT_NEAR(steer(true, 7.0F).walk->forward, 0.15, 1e-6) << "not more than all of it";
}

TEST_F(JoySteeringTest, TakesWhatIsNotANumberForNone) {
  EXPECT_TRUE(steer(true, std::nanf("")).walk->isZero());
}

TEST_F(JoySteeringTest, TurnsTheHeadByTheOtherStick) {
  axes_ = {0, 0, 0, 1, -0.55F, 0, 0};
  EXPECT_FALSE(press({}).head) << "only with the dead-man button";
  const auto head = press({4}).head;
  ASSERT_TRUE(head);
  EXPECT_DOUBLE_EQ(head->pan, 1.0);
  EXPECT_NEAR(head->tilt, -0.5, 1e-6);
  axes_[3] = 0;
  EXPECT_TRUE(press({4}).head) << "up and down only";
  std::swap(axes_[3], axes_[4]);
  EXPECT_TRUE(press({4}).head) << "to the sides only";
  axes_ = std::vector<float>(7, 0.0F);
  EXPECT_FALSE(press({4}).head) << "others may move it";
}

TEST_F(JoySteeringTest, StopsAtOnceAndDoesNotGoOnBeforeTheDeadManButtonWasLetGo) {
  EXPECT_TRUE(press({1}).stop) << "without the dead-man button";
  EXPECT_FALSE(press({1}).stop) << "once";
  press({});
  axes_[1] = 1;
  EXPECT_FALSE(press({4}).walk->isZero());
  const JoyOrders stopped = press({4, 1});
  EXPECT_TRUE(stopped.stop);
  EXPECT_TRUE(stopped.walk->isZero());
  EXPECT_FALSE(press({4}).walk) << "the stick is still deflected";
  press({});
  EXPECT_FALSE(press({4}).walk->isZero());
}

TEST(JoySteeringOfRelease, NeedsTheDeadManButtonAndThenThatItIsLetGo) {
  JoyMapping with_release = mapping();
  with_release.release_button = 5;
  JoySteering joy(with_release);
  const auto press = [&joy](int dead_man, int release) {
    return joy.read({0, 1, 0, 0, 0, 0, 0}, {0, 0, 0, 0, dead_man, release, 0, 0});
  };
  EXPECT_FALSE(press(0, 1).release);
  EXPECT_FALSE(press(1, 1).release) << "it was pressed before";
  press(1, 0);
  const JoyOrders released = press(1, 1);
  EXPECT_TRUE(released.release);
  EXPECT_TRUE(released.walk->isZero()) << "the stick is deflected";
  EXPECT_FALSE(press(1, 1).release) << "once";
  EXPECT_FALSE(press(1, 0).walk);
  press(0, 0);
  EXPECT_FALSE(press(1, 0).walk->isZero());
}

TEST(JoySteeringOfRelease, IsNoneWithAJoystickThatHasOtherParts) {
  JoyMapping with_release = mapping();
  with_release.release_button = 5;
  JoySteering joy(with_release);
  joy.read({0, 1}, {0, 0, 0, 0, 1, 0, 0, 0});
  EXPECT_FALSE(joy.read({0, 1}, {0, 0, 0, 0, 1, 1, 0, 0}).release);
}

TEST(JoySteeringOfRelease, IsNoneTogetherWithAStop) {
  JoyMapping with_release = mapping();
  with_release.release_button = 5;
  JoySteering joy(with_release);
  joy.read({0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 1, 0, 0, 0});
  const JoyOrders both = joy.read({0, 0, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 1, 1, 0, 0});
  EXPECT_TRUE(both.stop);
  EXPECT_FALSE(both.release);
}

TEST_F(JoySteeringTest, GivesEachOrderOnceAndThoseThatMoveOnlyWithTheDeadManButton) {
  EXPECT_TRUE(press({0, 2}).take_picture);
  EXPECT_FALSE(press({0, 2}).take_picture);
  press({});
  EXPECT_EQ(press({2, 6}).motion, "");
  press({});
  EXPECT_EQ(press({2, 6}).posture, "");
  press({4});
  EXPECT_EQ(press({4, 3}).motion, "WAG");
  EXPECT_EQ(press({4, 3}).motion, "");
  EXPECT_EQ(press({4, 2}).motion, "NOD");
  EXPECT_EQ(press({4, 7}).posture, "stand");
  EXPECT_EQ(press({4, 6}).posture, "rest");
}

TEST_F(JoySteeringTest, OnlyStopsWithAJoystickThatHasOtherParts) {
  EXPECT_EQ(joy_.problem(7, 8), "");
  EXPECT_THAT(joy_.problem(6, 8), HasSubstr("6 axes and 8 buttons, but its mapping names axis 6 and button 7"));
  EXPECT_THAT(joy_.problem(7, 7), HasSubstr("7 buttons"));
  EXPECT_FALSE(joy_.read({1, 1}, {0, 0, 1, 1, 1}).walk);
  EXPECT_TRUE(joy_.read({1, 1}, {0, 1, 1, 1, 1}).stop);
  EXPECT_FALSE(joy_.read({1, 1}, {0, 1, 1, 1, 1}).stop) << "once";
  steer(true, 1);
  const JoyOrders orders = joy_.read({1, 1}, {1, 1, 1, 1, 1});
  ASSERT_TRUE(orders.walk);
  EXPECT_TRUE(orders.walk->isZero());
  EXPECT_FALSE(orders.take_picture);
}

TEST(JoyMappingTest, NamesNoPartThatTheJoystickDoesNotHave) {
  for (int JoyMapping::*axis : {&JoyMapping::forward_axis, &JoyMapping::turn_axis, &JoyMapping::left_axis,
                                &JoyMapping::pan_axis, &JoyMapping::tilt_axis}) {
    JoyMapping wrong = mapping();
    wrong.*axis = 7;
    EXPECT_THAT(JoySteering(wrong).problem(7, 8), HasSubstr("its mapping names axis 7 and button 7"));
  }
  for (int JoyMapping::*button : {&JoyMapping::dead_man_button, &JoyMapping::stop_button, &JoyMapping::release_button,
                                  &JoyMapping::picture_button}) {
    JoyMapping wrong = mapping();
    wrong.*button = 8;
    EXPECT_THAT(JoySteering(wrong).problem(7, 8), HasSubstr("its mapping names axis 6 and button 8"));
  }
  for (std::map<std::string, int> JoyMapping::*buttons : {&JoyMapping::motions, &JoyMapping::postures}) {
    JoyMapping wrong = mapping();
    wrong.*buttons = {{"first", 0}, {"second", 8}, {"third", 1}};
    EXPECT_THAT(JoySteering(wrong).problem(7, 8), HasSubstr("its mapping names axis 6 and button 8"));
  }
}

TEST(JoyMappingTest, NeedNotNameEveryPart) {
  JoyMapping few;
  few.left_axis = few.pan_axis = few.tilt_axis = few.stop_button = few.picture_button = kNoPlace;
  JoySteering joy(few);
  EXPECT_EQ(joy.problem(2, 5), "");
  const JoyOrders orders = joy.read({0, 1}, {1, 1, 1, 1, 1});
  EXPECT_DOUBLE_EQ(orders.walk->forward, 0.15);
  EXPECT_EQ(orders.walk->left, 0);
  EXPECT_FALSE(orders.head || orders.stop || orders.take_picture);
}

}  // namespace
}  // namespace teleop
