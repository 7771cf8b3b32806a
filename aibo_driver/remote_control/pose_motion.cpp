#include "remote_control/pose_motion.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "motion_tool/motion_tool.h"
#include "movement/joint_table.h"

namespace aibo_driver::remote_control {
namespace {

constexpr int kFrame = 20;  // ms; all times are multiples of it
constexpr double kTenthsPerRadian = 572.9577951308232;

// What a key frame says of a joint, in tenths of a degree.
int tenthsOf(const Pose& pose, const movement::JointProperties& joint) {
  return static_cast<int>(std::lround(std::clamp(pose.at(joint.name), joint.lowest, joint.highest) * kTenthsPerRadian));
}

// The time of a step in ms, as a multiple of a frame. It is never too short for a joint.
int timeOfStep(const Pose& from, const Pose& to, const movement::JointTable& joints, double seconds) {
  int frames = static_cast<int>(std::lround(seconds * 1000 / kFrame));
  for (const movement::JointProperties& joint : joints.joints()) {
    const double way = std::abs(tenthsOf(to, joint) - tenthsOf(from, joint)) / kTenthsPerRadian;
    frames = std::max(frames, static_cast<int>(std::ceil(way / joint.own_speed * 1000 / kFrame)));
  }
  return frames * kFrame;
}

}  // namespace

PoseMotion makePoseMotion(const std::string& name, const std::string& design, const std::vector<Pose>& poses,
                          double seconds) {
  const movement::JointTable joints(design, movement::kNoSpeedLimit);
  std::ostringstream text;
  text << "name " << name << "\ncreator aibo_remote_control\nrobot " << design << "\nframe " << kFrame << '\n';
  int time = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    time += i == 0 ? 0 : timeOfStep(poses[i - 1], poses[i], joints, seconds);
    text << "\nat " << time << '\n';
    for (const movement::JointProperties& joint : joints.joints()) {
      text << "  " << joint.name << ' ' << tenthsOf(poses[i], joint) / 10.0 << '\n';
    }
  }
  PoseMotion result{text.str(), motion_tool::encodeMtn(motion_tool::parseTextForm(text.str())), time / 1000.0, ""};
  mtn::Motion motion;
  motion.read(reinterpret_cast<const unsigned char*>(result.bytes.data()), result.bytes.size());
  result.remark = motion_tool::describeChanges(motion, *robot_model::findRobotModel(design.c_str()));
  return result;
}

}  // namespace aibo_driver::remote_control
