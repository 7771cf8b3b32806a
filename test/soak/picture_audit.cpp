#include "picture_audit.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <sstream>

namespace soak {
namespace {

// About a minute and a half of pictures. An older one counts as never sent.
constexpr std::size_t kSentKept = 3000;

std::string name(std::uint64_t number) {
  return "picture " + std::to_string(number);
}

}  // namespace

void PictureAudit::sent(const std::string& line) {
  std::istringstream fields(line);
  std::int64_t nanoseconds = 0;
  Sent picture{};
  if (!(fields >> nanoseconds >> picture.bytes >> picture.checksum)) {
    return;
  }
  picture.number = ++last_sent_;
  picture.time = Time(std::chrono::duration_cast<Time::duration>(std::chrono::nanoseconds(nanoseconds)));
  sent_.push_back(picture);
  if (sent_.size() > kSentKept) {
    sent_.pop_front();
  }
}

std::vector<std::string> PictureAudit::published(const std::vector<std::uint8_t>& jpeg, std::uint64_t stamp) {
  std::vector<std::string> violations;
  ++count_;
  if (stamp <= last_stamp_) {
    violations.push_back("a picture's stamp is not later than the last one's");
  }
  last_stamp_ = stamp;
  const Sent* picture = find(jpeg);
  if (picture == nullptr && damaging_) {
    ++damaged_count_;
    return violations;
  }
  if (picture == nullptr) {
    violations.push_back("a picture that the robot has not sent, of " + std::to_string(jpeg.size()) + " bytes");
    return violations;
  }
  if (picture->number <= last_published_) {
    violations.push_back(name(picture->number) + " after " + name(last_published_));
  }
  if (calm_) {
    ++calm_count_;
    lost_in_calm_ += picture->number > last_published_ ? picture->number - last_published_ - 1 : 0;
  }
  last_published_ = std::max(last_published_, picture->number);
  last_published_time_ = picture->time;
  return violations;
}

// Of several equal pictures, the one that was sent last.
const PictureAudit::Sent* PictureAudit::find(const std::vector<std::uint8_t>& jpeg) const {
  boost::crc_32_type crc;
  crc.process_bytes(jpeg.data(), jpeg.size());
  const auto found = std::find_if(sent_.rbegin(), sent_.rend(), [&](const Sent& sent) {
    return sent.bytes == jpeg.size() && sent.checksum == crc.checksum();
  });
  return found == sent_.rend() ? nullptr : &*found;
}

}  // namespace soak
