/// @file mtn_writer.h
/// Writes motion files.
#ifndef AIBO_RCSERVER_MOTION_TOOL_MTN_WRITER_H
#define AIBO_RCSERVER_MOTION_TOOL_MTN_WRITER_H

#include <string>

#include "motion_tool/key_frame_motion.h"

namespace motion_tool {

/// The bytes of a motion file (layout.h), which mtn::Motion reads.
/// @throws std::runtime_error if mtn::Motion would refuse them, or if a text is too long or times are not multiples of
/// a
///   frame in ascending order; says why
std::string encodeMtn(const KeyFrameMotion& motion);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_MTN_WRITER_H
