/// Version 2's requests for pictures on the robot's memory stick: take (`M`), list, fetch and delete (`Y`). Names on
/// the wire may have small letters; readPictureName() makes them capitals.
#ifndef AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H
#define AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H

#include <stddef.h>

#include "protocol/file_list.h"
#include "protocol/text.h"
#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// The id of `Y`.
enum StickPictureRequest {
  LIST_PICTURES = 1,  ///< no payload; the reply is the list
  FETCH_PICTURE = 2,  ///< payload: the name; the reply is the content, 1..MAX_STICK_PICTURE_SIZE bytes
  DELETE_PICTURE = 3  ///< payload: the name; the reply has no payload
};

/// The largest picture that a robot keeps or sends.
const size_t MAX_STICK_PICTURE_SIZE = 128 * 1024;

/// Payload of `Y` to fetch or delete, and of the reply to `M`: the name. The reply to a list has all names
/// (file_list.h).
struct StickPicture {
  PictureName name;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.name(readPictureName, name, false);
  }
};

/// The file in the reply to `Y`.
struct FetchedPicture {
  const unsigned char* content;  ///< unchecked; after decoding, points into the payload
  size_t size;                   ///< bytes, 1..MAX_STICK_PICTURE_SIZE

  template <typename Fields>
  void visit(Fields& fields) {
    fields.content(content, size);
    fields.require(size > 0, "the file is empty");
    fields.require(size <= MAX_STICK_PICTURE_SIZE, "the file has more than 128 KiB");
  }
};

const Request SAVE_PICTURE = {REQUEST_SAVE_PICTURE, "take a picture onto its memory stick", NEEDS_MEMORY_STICK,
                              "ALLOW_PICTURES"};
const Request LIST_STICK_PICTURES = {REQUEST_PICTURES, "list the pictures on its memory stick", NEEDS_MEMORY_STICK,
                                     "ALLOW_PICTURES"};
const Request FETCH_STICK_PICTURE = {REQUEST_PICTURES, "send the picture", NEEDS_MEMORY_STICK | FETCHES_FILE,
                                     "ALLOW_PICTURES"};
const Request DELETE_STICK_PICTURE = {REQUEST_PICTURES, "delete the picture", NEEDS_MEMORY_STICK, "ALLOW_PICTURES"};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_STICK_PICTURES_H
