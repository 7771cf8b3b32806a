/// Pictures by UDP in version 2: the request `B` and its datagrams.
///
/// A picture is sent in parts of DATAGRAM_PART_SIZE bytes; the last part has the rest. Each part is a datagram with a
/// header that describes the whole picture, so a receiver can begin with any part, and can ask for parts again.
#ifndef AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H
#define AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Payload of `B` and its reply. The client chooses the first numbers at random, so that nobody else knows the numbers
/// of the datagrams.
struct DatagramOrder {
  unsigned short port;  ///< 0: no datagrams
  bool is_test;
  unsigned first_sequence;
  unsigned first_picture;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(port);
    fields.flag(is_test, "the byte after the port is not 0 (pictures) or 1 (a test)");
    fields.zeros(1);
    fields.number(first_sequence);
    fields.number(first_picture);
  }
};

/// How many pictures have parts that the robot can repeat: the last ones that it has begun to send.
const unsigned KEPT_PICTURES = 3;

const Request SEND_DATAGRAMS = {REQUEST_DATAGRAMS, "send its pictures by UDP", 0, NULL};

const size_t DATAGRAM_HEADER_SIZE = 16 + IMAGE_HEADER_SIZE;

/// With the headers of IP and UDP, the packet has 1400 bytes, which no network or tunnel has to split. Sony's IPStack
/// is said to crash on datagrams of more than some 19 KB.
const size_t MAX_DATAGRAM_SIZE = 1372;

/// The size of every part but the last.
const size_t DATAGRAM_PART_SIZE = MAX_DATAGRAM_SIZE - DATAGRAM_HEADER_SIZE;

size_t numberOfParts(size_t jpeg_size);

/// @param part 0 to numberOfParts() - 1
size_t sizeOfPart(size_t jpeg_size, size_t part);

/// The first byte of a datagram.
const char DATAGRAM_MARK = 'b';

/// The header of a part, DATAGRAM_HEADER_SIZE bytes.
struct PictureDatagram {
  unsigned short part;  ///< index in the picture, from 0
  unsigned sequence;    ///< counts datagrams, from the number in `B` on
  unsigned picture;     ///< counts pictures, from the number in `B` on
  unsigned jpeg_size;   ///< size of the whole picture, 1..MAX_JPEG_SIZE
  ImageHeader image;

  template <typename Fields>
  void visit(Fields& fields) {
    char mark = DATAGRAM_MARK;
    fields.number(mark);
    fields.require(mark == DATAGRAM_MARK, "the datagram does not begin like a part of a picture");
    fields.zeros(1);
    fields.number(part);
    fields.number(sequence);
    fields.number(picture);
    fields.number(jpeg_size);
    fields.require(jpeg_size > 0 && jpeg_size <= MAX_JPEG_SIZE, "the picture in the datagram is empty or too large");
    fields.require(part < numberOfParts(jpeg_size), "the picture in the datagram does not have that many parts");
    fields.item(image);
  }
};

/// Decodes a datagram and checks its size. The part begins at bytes + DATAGRAM_HEADER_SIZE.
const char* decodePictureDatagram(const unsigned char* bytes, size_t size, PictureDatagram* datagram);

/// A receiver sends this status when a picture is complete or parts are missing.
struct DatagramStatus {
  /// How many parts one status can ask for.
  static const unsigned MOST_MISSING = 32;

  unsigned short first_part;
  unsigned picture;  ///< all pictures before it are complete or not wanted any more
  unsigned missing;  ///< bit i: part first_part + i of this picture has to be repeated

  template <typename Fields>
  void visit(Fields& fields) {
    char mark = 's';
    fields.number(mark);
    fields.require(mark == 's', "the datagram is not a status");
    fields.zeros(1);
    fields.number(first_part);
    fields.number(picture);
    fields.number(missing);
  }
};

const size_t DATAGRAM_STATUS_SIZE = 12;

/// Writes the datagram that answers a `B` that is only a test. The datagram begins like a part, with the first numbers
/// of the order, and the rest is 0. It is as large as a datagram can be, so that it gets through only where datagrams
/// of pictures do.
/// @param[out] out room for MAX_DATAGRAM_SIZE bytes, which are all written
void encodeTest(const DatagramOrder& order, unsigned char* out);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H
