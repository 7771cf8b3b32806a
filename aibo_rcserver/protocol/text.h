/// @file text.h
/// Texts on the wire, in both versions: UTF-8 that shows as it is, and the names of files on the memory stick. Used by
/// both sides.
#ifndef AIBO_RCSERVER_PROTOCOL_TEXT_H
#define AIBO_RCSERVER_PROTOCOL_TEXT_H

#include <stddef.h>

namespace protocol {

/// True if the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF) without
/// control characters (U+0000..U+001F, U+007F..U+009F), and without characters that are not seen but change how others
/// are shown: ends of lines and paragraphs, marks that turn the direction of writing, characters without width, tags.
/// Such a text can go into a log or onto a terminal as it is. An empty text is plain, too.
bool isPlainText(const char* bytes, size_t size);

/// The largest size, at most `limit`, to which a well-formed text can be cut without splitting a character.
size_t sizeOfWholeCharacters(const char* bytes, size_t size, size_t limit);

/// Longest name of a file, in characters: "WALK_FWD.MTN".
const size_t MAX_FILE_NAME_SIZE = 12;
const size_t MAX_MOTION_NAME_SIZE = MAX_FILE_NAME_SIZE;

/// A name that one of the functions below has accepted, or an empty one. Capital letters; ends in a zero byte.
typedef char FileName[MAX_FILE_NAME_SIZE + 1];
typedef FileName MotionName;
typedef FileName PictureName;

/// Reads the name of a motion file: one to eight characters and ".MTN". The characters are those that a memory stick
/// accepts: the letters A to Z, digits and !#$%&'()-@^_`{}~. So no name can lead out of a folder. The memory stick does
/// not distinguish small letters from capitals; here they become capitals.
///
/// @param text any bytes; need not end in a zero byte
/// @param[out] name the name in capital letters; unchanged on an error
/// @return NULL, or what is wrong in a few words that a user can act on
const char* readMotionName(const char* text, size_t size, MotionName& name);

/// The same for a picture, whose name ends in ".JPG".
const char* readPictureName(const char* text, size_t size, PictureName& name);

/// What is wrong with storing a file under a name that readMotionName() has accepted. Such names can be on a memory
/// stick, but must not be made by strangers: Windows takes CON, COM1 and their like for devices, and a name that ends
/// in `~` and digits stands for a file with a longer name, which would be replaced.
/// @return NULL, or what is wrong in a few words that a user can act on
const char* problemOfNewMotionName(const MotionName& name);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_TEXT_H
