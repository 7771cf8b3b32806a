#include "protocol/version1.h"

#include <limits.h>
#include <string.h>

#include "protocol/big_endian.h"

namespace protocol {

namespace {

const size_t NAME_SIZE = MAX_MOTION_NAME_SIZE;
const size_t BLOCK_SIZE = 512;

void encodeUnsigned16(unsigned short value, unsigned char* out) {
  out[0] = static_cast<unsigned char>(value & 0xff);
  out[1] = static_cast<unsigned char>(value >> 8);
}

unsigned short decodeUnsigned16(const unsigned char* in) {
  return static_cast<unsigned short>(in[0] | (in[1] << 8));
}

}  // namespace

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
  encodeBigEndian32(static_cast<unsigned>(size), out + 1);
}

bool decodePictureHeader(const unsigned char* in, size_t* size) {
  *size = decodeBigEndian32(in + 1);
  return in[0] == static_cast<unsigned char>(REPLY_PICTURE) && *size > 0 && *size <= MAX_PICTURE_SIZE;
}

void encodeValue(short value, unsigned char* out) {
  encodeUnsigned16(static_cast<unsigned short>(value), out);
}

short decodeValue(const unsigned char* in) {
  const int value = decodeUnsigned16(in);
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

unsigned char ledIntensity(short value) {
  return static_cast<unsigned char>(value & 0xff);
}

void encodeFileRequest(const FileRequest& request, unsigned char* out) {
  memset(out, 0, NAME_SIZE);
  memcpy(out, request.name, strlen(request.name));
  encodeUnsigned16(request.a, out + NAME_SIZE);
  encodeUnsigned16(request.b, out + NAME_SIZE + 2);
}

FileRequest decodeFileRequest(const unsigned char* in) {
  FileRequest request;
  strncpy(request.name, reinterpret_cast<const char*>(in), NAME_SIZE);
  request.name[NAME_SIZE] = '\0';
  request.a = decodeUnsigned16(in + NAME_SIZE);
  request.b = decodeUnsigned16(in + NAME_SIZE + 2);
  return request;
}

size_t contentSize(const FileRequest& request) {
  return request.a * BLOCK_SIZE + request.b;
}

void announceContent(size_t size, FileRequest* request) {
  const size_t blocks = size / BLOCK_SIZE < USHRT_MAX ? size / BLOCK_SIZE : USHRT_MAX;
  request->a = static_cast<unsigned short>(blocks);
  request->b = static_cast<unsigned short>(size - blocks * BLOCK_SIZE);
}

unsigned char limitJpegQuality(unsigned char quality) {
  return quality > MAX_JPEG_QUALITY ? MAX_JPEG_QUALITY : quality;
}

}  // namespace protocol
