/// @file text_form.h
/// Motions as people write them (docs/motions.md):
///
///     name NOD
///     creator somebody
///     robot ERS-7
///     at 0     neck_tilt 0    head_tilt 0
///     at 320   neck_tilt -20  # degrees; who is not named stays where it was
///     at 640   neck_tilt 0
///
/// A `#` begins a comment, and lines of joints and degrees may follow the `at` they belong to.
#ifndef AIBO_RCSERVER_MOTION_TOOL_TEXT_FORM_H
#define AIBO_RCSERVER_MOTION_TOOL_TEXT_FORM_H

#include <istream>
#include <string>

#include "motion_tool/key_frame_motion.h"
#include "mtn/motion.h"

namespace motion_tool {

/// Reads the text form. The first key frame names all joints of the motion.
/// @throws std::runtime_error "line 3: ..." with what is wrong
KeyFrameMotion parseTextForm(std::istream& text);

/// The text form of a motion, of which encodeMtn() makes the same key frames again. Every key frame names all joints;
/// one that the robot's table does not have goes by its locator.
std::string printTextForm(const mtn::Motion& motion);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_TEXT_FORM_H
