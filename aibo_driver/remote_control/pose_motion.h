/// @file pose_motion.h Motions made of poses. This needs no Qt.
#ifndef AIBO_DRIVER_REMOTE_CONTROL_POSE_MOTION_H
#define AIBO_DRIVER_REMOTE_CONTROL_POSE_MOTION_H

#include <map>
#include <string>
#include <vector>

namespace aibo_driver::remote_control {

using Pose = std::map<std::string, double>;  ///< rad, by the joint's name

/// A motion that goes from pose to pose.
struct PoseMotion {
  std::string text;     ///< for aibo_mtn (docs/motions.md)
  std::string bytes;    ///< the motion file
  double duration = 0;  ///< s
  std::string remark;   ///< what the robot plays differently, in one line; empty if nothing
};

/// Makes a motion whose key frames are poses. A step in which a joint would have to be faster than it can takes longer.
/// Positions are moved within the joints' limits, and rounded to a tenth of a degree.
/// @param design the robot, such as "ERS-7"
/// @param poses all with the same joints
/// @param seconds the time from key frame to key frame, 0.1..60
/// @throw std::runtime_error no robot has this design, or no motion file can hold the poses; the message says which
PoseMotion makePoseMotion(const std::string& name, const std::string& design, const std::vector<Pose>& poses,
                          double seconds);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_POSE_MOTION_H
