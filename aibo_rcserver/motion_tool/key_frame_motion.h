/// @file key_frame_motion.h
/// A motion in the making.
#ifndef AIBO_RCSERVER_MOTION_TOOL_KEY_FRAME_MOTION_H
#define AIBO_RCSERVER_MOTION_TOOL_KEY_FRAME_MOTION_H

#include <string>
#include <vector>

namespace motion_tool {

struct KeyFrame {
  int milliseconds = 0;        ///< from the beginning of the motion
  std::vector<int> positions;  ///< of all joints, in microradian
};

/// What a motion file holds.
struct KeyFrameMotion {
  std::string name;
  std::string creator;
  std::string design;  ///< as motion files name it: "DRX-1000" is an ERS-7, "DRX-910" an ERS-210
  int frame_milliseconds = 16;
  std::vector<std::string> locators;  ///< one a joint
  std::vector<KeyFrame> key_frames;   ///< in the order of their times, the first at 0
};

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_KEY_FRAME_MOTION_H
