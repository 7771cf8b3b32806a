/// @file stick_pictures.h
/// Version 2's requests about pictures on the robot's memory stick: take one (`M`), list, fetch and delete them (`Y`).
/// Decoders and encoders follow the rules in version2.h. Names may have small letters on the wire; readPictureName()
/// turns them into capitals.
#ifndef AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H
#define AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H

#include <stddef.h>

#include "protocol/file_list.h"
#include "protocol/text.h"
#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// What `Y` asks for: its id.
enum StickPictureRequest {
  LIST_PICTURES = 1,  ///< no payload; answered by the list
  FETCH_PICTURE = 2,  ///< the name; answered by the bytes of the file, 1..MAX_STICK_PICTURE_SIZE
  DELETE_PICTURE = 3  ///< the name; the reply has no payload
};

/// Largest picture that a robot keeps or sends. It takes none that is larger.
const size_t MAX_STICK_PICTURE_SIZE = 128 * 1024;

/// Payload of `Y` to fetch or delete, and of the reply to `M`: the name.
size_t encodePictureName(const PictureName& name, unsigned char* out);  ///< at most MAX_FILE_NAME_SIZE bytes
const char* decodePictureName(const unsigned char* payload, size_t size, PictureName& name);

/// Payload of the reply to `Y` for a list: the names of the pictures.
size_t encodePictureList(const FileList& list, unsigned char* out);  ///< at most MAX_FILE_LIST_SIZE bytes
const char* decodePictureList(const unsigned char* payload, size_t size, FileList* list);

/// Checks the payload of the reply to `Y` for a file. The file itself is not checked.
const char* checkFetchedPicture(size_t size);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H
