#include "simulator/sent_pictures.h"

#include <algorithm>
#include <utility>

#include "protocol/picture_datagram.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

namespace {

struct Header {
  std::size_t size;  ///< 0 if this is not a picture
  std::size_t jpeg_size;
};

Header readVersion1(const unsigned char* bytes, std::size_t size) {
  Header header = {protocol::PICTURE_HEADER_SIZE, 0};
  if (size < header.size || !protocol::decodePictureHeader(bytes, &header.jpeg_size)) {
    return {};
  }
  return header;
}

Header readVersion2(const unsigned char* bytes, std::size_t size) {
  using namespace protocol::version2;
  if (size < FRAME_HEADER_SIZE + IMAGE_HEADER_SIZE) {
    return {};
  }
  const FrameHeader frame = decodeFrameHeader(bytes);
  if (frame.kind != PICTURE || frame.payload_size <= IMAGE_HEADER_SIZE) {
    return {};
  }
  return {FRAME_HEADER_SIZE + IMAGE_HEADER_SIZE, frame.payload_size - IMAGE_HEADER_SIZE};
}

bool isJpegBehind(const Header& header, const unsigned char* bytes, std::size_t size) {
  const unsigned char start[] = {0xFF, 0xD8, 0xFF};
  return header.size > 0 && size >= header.size + sizeof(start) &&
         std::equal(std::begin(start), std::end(start), bytes + header.size);
}

}  // namespace

bool SentPictures::add(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  const bool follows = bytes == std::exchange(next_, bytes + size);
  is_redundant_ = false;
  if (size > 0 && bytes[0] == protocol::version2::DATAGRAM_MARK && addDatagram(bytes, size)) {
    return !is_redundant_ && jpeg_.size() == size - protocol::version2::DATAGRAM_HEADER_SIZE;
  }
  const bool goes_on = follows && jpeg_.size() < jpeg_size_;
  const bool begins = !goes_on && begin(bytes, size);
  if (goes_on) {
    jpeg_.append(bytes, bytes + std::min(size, jpeg_size_ - jpeg_.size()));
  }
  return begins;
}

// False if this is not a picture. The robot sends a picture's parts in order, and repeats parts of the last pictures
// between them. The sequence does not go on if another client has asked for datagrams.
bool SentPictures::addDatagram(const unsigned char* bytes, std::size_t size) {
  using namespace protocol::version2;
  PictureDatagram datagram = {};
  if (decodePictureDatagram(bytes, size, &datagram) != nullptr) {
    return false;
  }
  const bool goes_on = std::exchange(next_sequence_, datagram.sequence + 1) == datagram.sequence;
  const bool is_next = datagram.picture == picture_ && datagram.part * DATAGRAM_PART_SIZE == jpeg_.size();
  is_redundant_ = datagram.is_parity || (goes_on && !is_next && picture_ - datagram.picture < KEPT_PICTURES);
  if (is_redundant_) {
    return true;
  }
  if (datagram.part == 0) {
    jpeg_.clear();
  }
  picture_ = datagram.picture;
  jpeg_size_ = datagram.jpeg_size;
  jpeg_.append(bytes + DATAGRAM_HEADER_SIZE, bytes + size);
  return true;
}

bool SentPictures::begin(const unsigned char* bytes, std::size_t size) {
  for (const Header& header : {readVersion1(bytes, size), readVersion2(bytes, size)}) {
    if (isJpegBehind(header, bytes, size)) {
      jpeg_size_ = header.jpeg_size;
      jpeg_.assign(bytes + header.size, bytes + std::min(size, header.size + jpeg_size_));
      return true;
    }
  }
  jpeg_size_ = 0;
  return false;
}
