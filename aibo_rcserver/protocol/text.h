/// Texts in both versions: UTF-8 without hidden characters, and names of files on the memory stick. And texts in files
/// that people edit.
#ifndef AIBO_RCSERVER_PROTOCOL_TEXT_H
#define AIBO_RCSERVER_PROTOCOL_TEXT_H

#include <stddef.h>

namespace protocol {

/// True for well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF) without control
/// characters (U+0000..U+001F, U+007F..U+009F) and without invisible characters that change how others appear: line and
/// paragraph ends, direction marks, characters without width, tags. Such a text is safe in a log or on a terminal. An
/// empty text is plain, too.
bool isPlainText(const char* bytes, size_t size);

/// The largest size up to `limit` at which a well-formed text can be cut between characters.
size_t sizeOfWholeCharacters(const char* bytes, size_t size, size_t limit);

/// A part of other bytes, without a zero byte at its end.
struct Text {
  const char* begin;
  size_t size;
};

/// What an editor shows of a text file: without the byte order mark of UTF-8, which some editors put at the beginning,
/// and without white space and DOS' end of file (0x1a) at the end. Each reader of a file that people edit uses this.
Text textInFile(const char* bytes, size_t size);

/// The longest name, in characters: "WALK_FWD.MTN".
const size_t MAX_FILE_NAME_SIZE = 12;
const size_t MAX_MOTION_NAME_SIZE = MAX_FILE_NAME_SIZE;

/// An accepted name, or an empty one, in capital letters with a zero byte at the end.
typedef char FileName[MAX_FILE_NAME_SIZE + 1];
typedef FileName MotionName;
typedef FileName PictureName;

/// Reads the name of a motion file: one to eight characters and ".MTN". The characters are those of a memory stick:
/// letters A to Z, digits and !#$%&'()-@^_`{}~. So no name can lead out of a folder. Small letters become capitals,
/// because the memory stick does not distinguish them.
///
/// @param text any bytes, which need not end in a zero byte
/// @param[out] name unchanged if there is an error
/// @return NULL, or what is wrong, in words that a user can act on
const char* readMotionName(const char* text, size_t size, MotionName& name);

/// Does the same for a picture, whose name ends in ".JPG".
const char* readPictureName(const char* text, size_t size, PictureName& name);

/// Checks whether anybody may store a file under a name that readMotionName() accepts: Windows takes CON, COM1 and the
/// like for devices, and a name with `~` and digits at its end could replace a file with a longer name.
/// @return NULL, or what is wrong, in words that a user can act on
const char* problemOfNewMotionName(const MotionName& name);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_TEXT_H
