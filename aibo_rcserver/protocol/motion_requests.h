/// @file motion_requests.h
/// Version 2's requests about motions, which are files on the robot's memory stick: upload, delete, play, list.
/// Decoders and encoders follow the rules in version2.h. Names may have small letters on the wire; readMotionName()
/// turns them into capitals.
#ifndef AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H

#include <stddef.h>

#include "protocol/file_list.h"
#include "protocol/text.h"
#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Largest motion file that fits into a request beside its name.
const size_t MAX_MOTION_FILE_SIZE = MAX_PAYLOAD_TOWARDS_ROBOT - 1 - MAX_MOTION_NAME_SIZE;

/// Bits of the id of `U` and `P`. Servers before these bits ignore the id.
/// @{
const unsigned char LEAVE_OUT_MISSING_JOINTS = 1;  ///< else a motion of joints that the robot does not have is refused
const unsigned char TELL_CHANGES = 2;  ///< `P`: the reply says what is played differently; else it has no payload
/// @}

/// Payload of `U`: uint8 size of the name, the name, the bytes of the file. The reply has none.
struct MotionUpload {
  MotionName name;
  const unsigned char* content;  ///< not checked; after decoding, points into the payload
  size_t content_size;           ///< bytes, 1..MAX_MOTION_FILE_SIZE
};

/// @param out room for MAX_PAYLOAD_TOWARDS_ROBOT bytes
size_t encodeMotionUpload(const MotionUpload& upload, unsigned char* out);
const char* decodeMotionUpload(const unsigned char* payload, size_t size, MotionUpload* upload);

/// Payload of `D`: the name. The reply has none.
size_t encodeMotionName(const MotionName& name, unsigned char* out);  ///< at most MAX_MOTION_NAME_SIZE bytes
const char* decodeMotionName(const unsigned char* payload, size_t size, MotionName& name);

/// Payload of `P`: uint16 repetitions, the name. The reply has none, or, with TELL_CHANGES, the changes.
struct MotionOrder {
  unsigned short repetitions;  ///< how often to play the motion; 0 stops it
  MotionName name;             ///< empty only with 0 repetitions: stops all motions
};

const size_t MAX_MOTION_ORDER_SIZE = 2 + MAX_MOTION_NAME_SIZE;
size_t encodeMotionOrder(const MotionOrder& order, unsigned char* out);
const char* decodeMotionOrder(const unsigned char* payload, size_t size, MotionOrder* order);

/// Payload of the reply to `P` with TELL_CHANGES: what is played differently than the file says, in plain text (text.h)
/// without an end mark; empty if nothing is.
struct MotionChanges {
  const char* text;  ///< after decoding, points into the payload
  size_t text_size;  ///< bytes, 0..MAX_MOTION_CHANGES_SIZE
};

const size_t MAX_MOTION_CHANGES_SIZE = 512;
size_t encodeMotionChanges(const MotionChanges& changes, unsigned char* out);
const char* decodeMotionChanges(const unsigned char* payload, size_t size, MotionChanges* changes);

/// Payload of the reply to `N`: the names of the motions. The request has none.
size_t encodeMotionList(const FileList& list, unsigned char* out);  ///< at most MAX_FILE_LIST_SIZE bytes
const char* decodeMotionList(const unsigned char* payload, size_t size, FileList* list);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_MOTION_REQUESTS_H
