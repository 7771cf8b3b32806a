#include "robot_model/robot_model.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

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

struct Step {
  double from;
  double to;
  double lowest;
};

// Checks the follower's lower limit exactly where a row begins or ends.
void expectEdges(const std::string& leader, const std::string& follower, const std::vector<Step>& rows) {
  Posture posture{};
  posture[static_cast<size_t>(index(ers7(), "mouth"))] = microradians(-3);  // out of the way
  for (const Step& row : rows) {
    for (const double edge : {row.from, row.to}) {
      posture[static_cast<size_t>(index(ers7(), leader))] = microradians(edge);
      EXPECT_EQ(lowestPosition(ers7(), index(ers7(), follower), posture.data()), microradians(row.lowest))
          << follower << " with " << leader << " at " << edge << " degrees";
    }
  }
}

// Some rows of Model Information ERS-7, 2.1.2.
TEST(CoupledLimits, KeepTheLegsOffTheBody) {
  for (const std::string side : {"left", "right"}) {
    expectEdges(side + "_front_rotator", side + "_front_elevator",
                {{-115, -76, -1}, {-53, -46, -3}, {-10, 20, -10}, {21, 25, -9}, {29, 40, -7}, {64, 130, -2}});
    expectEdges(side + "_hind_rotator", side + "_hind_elevator",
                {{115, 71, 0}, {70, 61, -1}, {15, -10, -10}, {-11, -15, -9}, {-56, -70, -1}, {-71, -130, 0}});
  }
}

TEST(CoupledLimits, KeepTheHeadOffTheNeckAlsoWhileTheMouthIsWideOpen) {
  expectEdges("neck_tilt", "head_tilt", {{-75, -39, 5}, {-38, 0, -5}});
  expectEdges("mouth", "head_tilt", {{-55, -31, 5}, {-30, -3, -5}});
}

}  // namespace
}  // namespace robot_model
