/// @file motion_tool.h
/// The parts of aibo_mtn: text form, motion files, and checks against a robot.
#ifndef AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H
#define AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H

#include <string>
#include <vector>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace motion_tool {

struct KeyFrame {
  int milliseconds = 0;        ///< from the beginning of the motion
  std::vector<int> positions;  ///< the positions of all joints, in microradians
};

/// The content of a motion file.
struct KeyFrameMotion {
  std::string name;
  std::string creator;
  std::string design;  ///< the robot, as motion files name it: "DRX-1000" is an ERS-7, "DRX-910" an ERS-210
  int frame_milliseconds = 16;
  std::vector<std::string> locators;  ///< one for each joint
  std::vector<KeyFrame> key_frames;   ///< in ascending order, the first at 0
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
/// A `#` begins a comment. Joints and degrees may continue on the lines below their `at`. The first key frame names all
/// joints of the motion. The ears left_ear and right_ear have states instead of degrees: whole numbers such as 0 and 1.
/// @param text the bytes of the file, as any editor writes them (protocol::textInFile())
/// @throw std::runtime_error the text has mistakes; the message lists all of them, one "line 3: ..." per line
KeyFrameMotion parseTextForm(const std::string& text);

/// Prints a motion in the text form. encodeMtn() makes the same key frames from it. Every key frame names all joints; a
/// joint that the robot lacks is named by its locator. The robot is robotOf()'s or, if that is null, the file's design.
std::string printTextForm(const mtn::Motion& motion);

/// The bytes of a motion file (layout.h).
/// @param motion as parseTextForm() makes it
/// @throw std::runtime_error mtn::Motion would refuse the motion, or a text is too long
std::string encodeMtn(const KeyFrameMotion& motion);

/// How the robot's playback at full joint speed would differ from the motion, or why the robot does not play it
/// (mtn::FittedMotion).
/// @return one line; empty if there is no difference
std::string describeChanges(const mtn::Motion& motion, const robot_model::RobotModel& robot);

/// Makes a line safe for a terminal, because motion files come from anywhere. If the line is not plain text
/// (protocol::isPlainText()), each byte that is not printable ASCII becomes a '?'.
std::string forTerminal(std::string line);

/// The robot that has the most of the motion's joints and ears; null if no robot has any. If both have the same number,
/// the design decides: Sony's motions for the ERS-7 have "DRX-1000", "DRX-1000_Head" and more.
const robot_model::RobotModel* robotOf(const mtn::Motion& motion);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_MOTION_TOOL_H
