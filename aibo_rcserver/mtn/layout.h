/// @file layout.h
/// How a motion file is laid out. All integers are little-endian; a text is one byte with its length, then its
/// characters.
///
/// | part | content |
/// |---|---|
/// | | the four letters OMTN |
/// | section 0 | uint32 0, uint32 size (24), uint32 number of sections (4), uint16 major version (1), uint16 minor
/// version (2), uint16 number of key frames, uint16 milliseconds a frame, uint32 reserved | | section 1 | uint32 1,
/// uint32 size, three texts: name of the motion, who made it, design of the robot | | section 2 | uint32 2, uint32
/// size, uint16 number of joints, a locator for each, as a text | | section 3 | uint32 3, uint32 size, uint32 type of
/// the data (0), the key frames |
///
/// The size of a section is that of all of it, its number and its size included; texts are padded to a multiple of
/// four bytes. A key frame is roll, pitch and yaw of the body and then one position a joint, each an int32 in
/// microradian. Before each of them but the first stands, as uint32, how many frames are to be interpolated between it
/// and the one before: it is reached (that number + 1) * milliseconds a frame later.
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
const size_t VALUE_SIZE = 4;           ///< of the numbers in a key frame
const int VALUES_OF_BODY = 3;          ///< roll, pitch, yaw

/// Largest motion file, in bytes: what version 2 of the protocol can carry in one request of 64 KiB, with its name.
const size_t MAX_FILE_SIZE = 64000;

/// Most joints of a motion. An ERS-210 has 20, its ears included.
const int MAX_JOINTS = 32;

/// Longest locator. Those of an ERS-7 have up to 29 characters.
const size_t MAX_LOCATOR_SIZE = 63;

/// Longest text.
const size_t MAX_TEXT_SIZE = 255;

/// Milliseconds a frame. Motions are made with 16; the robot's own frame has 8.
const int MIN_FRAME_MILLISECONDS = 8;
const int MAX_FRAME_MILLISECONDS = 1000;

/// Longest time from one key frame to the next, in milliseconds: a minute is longer than anybody means.
const int MAX_STEP_MILLISECONDS = 60000;

/// A position is within one turn to either side, in microradian.
const int MAX_POSITION = 6283185;

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_LAYOUT_H
