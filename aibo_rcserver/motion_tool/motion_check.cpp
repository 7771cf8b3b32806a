#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "motion_tool/motion_tool.h"
#include "mtn/fitted_motion.h"

namespace motion_tool {
namespace {

using robot_model::Coupling;
using robot_model::Joint;
using robot_model::NO_JOINT;
using robot_model::RobotModel;

constexpr int kTolerance = mtn::FittedMotion::TOLERANCE;

std::string inDegrees(double microradians) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", microradians * 180e-6 / 3.14159265358979323846);
  return text;
}

class Check {
 public:
  Check(const mtn::Motion& motion, const RobotModel& robot) : motion_(motion), robot_(robot) {
    for (int i = 0; i < motion.numberOfJoints(); ++i) {
      joints_.push_back(findJointByLocator(robot, motion.locator(i)));
    }
  }

  std::vector<std::string> run() {
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      const bool is_ear = findEarByLocator(robot_, motion_.locator(i)) != robot_model::NO_EAR;
      if (jointOf(i) == nullptr && !is_ear) {
        obstacles_.push_back(std::string("an ") + robot_.design + " has no joint " + motion_.locator(i));
      }
    }
    int milliseconds = 0;
    for (int key_frame = 0; key_frame < motion_.numberOfKeyFrames(); ++key_frame) {
      milliseconds += motion_.milliseconds(key_frame);
      when_ = "at " + std::to_string(milliseconds) + " ms, ";
      checkLimits(key_frame);
      checkCouplings(key_frame);
      checkSpeeds(key_frame);
    }
    return obstacles_;
  }

 private:
  const Joint* jointOf(int i) const {
    const int joint = joints_[static_cast<std::size_t>(i)];
    return joint == NO_JOINT ? nullptr : &robot_.joints[joint];
  }

  int findInMotion(int joint) const {
    const auto found = std::find(joints_.begin(), joints_.end(), joint);
    return found == joints_.end() ? NO_JOINT : static_cast<int>(found - joints_.begin());
  }

  void checkLimits(int key_frame) {
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      const Joint* joint = jointOf(i);
      const int position = motion_.position(key_frame, i);
      if (joint != nullptr && (position < joint->lowest - kTolerance || position > joint->highest + kTolerance)) {
        obstacles_.push_back(when_ + joint->name + " is at " + inDegrees(position) + " degrees, outside " +
                             inDegrees(joint->lowest) + " to " + inDegrees(joint->highest));
      }
    }
  }

  void checkCouplings(int key_frame) {
    for (int i = 0; i < robot_.number_of_couplings; ++i) {
      const Coupling& coupling = robot_.couplings[i];
      const int leader = findInMotion(coupling.leader);
      const int follower = findInMotion(coupling.follower);
      if (leader == NO_JOINT || follower == NO_JOINT) {
        continue;
      }
      const int at = motion_.position(key_frame, leader);
      const int lowest = coupledLowest(coupling, at);
      if (motion_.position(key_frame, follower) < lowest - kTolerance) {
        obstacles_.push_back(when_ + jointOf(follower)->name + " is below " + inDegrees(lowest) +
                             " degrees, where it hits " + jointOf(leader)->name + " at " + inDegrees(at));
      }
    }
  }

  void checkSpeeds(int key_frame) {
    if (key_frame == 0) {
      return;
    }
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      const Joint* joint = jointOf(i);
      const double distance = std::abs(motion_.position(key_frame, i) - motion_.position(key_frame - 1, i));
      const double seconds = motion_.milliseconds(key_frame) / 1000.0;
      const double speed = distance / seconds;
      if (joint != nullptr && distance > joint->highest_speed * seconds + kTolerance) {
        obstacles_.push_back(when_ + joint->name + " would have moved at " + inDegrees(speed) +
                             " degrees a second, above its limit of " + inDegrees(joint->highest_speed));
      }
    }
  }

  const mtn::Motion& motion_;
  const RobotModel& robot_;
  std::vector<int> joints_;  ///< the robot's joint for each joint of the motion, or NO_JOINT
  std::string when_;
  std::vector<std::string> obstacles_;
};

}  // namespace

std::vector<std::string> findObstacles(const mtn::Motion& motion, const RobotModel& robot) {
  return Check(motion, robot).run();
}

std::string describeChanges(const mtn::Motion& motion, const RobotModel& robot) {
  mtn::FittedMotion fitted;
  if (!fitted.fit(motion, robot, false)) {
    return std::string("an ") + robot.design + " does not play it: it " + fitted.problem();
  }
  std::array<int, robot_model::MAX_JOINTS> speed_limits{};
  std::transform(robot.joints, robot.joints + robot.number_of_joints, speed_limits.begin(),
                 [](const Joint& joint) { return joint.highest_speed; });
  char text[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
  fitted.describe(speed_limits.data(), text);
  return text[0] == '\0' ? "" : std::string("on an ") + robot.design + ", " + text;
}

}  // namespace motion_tool
