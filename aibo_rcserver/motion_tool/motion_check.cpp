#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "motion_tool/motion_tool.h"
#include "mtn/fitted_motion.h"

namespace motion_tool {

using robot_model::RobotModel;

const RobotModel* robotOf(const mtn::Motion& motion) {
  std::array<const char*, 2> designs = {"ERS-7", "ERS-210"};
  if (std::strncmp(motion.design(), "DRX-910", 7) == 0) {
    std::swap(designs[0], designs[1]);
  }
  const RobotModel* best = nullptr;
  int fewest_left_out = mtn::MAX_JOINTS;
  for (const char* const design : designs) {
    const RobotModel* robot = robot_model::findRobotModel(design);
    mtn::FittedMotion fitted;
    if (fitted.fit(motion, *robot, true) && fitted.leftOut() < fewest_left_out) {
      best = robot;
      fewest_left_out = fitted.leftOut();
    }
  }
  return best;
}

std::string describeChanges(const mtn::Motion& motion, const RobotModel& robot) {
  mtn::FittedMotion fitted;
  if (!fitted.fit(motion, robot, false)) {
    return std::string("an ") + robot.design + " does not play it: it " + fitted.problem();
  }
  std::array<int, robot_model::MAX_JOINTS> speed_limits{};
  std::transform(robot.joints, robot.joints + robot.number_of_joints, speed_limits.begin(),
                 [](const robot_model::Joint& joint) { return joint.highest_speed; });
  char text[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
  fitted.describe(speed_limits.data(), text);
  return text[0] == '\0' ? "" : std::string("on an ") + robot.design + ", " + text;
}

}  // namespace motion_tool
