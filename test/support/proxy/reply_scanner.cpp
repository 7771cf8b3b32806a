#include "support/proxy/reply_scanner.h"

#include <algorithm>

#include "protocol/version1.h"
#include "protocol/version2.h"

namespace fault_bench {

namespace version2 = protocol::version2;

std::vector<std::uint64_t> ReplyScanner::feed(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint64_t> begins;
  const std::uint8_t* const end = data + size;
  while (data < end && !lost_) {
    const auto left = static_cast<std::uint64_t>(end - data);
    if (skip_ > 0) {
      const std::uint64_t skipped = std::min(skip_, left);
      skip_ -= skipped;
      data += skipped;
      offset_ += skipped;
      continue;
    }
    if (header_.empty() && static_cast<char>(*data) == protocol::REPLY_PICTURE) {
      begins.push_back(offset_);
    }
    header_.push_back(*data++);
    ++offset_;
    if (header_.size() == headerSize()) {
      takeHeader();
    }
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
  if (version2_) {
    skip_ = version2::decodeFrameHeader(header_.data()).payload_size;
  } else if (letter == protocol::REPLY_PICTURE) {
    std::size_t size = 0;
    lost_ = !protocol::decodePictureHeader(header_.data(), &size);
    skip_ = size;
  } else {
    lost_ = !protocol::isValueReply(letter);
    version2_ = version2::agreesToVersion2(protocol::decodeValueReply(header_.data()));
  }
  header_.clear();
}

}  // namespace fault_bench
