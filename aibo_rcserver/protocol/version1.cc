#include "protocol/version1.h"

#include <string.h>

namespace protocol {

void encodeCommand(const BasicGetCommand& command, unsigned char* out) {
  out[0] = static_cast<unsigned char>(command.command);
  out[1] = command.identifier;
}

BasicGetCommand decodeCommand(const unsigned char* in) {
  BasicGetCommand command;
  command.command = static_cast<char>(in[0]);
  command.identifier = in[1];
  return command;
}

void encodePictureHeader(size_t size, unsigned char* out) {
  out[0] = static_cast<unsigned char>(REPLY_PICTURE);
  out[1] = static_cast<unsigned char>((size >> 24) & 0xff);
  out[2] = static_cast<unsigned char>((size >> 16) & 0xff);
  out[3] = static_cast<unsigned char>((size >> 8) & 0xff);
  out[4] = static_cast<unsigned char>(size & 0xff);
}

bool decodePictureHeader(const unsigned char* in, size_t* size) {
  *size = (static_cast<size_t>(in[1]) << 24) | (static_cast<size_t>(in[2]) << 16) | (static_cast<size_t>(in[3]) << 8) |
          static_cast<size_t>(in[4]);
  return in[0] == static_cast<unsigned char>(REPLY_PICTURE) && *size > 0 && *size <= MAX_PICTURE_SIZE;
}

void encodeValue(short value, unsigned char* out) {
  const unsigned bits = static_cast<unsigned short>(value);
  out[0] = static_cast<unsigned char>(bits & 0xff);
  out[1] = static_cast<unsigned char>(bits >> 8);
}

short decodeValue(const unsigned char* in) {
  const int value = in[0] | (in[1] << 8);
  return static_cast<short>(value >= 0x8000 ? value - 0x10000 : value);
}

void encodeValueReply(const ValueReply& reply, unsigned char* out) {
  out[0] = static_cast<unsigned char>(reply.letter);
  out[1] = reply.identifier;
  encodeValue(reply.value, out + 2);
}

ValueReply decodeValueReply(const unsigned char* in) {
  ValueReply reply;
  reply.letter = static_cast<char>(in[0]);
  reply.identifier = in[1];
  reply.value = decodeValue(in + 2);
  return reply;
}

bool isValueReply(char letter) {
  return letter != '\0' && strchr("jsvalykqrudpcex", letter) != NULL;
}

unsigned char limitJpegQuality(unsigned char quality) {
  return quality > MAX_JPEG_QUALITY ? MAX_JPEG_QUALITY : quality;
}

}  // namespace protocol
