/// @file layout.h
/// The layout of a motion file. All integers are little-endian; a text is one byte with its length, then its
/// characters.
///
///     OMTN       the four letters
///     section 0  uint32 0, uint32 size (24), uint32 number of sections (4), uint16 major version (1),
///                uint16 minor version (2), uint16 number of key frames, uint16 milliseconds per frame, uint32 reserved
///     section 1  uint32 1, uint32 size, three texts: name of the motion, its creator, design of the robot
///     section 2  uint32 2, uint32 size, uint16 number of joints, a locator for each as a text
///     section 3  uint32 3, uint32 size, uint32 type of the data (0), the key frames
///
/// The size of a section includes its number and its size; texts are padded to a multiple of four bytes. A key frame
/// consists of roll, pitch and yaw of the body and one position per joint, each an int32 in microradian. Every key
/// frame but the first is preceded by a uint32, the number of frames to interpolate between it and the one before: it
/// is reached (that number + 1) * milliseconds per frame later.
#ifndef AIBO_RCSERVER_MTN_LAYOUT_H
#define AIBO_RCSERVER_MTN_LAYOUT_H

#include <stddef.h>

namespace mtn {

const char MAGIC[] = "OMTN";
const size_t MAGIC_SIZE = 4;

const unsigned NUMBER_OF_SECTIONS = 4;
const unsigned MAJOR_VERSION = 1;
const unsigned MINOR_VERSION = 2;

const size_t SECTION_HEADER_SIZE = 8;  ///< number and size
const size_t FIRST_SECTION_SIZE = 24;  ///< section 0, which has no texts
const size_t VALUE_SIZE = 4;           ///< of each number in a key frame
const int VALUES_OF_BODY = 3;          ///< roll, pitch, yaw

/// Largest motion file, in bytes. With its name, it fits into one request of version 2 of the protocol, 64 KiB.
const size_t MAX_FILE_SIZE = 64000;

/// Most joints in a motion. An ERS-210 has 20, including its ears.
const int MAX_JOINTS = 32;

/// Longest locator. Those of an ERS-7 have up to 29 characters.
const size_t MAX_LOCATOR_SIZE = 63;

/// Longest text.
const size_t MAX_TEXT_SIZE = 255;

/// Milliseconds per frame. Most motions use 16; the robot's own frame has 8.
const int MIN_FRAME_MILLISECONDS = 8;
const int MAX_FRAME_MILLISECONDS = 1000;

/// Longest time from one key frame to the next, in milliseconds. Anything longer is a mistake.
const int MAX_STEP_MILLISECONDS = 60000;

/// A position is within one turn to either side, in microradian.
const int MAX_POSITION = 6283185;

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_LAYOUT_H
