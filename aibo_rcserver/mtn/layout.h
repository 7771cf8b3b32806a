/// @file layout.h
/// The layout of a motion file. All integers are little-endian. A text is one byte for its length, then its characters.
///
///     OMTN       the four letters
///     section 0  uint32 0, uint32 size (24), uint32 number of sections (4), uint16 major version (1),
///                uint16 minor version (2), uint16 number of key frames, uint16 milliseconds per frame, uint32 reserved
///     section 1  uint32 1, uint32 size, three texts: name of the motion, its creator, design of the robot
///     section 2  uint32 2, uint32 size, uint16 number of joints, a locator for each as a text
///     section 3  uint32 3, uint32 size, uint32 type of the data (0), the key frames
///
/// A section's size includes its number and size. Texts are padded to a multiple of four bytes. A key frame is the
/// body's roll, pitch and yaw and one position for each joint, all int32 in microradians. Before every key frame but
/// the first, a uint32 counts the frames to interpolate: the key frames are (count + 1) * milliseconds per frame apart.
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
const size_t FIRST_SECTION_SIZE = 24;  ///< the size of section 0, which has no texts
const size_t VALUE_SIZE = 4;           ///< each number in a key frame
const int VALUES_OF_BODY = 3;          ///< roll, pitch, yaw

/// The largest motion file, in bytes. Together with its name, it fits into a request of version 2, 64 KiB.
const size_t MAX_FILE_SIZE = 64000;

/// The most joints in a motion. An ERS-210 has 20 with its ears.
const int MAX_JOINTS = 32;

/// The longest locator. Locators of an ERS-7 have up to 29 characters.
const size_t MAX_LOCATOR_SIZE = 63;

const size_t MAX_TEXT_SIZE = 255;

/// Milliseconds per frame. Most motions use 16; the robot's own frames take 8.
const int MIN_FRAME_MILLISECONDS = 8;
const int MAX_FRAME_MILLISECONDS = 1000;

/// The longest time between key frames, in milliseconds. A longer time is a mistake.
const int MAX_STEP_MILLISECONDS = 60000;

/// The greatest position, in microradians: one turn to either side.
const int MAX_POSITION = 6283185;

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_LAYOUT_H
