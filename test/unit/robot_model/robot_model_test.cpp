#include "robot_model/robot_model.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <random>

namespace robot_model {
namespace {

using Posture = std::array<int, MAX_JOINTS>;

int microradians(double degrees) {
  return static_cast<int>(std::lround(degrees * 17453.2925));
}

const RobotModel& ers7() {
  return *findRobotModel("ERS-7");
}

int index(const RobotModel& model, const std::string& name) {
  return findJointByName(model, name.c_str());
}

// A posture of the ERS-7 in which no joint restricts another.
Posture freePosture() {
  Posture posture{};
  posture[static_cast<size_t>(index(ers7(), "mouth"))] = microradians(-3);
  return posture;
}

struct ExpectedJoint {
  const char* name;
  int identifier;
  const char* locator;
  int lowest;
  int highest;
  int mechanical_lowest;
  int mechanical_highest;
  int highest_speed;
  int proportional;
  int integral;
  int derivative;
};

void expectJoint(const RobotModel& model, const ExpectedJoint& expected) {
  SCOPED_TRACE(std::string(model.design) + " " + expected.name);
  const int found = findJointByIdentifier(model, expected.identifier);
  ASSERT_NE(found, NO_JOINT);
  const Joint& joint = model.joints[found];
  EXPECT_STREQ(joint.name, expected.name);
  EXPECT_EQ(joint.identifier, expected.identifier);
  EXPECT_STREQ(joint.locator, expected.locator);
  EXPECT_EQ(joint.lowest, expected.lowest);
  EXPECT_EQ(joint.highest, expected.highest);
  EXPECT_EQ(joint.mechanical_lowest, expected.mechanical_lowest);
  EXPECT_EQ(joint.mechanical_highest, expected.mechanical_highest);
  EXPECT_EQ(joint.highest_speed, expected.highest_speed);
  EXPECT_EQ(joint.gains.proportional, expected.proportional);
  EXPECT_EQ(joint.gains.integral, expected.integral);
  EXPECT_EQ(joint.gains.derivative, expected.derivative);
  EXPECT_EQ(joint.gains.proportional_shift, 0x0E);
  EXPECT_EQ(joint.gains.integral_shift, 0x02);
  EXPECT_EQ(joint.gains.derivative_shift, 0x0F);
  EXPECT_EQ(findJointByName(model, expected.name), found);
  EXPECT_EQ(findJointByLocator(model, expected.locator), found);
}

TEST(RobotModel, IsFoundByTheNameOfItsDesign) {
  ASSERT_NE(findRobotModel("ERS-7"), nullptr);
  EXPECT_STREQ(findRobotModel("ERS-7")->design, "ERS-7");
  ASSERT_NE(findRobotModel("ERS-210"), nullptr);
  EXPECT_STREQ(findRobotModel("ERS-210")->design, "ERS-210");
  EXPECT_EQ(findRobotModel("ERS-220"), nullptr);
  EXPECT_EQ(findRobotModel(""), nullptr);
}

TEST(RobotModel, HasTheNumbersOfTheErs7) {
  const std::vector<ExpectedJoint> joints = {
      {"neck_tilt", 1, "PRM:/r1/c1-Joint2:11", -1308997, 0, -1396263, 52360, 3185226, 10, 4, 2},
      {"head_pan", 2, "PRM:/r1/c1/c2-Joint2:12", -1535890, 1535890, -1623156, 1623156, 10057460, 8, 2, 4},
      {"head_tilt", 3, "PRM:/r1/c1/c2/c3-Joint2:13", -261799, 785398, -349066, 872665, 5781403, 8, 4, 2},
      {"mouth", 4, "PRM:/r1/c1/c2/c3/c4-Joint2:14", -959931, -52360, -1047198, 0, 10144726, 8, 0, 4},
      {"left_front_rotator", 11, "PRM:/r2/c1-Joint2:21", -2007129, 2268928, -2094395, 2356194, 4865105, 28, 8, 1},
      {"left_front_elevator", 12, "PRM:/r2/c1/c2-Joint2:22", -174533, 1535890, -261799, 1623156, 5279621, 20, 4, 1},
      {"left_front_knee", 13, "PRM:/r2/c1/c2/c3-Joint2:23", -436332, 2129302, -523599, 2216568, 5279621, 28, 8, 1},
      {"left_hind_rotator", 21, "PRM:/r3/c1-Joint2:31", -2268928, 2007129, -2356194, 2094395, 4865105, 28, 8, 1},
      {"left_hind_elevator", 22, "PRM:/r3/c1/c2-Joint2:32", -174533, 1535890, -261799, 1623156, 5279621, 20, 4, 1},
      {"left_hind_knee", 23, "PRM:/r3/c1/c2/c3-Joint2:33", -436332, 2181662, -523599, 2216568, 5279621, 28, 8, 1},
      {"right_front_rotator", 31, "PRM:/r4/c1-Joint2:41", -2007129, 2268928, -2094395, 2356194, 4865105, 28, 8, 1},
      {"right_front_elevator", 32, "PRM:/r4/c1/c2-Joint2:42", -174533, 1535890, -261799, 1623156, 5279621, 20, 4, 1},
      {"right_front_knee", 33, "PRM:/r4/c1/c2/c3-Joint2:43", -436332, 2129302, -523599, 2216568, 5279621, 28, 8, 1},
      {"right_hind_rotator", 41, "PRM:/r5/c1-Joint2:51", -2268928, 2007129, -2356194, 2094395, 4865105, 28, 8, 1},
      {"right_hind_elevator", 42, "PRM:/r5/c1/c2-Joint2:52", -174533, 1535890, -261799, 1623156, 5279621, 20, 4, 1},
      {"right_hind_knee", 43, "PRM:/r5/c1/c2/c3-Joint2:53", -436332, 2181662, -523599, 2216568, 5279621, 28, 8, 1},
      {"tail_pan", 51, "PRM:/r6/c2-Joint2:62", -785398, 785398, -1047198, 1047198, 15162548, 10, 4, 4},
      {"tail_tilt", 52, "PRM:/r6/c1-Joint2:61", 87266, 1047198, 0, 1134464, 15162548, 10, 4, 4},
  };
  ASSERT_EQ(ers7().number_of_joints, 18);
  for (const ExpectedJoint& joint : joints) {
    expectJoint(ers7(), joint);
  }
}

TEST(RobotModel, HasTheNumbersOfTheErs210) {
  const RobotModel& ers210 = *findRobotModel("ERS-210");
  ASSERT_EQ(ers210.number_of_joints, 18);
  const std::vector<ExpectedJoint> joints = {
      {"head_tilt", 1, "PRM:/r1/c1-Joint2:j1", -1431170, 750492, -1483530, 802851, 2105000, 10, 8, 12},
      {"head_pan", 2, "PRM:/r1/c1/c2-Joint2:j2", -1563815, 1563815, -1616175, 1616175, 3011000, 13, 8, 11},
      {"head_roll", 3, "PRM:/r1/c1/c2/c3-Joint2:j3", -506145, 506145, -558505, 558505, 3011000, 10, 8, 12},
      {"mouth", 4, "PRM:/r1/c1/c2/c3/c4-Joint2:j4", -820305, -52360, -872665, 0, 4374000, 14, 8, 16},
      {"tail_pan", 51, "PRM:/r6/c1-Joint2:j1", -383972, 383972, -436332, 436332, 4472000, 10, 0, 24},
      {"tail_tilt", 52, "PRM:/r6/c2-Joint2:j2", -383972, 383972, -436332, 436332, 4472000, 7, 0, 17},
  };
  for (const ExpectedJoint& joint : joints) {
    expectJoint(ers210, joint);
  }
  const char* const legs[] = {"left_front", "left_hind", "right_front", "right_hind"};
  for (int leg = 0; leg < 4; ++leg) {
    const auto expectInLeg = [&](const std::string& name, const std::string& locator, ExpectedJoint joint) {
      const std::string whole_name = std::string(legs[leg]) + name;
      const std::string whole_locator = "PRM:/r" + std::to_string(2 + leg) + locator;
      joint.name = whole_name.c_str();
      joint.locator = whole_locator.c_str();
      joint.identifier += 10 * leg;
      expectJoint(ers210, joint);
    };
    expectInLeg("_rotator", "/c1-Joint2:j1", {"", 11, "", -2042035, 2042035, -2094395, 2094395, 2814000, 22, 4, 8});
    expectInLeg("_elevator", "/c1/c2-Joint2:j2", {"", 12, "", -191986, 1553343, -244346, 1605703, 2498000, 20, 4, 6});
    expectInLeg("_knee", "/c1/c2/c3-Joint2:j3", {"", 13, "", -471239, 2565634, -523599, 2617994, 2836000, 35, 4, 5});
  }
}

struct Step {
  double from;
  double to;
  double lowest;
};

// Checks the follower's lower limit exactly where a row begins or ends.
void expectEdges(const std::string& leader, const std::string& follower, const std::vector<Step>& rows) {
  Posture posture = freePosture();
  for (const Step& row : rows) {
    for (const double edge : {row.from, row.to}) {
      posture[static_cast<size_t>(index(ers7(), leader))] = microradians(edge);
      EXPECT_EQ(lowestPosition(ers7(), index(ers7(), follower), posture.data()), microradians(row.lowest))
          << follower << " with " << leader << " at " << edge << " degrees";
    }
  }
}

TEST(CoupledLimits, KeepTheFrontLegsOffTheBody) {
  for (const std::string side : {"left", "right"}) {
    const std::string rotator = side + "_front_rotator";
    const std::string elevator = side + "_front_elevator";
    expectEdges(rotator, elevator,
                {{-115, -76, -1},
                 {-75, -54, -2},
                 {-53, -46, -3},
                 {-45, -36, -4},
                 {-35, -31, -5},
                 {-30, -26, -6},
                 {-25, -21, -7},
                 {-20, -16, -8},
                 {-15, -11, -9},
                 {-10, 20, -10},
                 {21, 25, -9},
                 {26, 28, -8},
                 {29, 40, -7},
                 {41, 45, -6},
                 {46, 50, -5},
                 {51, 55, -4},
                 {56, 63, -3},
                 {64, 130, -2}});
  }
}

TEST(CoupledLimits, KeepTheHindLegsOffTheBody) {
  for (const std::string side : {"left", "right"}) {
    const std::string rotator = side + "_hind_rotator";
    const std::string elevator = side + "_hind_elevator";
    expectEdges(rotator, elevator,
                {{115, 71, 0},   {70, 61, -1},   {60, 51, -2},   {50, 46, -3},   {45, 41, -4},   {40, 36, -5},
                 {35, 31, -6},   {30, 26, -7},   {25, 21, -8},   {20, 16, -9},   {15, -10, -10}, {-11, -15, -9},
                 {-16, -20, -8}, {-21, -25, -7}, {-26, -30, -6}, {-31, -35, -5}, {-36, -40, -4}, {-41, -45, -3},
                 {-46, -55, -2}, {-56, -70, -1}, {-71, -130, 0}});
  }
}

TEST(CoupledLimits, KeepTheHeadOffTheNeck) {
  expectEdges("neck_tilt", "head_tilt", {{-75, -39, 5}, {-38, 0, -5}});
}

TEST(CoupledLimits, KeepTheHeadAtASafeHeightWhileTheMouthIsWideOpen) {
  expectEdges("mouth", "head_tilt", {{-55, -31, 5}, {-30, -3, -5}});
}

// As robot_model::Coupling promises. The planning of movements relies on it.
TEST(CoupledLimits, NeverRestrictMoreBetweenTwoPositionsThanAtOneOfThem) {
  for (int i = 0; i < ers7().number_of_couplings; ++i) {
    const Coupling& coupling = ers7().couplings[i];
    bool rising = false;
    for (int row = 1; row < coupling.number_of_rows; ++row) {
      EXPECT_LT(coupling.rows[row - 1].from, coupling.rows[row].from) << "coupling " << i << ", row " << row;
      EXPECT_LT(coupling.rows[row - 1].to, coupling.rows[row].to) << "coupling " << i << ", row " << row;
      const bool rises = coupling.rows[row].lowest > coupling.rows[row - 1].lowest;
      EXPECT_TRUE(rises || !rising) << "coupling " << i << ", row " << row;
      rising = rises;
    }
  }
}

TEST(ClampPosture, DoesNotChangeAnAllowedPosture) {
  std::mt19937 random(1);
  for (const char* design : {"ERS-7", "ERS-210"}) {
    const RobotModel& model = *findRobotModel(design);
    for (int round = 0; round < 1000; ++round) {
      Posture posture;
      for (int& position : posture) {
        position = std::uniform_int_distribution<int>(-2800000, 2800000)(random);
      }
      clampPosture(model, posture.data());
      for (int i = 0; i < model.number_of_joints; ++i) {
        EXPECT_THAT(posture[static_cast<size_t>(i)],
                    testing::AllOf(testing::Ge(lowestPosition(model, i, posture.data())),
                                   testing::Le(model.joints[i].highest)));
      }
      Posture again = posture;
      clampPosture(model, again.data());
      EXPECT_EQ(again, posture);
    }
  }
}

}  // namespace
}  // namespace robot_model
