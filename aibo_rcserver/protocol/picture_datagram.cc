#include "protocol/picture_datagram.h"

#include "protocol/big_endian.h"

namespace protocol {
namespace version2 {
namespace {

const size_t IMAGE_HEADER_OFFSET = DATAGRAM_HEADER_SIZE - IMAGE_HEADER_SIZE;
const unsigned ACKNOWLEDGEMENT_MARK = 0x61000000U;  // 'a', 0, 0, 0
const unsigned LOSS_REPORT_MARK = 0x6c000000U;      // 'l', 0, 0, 0

}  // namespace

size_t encodeDatagramPort(unsigned short port, unsigned char* out) {
  encodeBigEndian16(port, out);
  return DATAGRAM_PORT_SIZE;
}

const char* decodeDatagramPort(const unsigned char* payload, size_t size, unsigned short* port) {
  if (size != DATAGRAM_PORT_SIZE) {
    return "the payload has the wrong size";
  }
  *port = decodeBigEndian16(payload);
  return NULL;
}

size_t numberOfParts(size_t jpeg_size) {
  return (jpeg_size + DATAGRAM_PART_SIZE - 1) / DATAGRAM_PART_SIZE;
}

size_t sizeOfPart(size_t jpeg_size, size_t part) {
  const size_t rest = jpeg_size - part * DATAGRAM_PART_SIZE;
  return rest < DATAGRAM_PART_SIZE ? rest : DATAGRAM_PART_SIZE;
}

size_t numberOfParities(size_t parts) {
  return (parts + PARTS_PER_PARITY - 1) / PARTS_PER_PARITY;
}

void addToParity(const unsigned char* part, size_t size, unsigned char* parity) {
  for (size_t i = 0; i < size; ++i) {
    parity[i] = static_cast<unsigned char>(parity[i] ^ part[i]);
  }
}

size_t encodePictureDatagram(const PictureDatagram& datagram, unsigned char* out) {
  out[0] = static_cast<unsigned char>(DATAGRAM_MARK);
  out[1] = datagram.is_parity ? 1 : 0;
  encodeBigEndian16(datagram.part, out + 2);
  encodeBigEndian32(datagram.sequence, out + 4);
  encodeBigEndian32(datagram.picture, out + 8);
  encodeBigEndian32(datagram.jpeg_size, out + 12);
  return IMAGE_HEADER_OFFSET + encodeImageHeader(datagram.image, out + IMAGE_HEADER_OFFSET);
}

const char* decodePictureDatagram(const unsigned char* bytes, size_t size, PictureDatagram* datagram) {
  if (size < DATAGRAM_HEADER_SIZE) {
    return "the datagram is shorter than its header";
  }
  if (bytes[0] != static_cast<unsigned char>(DATAGRAM_MARK) || bytes[1] > 1) {
    return "the datagram does not begin as one with a part of a picture does";
  }
  PictureDatagram decoded;
  decoded.is_parity = bytes[1] == 1;
  decoded.part = decodeBigEndian16(bytes + 2);
  decoded.sequence = decodeBigEndian32(bytes + 4);
  decoded.picture = decodeBigEndian32(bytes + 8);
  decoded.jpeg_size = decodeBigEndian32(bytes + 12);
  if (decoded.jpeg_size == 0 || decoded.jpeg_size > MAX_JPEG_SIZE) {
    return "the picture in the datagram is empty or too large";
  }
  if (decoded.part >= numberOfParts(decoded.jpeg_size)) {
    return "the picture in the datagram does not have that many parts";
  }
  if (decoded.is_parity && decoded.part % PARTS_PER_PARITY != 0) {
    return "no group of parts begins with that of the parity in the datagram";
  }
  if (size - DATAGRAM_HEADER_SIZE != sizeOfPart(decoded.jpeg_size, decoded.part)) {
    return "the datagram does not have the size of its part";
  }
  size_t part_size = 0;
  if (const char* problem =
          decodePicture(bytes + IMAGE_HEADER_OFFSET, size - IMAGE_HEADER_OFFSET, &decoded.image, &part_size)) {
    return problem;
  }
  *datagram = decoded;
  return NULL;
}

size_t encodeAcknowledgement(unsigned picture, unsigned char* out) {
  encodeBigEndian32(ACKNOWLEDGEMENT_MARK, out);
  encodeBigEndian32(picture, out + 4);
  return ACKNOWLEDGEMENT_SIZE;
}

const char* decodeAcknowledgement(const unsigned char* bytes, size_t size, unsigned* picture) {
  if (size != ACKNOWLEDGEMENT_SIZE || decodeBigEndian32(bytes) != ACKNOWLEDGEMENT_MARK) {
    return "the datagram is no acknowledgement";
  }
  *picture = decodeBigEndian32(bytes + 4);
  return NULL;
}

size_t encodeLossReport(unsigned picture, unsigned char* out) {
  encodeBigEndian32(LOSS_REPORT_MARK, out);
  encodeBigEndian32(picture, out + 4);
  return LOSS_REPORT_SIZE;
}

const char* decodeLossReport(const unsigned char* bytes, size_t size, unsigned* picture) {
  if (size != LOSS_REPORT_SIZE || decodeBigEndian32(bytes) != LOSS_REPORT_MARK) {
    return "the datagram is no report of a loss";
  }
  *picture = decodeBigEndian32(bytes + 4);
  return NULL;
}

}  // namespace version2
}  // namespace protocol
