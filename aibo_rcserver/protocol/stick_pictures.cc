#include "protocol/stick_pictures.h"

#include <string.h>

namespace protocol {
namespace version2 {

size_t encodePictureName(const PictureName& name, unsigned char* out) {
  memcpy(out, name, strlen(name));
  return strlen(name);
}

const char* decodePictureName(const unsigned char* payload, size_t size, PictureName& name) {
  return readPictureName(reinterpret_cast<const char*>(payload), size, name);
}

size_t encodePictureList(const FileList& list, unsigned char* out) {
  return encodeFileList(list, out);
}

const char* decodePictureList(const unsigned char* payload, size_t size, FileList* list) {
  return decodeFileList(readPictureName, payload, size, list);
}

const char* checkFetchedPicture(size_t size) {
  if (size == 0) {
    return "the file is empty";
  }
  return size > MAX_STICK_PICTURE_SIZE ? "the file has more than 128 KiB" : NULL;
}

}  // namespace version2
}  // namespace protocol
