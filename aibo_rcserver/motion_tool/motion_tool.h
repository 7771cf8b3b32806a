/// @file motion_tool.h
/// The parts of aibo_mtn: motions in text, as motion files, and checked against a robot.
#ifndef AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H
#define AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H

#include <istream>
#include <string>
#include <vector>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace motion_tool {

struct KeyFrame {
  int milliseconds = 0;        ///< from the beginning of the motion
  std::vector<int> positions;  ///< of all joints, in microradian
};

/// The content of a motion file.
struct KeyFrameMotion {
  std::string name;
  std::string creator;
  std::string design;  ///< the robot, as motion files name it: "DRX-1000" is an ERS-7, "DRX-910" an ERS-210
  int frame_milliseconds = 16;
  std::vector<std::string> locators;  ///< one per joint
  std::vector<KeyFrame> key_frames;   ///< in ascending order of their times, the first at 0
};

/// Reads the text form of a motion (docs/motions.md):
///
///     name NOD
///     creator somebody
///     robot ERS-7
///     at 0     neck_tilt 0    head_tilt 0
///     at 320   neck_tilt -20  # degrees; joints that are not named stay where they were
///     at 640   neck_tilt 0
///
/// A `#` begins a comment. Joints and degrees may also follow their `at` on lines of their own. The first key frame
/// names all joints of the motion. The ears left_ear and right_ear have states instead of degrees, whole numbers such
/// as 0 and 1.
/// @throw std::runtime_error all mistakes, one "line 3: ..." per line of the message
KeyFrameMotion parseTextForm(std::istream& text);

/// The text form of a motion, from which encodeMtn() makes the same key frames again. Every key frame names all joints;
/// a joint that is not in the robot's table is named by its locator.
std::string printTextForm(const mtn::Motion& motion);

/// The bytes of a motion file (layout.h), which mtn::Motion reads.
/// @throw std::runtime_error if mtn::Motion would refuse them, if a text is too long, or if the times are not ascending
///   multiples of a frame; the message says why
std::string encodeMtn(const KeyFrameMotion& motion);

/// What the robot plays differently than the motion says when its joints move as fast as they can, or why it does not
/// play it (mtn::FittedMotion).
/// @return one line; empty if the robot plays all of it as it is
std::string describeChanges(const mtn::Motion& motion, const robot_model::RobotModel& robot);

/// A line as it may go to a terminal: unchanged if it is plain text (protocol::isPlainText()), otherwise with a '?' for
/// each byte that is not a printable character of ASCII. Motion files come from anywhere.
std::string forTerminal(std::string line);

/// The table of the robot that a motion file with this design is for; null if there is none.
const robot_model::RobotModel* modelOf(const std::string& design);

/// Everything in the motion that the robot could not do exactly: joints that it does not have, positions beyond their
/// limits, joints in each other's way, and joints that would have to move faster than they can. For the motion's
/// author. Joints that are not in the motion are assumed to be out of the way.
/// @return one line each; empty if the robot can do all of it
std::vector<std::string> findObstacles(const mtn::Motion& motion, const robot_model::RobotModel& robot);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H
