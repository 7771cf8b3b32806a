/// @file picture_datagram.h
/// Pictures by UDP, in version 2 of the protocol: the request `B`, and the datagrams that follow it.
///
/// A picture of the stream is sent as parts of DATAGRAM_PART_SIZE bytes; the last one has the rest. Each part goes in a
/// datagram of its own, behind a header that describes the whole picture. So a receiver can begin with any part, and
/// knows from each how many there are.
///
/// If datagrams get lost, each group of PARTS_PER_PARITY parts is followed by their parity: their bytes, combined by
/// exclusive or. Of each group, any one datagram may be lost then.
#ifndef AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H
#define AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Payload of `B` and of its reply: uint16 port, 0 = no datagrams.
const size_t DATAGRAM_PORT_SIZE = 2;
size_t encodeDatagramPort(unsigned short port, unsigned char* out);
const char* decodeDatagramPort(const unsigned char* payload, size_t size, unsigned short* port);

/// What goes before a part or a parity: char `b`, uint8 0 part, 1 parity, uint16 part, uint32 sequence, uint32 picture,
/// uint32 size of the JPEG, then the image header of `f`.
struct PictureDatagram {
  bool is_parity;
  unsigned short part;  ///< of this picture, from 0; of a parity: the first part of its group
  unsigned sequence;    ///< counts datagrams, from 0 after each `B`
  unsigned picture;     ///< counts pictures, from 0 after each `B`
  unsigned jpeg_size;   ///< of the whole picture, 1..MAX_JPEG_SIZE
  ImageHeader image;
};

/// The first byte of a datagram.
const char DATAGRAM_MARK = 'b';

const size_t DATAGRAM_HEADER_SIZE = 16 + IMAGE_HEADER_SIZE;

/// With the headers of IP and UDP, 1400 bytes: no network and no tunnel has to cut such a packet. Sony's IPStack is
/// said to crash when a datagram has more than some 19 KB.
const size_t MAX_DATAGRAM_SIZE = 1372;

/// Bytes of the JPEG in every part but the last.
const size_t DATAGRAM_PART_SIZE = MAX_DATAGRAM_SIZE - DATAGRAM_HEADER_SIZE;

/// How many parts a JPEG has.
size_t numberOfParts(size_t jpeg_size);

/// How many bytes of the JPEG a part has.
/// @param part 0 to numberOfParts() - 1
size_t sizeOfPart(size_t jpeg_size, size_t part);

/// Most parts of a group with a parity; the last group of a picture may have fewer. A picture at 208x160 is one group.
const size_t PARTS_PER_PARITY = 8;

/// How many groups these parts are.
size_t numberOfParities(size_t parts);

/// Adds a part to the parity of its group. In a new parity, all bytes are 0; it is as long as the first part.
/// @param size of the part
void addToParity(const unsigned char* part, size_t size, unsigned char* parity);

/// Writes DATAGRAM_HEADER_SIZE bytes; the part of the JPEG, or the parity, follows them.
size_t encodePictureDatagram(const PictureDatagram& datagram, unsigned char* out);

/// Decodes a datagram, and checks that it has all bytes of its part or parity, which begin at
/// bytes + DATAGRAM_HEADER_SIZE.
const char* decodePictureDatagram(const unsigned char* bytes, size_t size, PictureDatagram* datagram);

/// What a receiver sends back when the last part of a picture has come, or a part of a later one: char `a`, 3 x uint8
/// 0, uint32 picture.
const size_t ACKNOWLEDGEMENT_SIZE = 8;
size_t encodeAcknowledgement(unsigned picture, unsigned char* out);
const char* decodeAcknowledgement(const unsigned char* bytes, size_t size, unsigned* picture);

/// What a receiver sends back when datagrams were lost, so that the next pictures have parities: char `l`, 3 x uint8 0,
/// uint32 picture that showed the loss.
const size_t LOSS_REPORT_SIZE = 8;
size_t encodeLossReport(unsigned picture, unsigned char* out);
const char* decodeLossReport(const unsigned char* bytes, size_t size, unsigned* picture);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_PICTURE_DATAGRAM_H
