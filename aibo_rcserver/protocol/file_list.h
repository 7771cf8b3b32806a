/// @file file_list.h
/// The names of files on the memory stick, as version 2 lists them: those of motions or of pictures.
#ifndef AIBO_RCSERVER_PROTOCOL_FILE_LIST_H
#define AIBO_RCSERVER_PROTOCOL_FILE_LIST_H

#include <stddef.h>

#include "protocol/text.h"

namespace protocol {
namespace version2 {

/// Most files in one list. A robot that has more lists this many.
const size_t MAX_LISTED_FILES = 256;

/// Names of files of one kind.
struct FileList {
  size_t count;  ///< of names, 0..MAX_LISTED_FILES
  FileName names[MAX_LISTED_FILES];
};

const size_t MAX_FILE_LIST_SIZE = MAX_LISTED_FILES * (MAX_FILE_NAME_SIZE + 1) - 1;

/// Writes the names, separated by newlines.
/// @param out room for MAX_FILE_LIST_SIZE bytes
size_t encodeFileList(const FileList& list, unsigned char* out);

/// readMotionName() or readPictureName().
typedef const char* (*ReadFileName)(const char* text, size_t size, FileName& name);

/// @param read decides which names are accepted
/// @param[out] list undefined if the result is not NULL
/// @return NULL, or what is wrong
const char* decodeFileList(ReadFileName read, const unsigned char* payload, size_t size, FileList* list);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FILE_LIST_H
