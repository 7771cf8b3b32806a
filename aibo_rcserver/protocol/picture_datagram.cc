#include "protocol/picture_datagram.h"

#include <string.h>

namespace protocol {
namespace version2 {
size_t numberOfParts(size_t jpeg_size) {
  return (jpeg_size + DATAGRAM_PART_SIZE - 1) / DATAGRAM_PART_SIZE;
}

size_t sizeOfPart(size_t jpeg_size, size_t part) {
  const size_t rest = jpeg_size - part * DATAGRAM_PART_SIZE;
  return rest < DATAGRAM_PART_SIZE ? rest : DATAGRAM_PART_SIZE;
}

const char* decodePictureDatagram(const unsigned char* bytes, size_t size, PictureDatagram* datagram) {
  Reader reader(bytes, size);
  datagram->visit(reader);
  if (reader.problem() == NULL && reader.left() != sizeOfPart(datagram->jpeg_size, datagram->part)) {
    return "the datagram does not have the size of its part";
  }
  return reader.problem();
}

void encodeTest(const DatagramOrder& order, unsigned char* out) {
  const PictureDatagram header = {0, order.first_sequence, order.first_picture, 0, ImageHeader()};
  memset(out, 0, MAX_DATAGRAM_SIZE);
  encode(header, out);
}

}  // namespace version2
}  // namespace protocol
