/// @file motion_name.h
/// Names of motion files, as both versions of the protocol carry them: eight characters, a dot, three characters, as on
/// every memory stick, and the three are MTN. Used by both sides.
#ifndef AIBO_RCSERVER_PROTOCOL_MOTION_NAME_H
#define AIBO_RCSERVER_PROTOCOL_MOTION_NAME_H

#include <stddef.h>

namespace protocol {

/// Longest name of a motion, in characters: "WALK_FWD.MTN".
const size_t MAX_MOTION_NAME_SIZE = 12;

/// The name of a motion that readMotionName() has taken, or an empty one. Ends in a zero byte; capital letters.
typedef char MotionName[MAX_MOTION_NAME_SIZE + 1];

/// Reads the name of a motion. A name is one to eight of the letters A to Z, the digits and !#$%&'()-@^_`{}~, which is
/// what a memory stick takes, and then ".MTN". Small letters are taken for capitals, as by the memory stick. So no name
/// leads out of a folder.
///
/// @param text need not end in a zero byte; any bytes
/// @param[out] name the name in capital letters; untouched if it is none
/// @return what is wrong in a few words that a user can act on, or NULL
const char* readMotionName(const char* text, size_t size, MotionName& name);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_MOTION_NAME_H
