/// Lists of motions or pictures on the memory stick in version 2.
#ifndef AIBO_RCSERVER_PROTOCOL_FILE_LIST_H
#define AIBO_RCSERVER_PROTOCOL_FILE_LIST_H

#include <stddef.h>

#include "protocol/fields.h"

namespace protocol {
namespace version2 {

/// The most names in a list. A robot with more files lists only this many.
const size_t MAX_LISTED_FILES = 256;

struct FileList {
  size_t count;  ///< 0..MAX_LISTED_FILES
  FileName names[MAX_LISTED_FILES];
};

const size_t MAX_FILE_LIST_SIZE = MAX_LISTED_FILES * (MAX_FILE_NAME_SIZE + 1) - 1;

/// Writes the names, separated by newlines.
/// @param out room for MAX_FILE_LIST_SIZE bytes
size_t encodeFileList(const FileList& list, unsigned char* out);

/// @param read the function that decides which names are accepted
/// @param[out] list undefined unless the result is NULL
/// @return NULL, or what is wrong
const char* decodeFileList(ReadFileName read, const unsigned char* payload, size_t size, FileList* list);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FILE_LIST_H
