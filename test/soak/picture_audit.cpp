#include "picture_audit.h"

#include <algorithm>
#include <boost/crc.hpp>

namespace soak {
namespace {

// About a minute and a half of pictures. An older one counts as never sent.
constexpr std::size_t kSentKept = 3000;

std::uint32_t checksumOf(const std::uint8_t* bytes, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes, size);
  return crc.checksum();
}

}  // namespace

void PictureAudit::sent(const std::uint8_t* jpeg, std::size_t size) {
  sent_.push_back({++last_sent_, size, checksumOf(jpeg, size)});
  if (sent_.size() > kSentKept) {
    sent_.pop_front();
  }
}

void PictureAudit::published(const std::vector<std::uint8_t>& jpeg, std::uint64_t stamp) {
  ++count_;
  if (stamp <= last_stamp_) {
    complain_("a picture's stamp is not later than the last one's");
  }
  last_stamp_ = stamp;
  const std::uint32_t checksum = checksumOf(jpeg.data(), jpeg.size());
  // Of several equal pictures, the one that was sent last.
  const auto picture = std::find_if(sent_.rbegin(), sent_.rend(), [&](const Sent& sent) {
    return sent.bytes == jpeg.size() && sent.checksum == checksum;
  });
  if (picture == sent_.rend()) {
    complain_("a picture that the robot has not sent, of " + std::to_string(jpeg.size()) + " bytes");
    return;
  }
  if (picture->number <= last_published_) {
    complain_("picture " + std::to_string(picture->number) + " after picture " + std::to_string(last_published_));
    return;
  }
  calm_count_ += calm_ ? 1 : 0;
  lost_in_calm_ += calm_ ? picture->number - last_published_ - 1 : 0;
  last_published_ = picture->number;
}

}  // namespace soak
