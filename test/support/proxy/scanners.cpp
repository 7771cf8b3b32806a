#include "support/proxy/scanners.h"

#include <algorithm>

#include "protocol/version1.h"
#include "protocol/version2.h"

namespace test_support {

namespace version2 = protocol::version2;

std::vector<std::uint64_t> ReplyScanner::feed(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint64_t> begins;
  const std::uint8_t* const end = data + size;
  while (data < end && !lost_) {
    std::size_t taken = 1;
    if (payload_left_ > 0) {
      taken = static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, static_cast<std::size_t>(end - data)));
      takePayload(data, taken);
    } else {
      if (header_.empty() && static_cast<char>(*data) == protocol::REPLY_PICTURE) {
        begins.push_back(offset_);
      }
      header_.push_back(*data);
      if (header_.size() == headerSize()) {
        takeHeader();
      }
    }
    data += taken;
    offset_ += taken;
  }
  return begins;
}

std::size_t ReplyScanner::headerSize() const {
  if (version2_) {
    return version2::FRAME_HEADER_SIZE;
  }
  const bool picture = static_cast<char>(header_.front()) == protocol::REPLY_PICTURE;
  return picture ? protocol::PICTURE_HEADER_SIZE : protocol::VALUE_REPLY_SIZE;
}

void ReplyScanner::takeHeader() {
  const char letter = static_cast<char>(header_.front());
  in_picture_ = letter == protocol::REPLY_PICTURE;
  if (version2_) {
    payload_left_ = version2::decodeFrameHeader(header_.data()).payload_size;
  } else if (in_picture_) {
    std::size_t size = 0;
    lost_ = !protocol::decodePictureHeader(header_.data(), &size);
    payload_left_ = size;
  } else {
    lost_ = !protocol::isValueReply(letter);
    version2_ = version2::agreesToVersion2(protocol::decodeValueReply(header_.data()));
  }
  header_.clear();
}

void ReplyScanner::takePayload(const std::uint8_t* data, std::size_t size) {
  payload_left_ -= size;
  if (!in_picture_ || !on_picture_) {
    return;
  }
  payload_.insert(payload_.end(), data, data + size);
  if (payload_left_ == 0) {
    const std::size_t image_header = version2_ ? version2::IMAGE_HEADER_SIZE : 0;
    const std::size_t jpeg = std::min(image_header, payload_.size());
    on_picture_(Bytes(payload_.begin() + static_cast<std::ptrdiff_t>(jpeg), payload_.end()));
    payload_.clear();
  }
}

std::vector<Request> RequestScanner::feed(const std::uint8_t* data, std::size_t size) {
  std::vector<Request> requests;
  for (std::size_t begin = 0, taken = 0; begin < size; begin += taken) {
    if (!version2_) {
      taken = 1;
      command_.push_back(data[begin]);
      if (command_.size() == protocol::BASIC_COMMAND_SIZE) {
        const protocol::BasicGetCommand command = protocol::decodeCommand(command_.data());
        requests.push_back({command.command, command.identifier});
        version2_ = knows_version2_ && command.command == protocol::REQUEST_NEWER_VERSION;
        command_.clear();
      }
    } else if (frames_.append(data + begin, size - begin, &taken) == version2::FrameReader::FRAME_COMPLETE) {
      const version2::FrameHeader& header = frames_.header();
      const std::uint8_t* const payload = frames_.payload();
      requests.push_back(
          {header.kind, header.id, header.request_number, Bytes(payload, payload + header.payload_size), true});
    }
  }
  return requests;
}

}  // namespace test_support
