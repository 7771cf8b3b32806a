#include "protocol/version2.h"

namespace protocol {
namespace version2 {

namespace {

const char REPLY_NEWER_VERSION = 'x';

}  // namespace

const char TOO_MANY_JOINTS[] = "more joints than any robot has";
const char JOINT_TWICE[] = "a joint is named twice";

BasicGetCommand versionRequest() {
  const BasicGetCommand request = {REQUEST_NEWER_VERSION, VERSION};
  return request;
}

ValueReply versionReply() {
  const ValueReply reply = {REPLY_NEWER_VERSION, VERSION, 0};
  return reply;
}

bool agreesToVersion2(const ValueReply& reply) {
  return reply.letter == REPLY_NEWER_VERSION && reply.identifier == VERSION && reply.value == 0;
}

FrameHeader decodeFrameHeader(const unsigned char* in) {
  FrameHeader header;
  decode(in, FRAME_HEADER_SIZE, &header);
  return header;
}

bool isTooOld(unsigned not_after, unsigned present) {
  return not_after != NEVER_TOO_OLD && static_cast<int>(present - not_after) > 0;
}

unsigned notAfter(unsigned present, int frames) {
  const unsigned frame = present + static_cast<unsigned>(frames);
  return frame == NEVER_TOO_OLD ? 0 : frame;
}

char replyKind(char request_kind) {
  return static_cast<char>(request_kind - 'A' + 'a');
}

bool isError(char kind, size_t payload_size) {
  return kind == ERROR_MESSAGE && payload_size > 0;
}

}  // namespace version2
}  // namespace protocol
