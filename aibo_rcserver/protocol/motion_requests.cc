#include "protocol/motion_requests.h"

#include <string.h>

#include "protocol/big_endian.h"

namespace protocol {
namespace version2 {

namespace {

const size_t NAME_SIZE_SIZE = 1;
const size_t REPETITIONS_SIZE = 2;

const char* textOf(const unsigned char* bytes) {
  return reinterpret_cast<const char*>(bytes);
}

}  // namespace

size_t encodeMotionUpload(const MotionUpload& upload, unsigned char* out) {
  const size_t name_size = strlen(upload.name);
  out[0] = static_cast<unsigned char>(name_size);
  memcpy(out + NAME_SIZE_SIZE, upload.name, name_size);
  memcpy(out + NAME_SIZE_SIZE + name_size, upload.content, upload.content_size);
  return NAME_SIZE_SIZE + name_size + upload.content_size;
}

const char* decodeMotionUpload(const unsigned char* payload, size_t size, MotionUpload* upload) {
  if (size < NAME_SIZE_SIZE || size < NAME_SIZE_SIZE + payload[0]) {
    return "the name of the motion does not fit into the payload";
  }
  const size_t content_offset = NAME_SIZE_SIZE + payload[0];
  if (size == content_offset) {
    return "there is no motion after its name";
  }
  if (const char* problem = readMotionName(textOf(payload + NAME_SIZE_SIZE), payload[0], upload->name)) {
    return problem;
  }
  upload->content = payload + content_offset;
  upload->content_size = size - content_offset;
  return NULL;
}

size_t encodeMotionName(const MotionName& name, unsigned char* out) {
  memcpy(out, name, strlen(name));
  return strlen(name);
}

const char* decodeMotionName(const unsigned char* payload, size_t size, MotionName& name) {
  return readMotionName(textOf(payload), size, name);
}

size_t encodeMotionOrder(const MotionOrder& order, unsigned char* out) {
  encodeBigEndian16(order.repetitions, out);
  return REPETITIONS_SIZE + encodeMotionName(order.name, out + REPETITIONS_SIZE);
}

const char* decodeMotionOrder(const unsigned char* payload, size_t size, MotionOrder* order) {
  if (size < REPETITIONS_SIZE) {
    return "the payload does not have the size that this kind of frame has";
  }
  const unsigned short repetitions = decodeBigEndian16(payload);
  if (repetitions == 0 && size == REPETITIONS_SIZE) {
    order->repetitions = 0;
    order->name[0] = '\0';
    return NULL;
  }
  const char* problem = decodeMotionName(payload + REPETITIONS_SIZE, size - REPETITIONS_SIZE, order->name);
  if (problem == NULL) {
    order->repetitions = repetitions;
  }
  return problem;
}

size_t encodeMotionChanges(const MotionChanges& changes, unsigned char* out) {
  memcpy(out, changes.text, changes.text_size);
  return changes.text_size;
}

const char* decodeMotionChanges(const unsigned char* payload, size_t size, MotionChanges* changes) {
  if (size > MAX_MOTION_CHANGES_SIZE) {
    return "the text is too long";
  }
  if (!isPlainText(textOf(payload), size)) {
    return "the text is not plain UTF-8";
  }
  changes->text = textOf(payload);
  changes->text_size = size;
  return NULL;
}

size_t encodeMotionList(const FileList& list, unsigned char* out) {
  return encodeFileList(list, out);
}

const char* decodeMotionList(const unsigned char* payload, size_t size, FileList* list) {
  return decodeFileList(readMotionName, payload, size, list);
}

}  // namespace version2
}  // namespace protocol
