/// Version 2's requests for motion files on the robot's memory stick: upload, delete, play and list. Names on the wire
/// may have small letters; readMotionName() makes them capitals.
#ifndef AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H

#include <stddef.h>

#include "protocol/file_list.h"
#include "protocol/text.h"
#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// The largest motion file that fits into a request with its name.
const size_t MAX_MOTION_FILE_SIZE = MAX_PAYLOAD_TOWARDS_ROBOT - 1 - MAX_MOTION_NAME_SIZE;

/// Bit of the id of `U` and `P`: do not refuse a motion of joints that the robot lacks.
const unsigned char LEAVE_OUT_MISSING_JOINTS = 1;

/// How many frames (5 s) it may take to read the file of a motion. When the file has been read, the age of a `P` is
/// checked again, with this much more time. The value is our choice.
const unsigned FILE_READING_FRAMES = 625;

/// Payload of `U`. The reply has no payload.
struct MotionUpload {
  MotionName name;
  const unsigned char* content;  ///< unchecked; after decoding, points into the payload
  size_t content_size;           ///< bytes, 1..MAX_MOTION_FILE_SIZE

  template <typename Fields>
  void visit(Fields& fields) {
    fields.sizedName(readMotionName, name, "the name of the motion does not fit into the payload");
    fields.content(content, content_size);
    fields.require(content_size > 0, "there is no motion after its name");
  }
};

const Request STORE_MOTION = {REQUEST_UPLOAD, "store the motion", NEEDS_MEMORY_STICK, "ALLOW_UPLOAD"};

/// Payload of `D`. The reply has no payload.
struct MotionToDelete {
  MotionName name;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.name(readMotionName, name, false);
  }
};

const Request DELETE_MOTION = {REQUEST_DELETE, "delete the motion", NEEDS_MEMORY_STICK, "ALLOW_DELETE"};

/// Payload of `P`.
struct MotionOrder {
  unsigned not_after;          ///< frame (isTooOld()); ignored with 0 repetitions
  unsigned short repetitions;  ///< 0 stops the motion
  MotionName name;             ///< may be empty with 0 repetitions, which stops all motions

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(not_after);
    fields.number(repetitions);
    fields.name(readMotionName, name, repetitions == 0);
  }
};

const Request PLAY_MOTION = {REQUEST_PLAY, "play the motion", STARTS_MOVEMENT | TAKES_OVER_JOINTS | NEEDS_MEMORY_STICK,
                             NULL};
const Request STOP_MOTION = {REQUEST_PLAY, "stop the motion", STOPS_MOTIONS, NULL};
const Request STOP_ALL_MOTIONS = {REQUEST_PLAY, "stop all motions", STOPS_MOTIONS, NULL};

const size_t MAX_MOTION_CHANGES_SIZE = 512;

/// Payload of the reply to `P`: how playback differs from the file. Plain text (text.h), not zero-terminated, empty
/// if there is no difference.
struct MotionChanges {
  const char* text;  ///< after decoding, points into the payload
  size_t text_size;  ///< bytes, 0..MAX_MOTION_CHANGES_SIZE

  template <typename Fields>
  void visit(Fields& fields) {
    fields.text(text, text_size, MAX_MOTION_CHANGES_SIZE);
    fields.require(text_size <= MAX_MOTION_CHANGES_SIZE, "the text is too long");
  }
};

/// The request has no payload. The reply has the motions' names (file_list.h).
const Request LIST_MOTIONS = {REQUEST_LIST, "list its motions", NEEDS_MEMORY_STICK, NULL};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H
