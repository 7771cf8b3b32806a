#include "client/picture_assembly.h"

#include <algorithm>
#include <utility>

namespace aibo_client {

namespace version2 = protocol::version2;

PictureAssembly::Result PictureAssembly::add(const version2::PictureDatagram& datagram, const unsigned char* bytes,
                                             TimePoint now) {
  Incomplete* const picture = find(datagram, now);
  if (picture == nullptr || picture->jpeg.size() != datagram.jpeg_size ||
      picture->header.frame_number != datagram.image.frame_number) {
    return picture == nullptr ? Result::kUseless : Result::kContradiction;
  }
  if (!take(datagram, bytes, *picture)) {
    return Result::kUseless;
  }
  if (picture->missing == 0) {
    picture->completed = now;
  }
  return Result::kTaken;
}

std::optional<PictureAssembly::Whole> PictureAssembly::takeWhole(TimePoint now, TimePoint::duration patience) {
  const auto oldest =
      std::find_if(incomplete_.begin(), incomplete_.end(), [](const auto& each) { return each.second.missing == 0; });
  if (oldest == incomplete_.end() || (oldest->first > nextWanted() && now < oldest->second.completed + patience)) {
    return std::nullopt;
  }
  Whole whole = {oldest->first, oldest->second.header, std::move(oldest->second.jpeg), oldest->second.began};
  incomplete_.erase(oldest);
  return whole;
}

PictureAssembly::TimePoint PictureAssembly::endOfWaiting(TimePoint::duration patience) const {
  TimePoint end = TimePoint::max();
  for (const auto& [number, picture] : incomplete_) {
    end = picture.missing == 0 ? std::min(end, picture.completed + patience) : end;
  }
  return end;
}

/// The oldest picture that is not settled and that the robot can still repeat.
std::int64_t PictureAssembly::nextWanted() const {
  return std::max(last_settled_ + 1, newest_ + 1 - std::int64_t{version2::KEPT_PICTURES});
}

version2::DatagramStatus PictureAssembly::status(bool all_sent) const {
  const std::int64_t number = nextWanted();
  const bool has_newer = newest_ > number;
  version2::DatagramStatus status = {0, static_cast<unsigned>(number), 0};
  const auto found = incomplete_.find(number);
  if (found == incomplete_.end()) {
    status.missing = has_newer ? ~0U : 0;  // no part of this picture has come
    return status;
  }
  const Incomplete& picture = found->second;
  for (std::size_t part = 0; part < picture.has_part.size(); ++part) {
    if (picture.has_part[part] || !(all_sent || has_newer || part < picture.sent)) {
      continue;
    }
    status.first_part = status.missing == 0 ? static_cast<unsigned short>(part) : status.first_part;
    const std::size_t bit = part - status.first_part;
    status.missing |= bit < version2::DatagramStatus::MOST_MISSING ? 1U << bit : 0;
  }
  return status;
}

void PictureAssembly::settle(std::int64_t number) {
  if (number <= last_settled_) {
    return;
  }
  lost_ += static_cast<std::uint64_t>(number - last_settled_ - 1);
  last_settled_ = number;
  incomplete_.erase(incomplete_.begin(), incomplete_.upper_bound(number));
  given_up_in_a_row_ = 0;
}

/// @return false if the picture already has this part
bool PictureAssembly::take(const version2::PictureDatagram& datagram, const unsigned char* bytes, Incomplete& picture) {
  const std::size_t part = datagram.part;
  picture.sent = std::max(picture.sent, part + 1);
  if (picture.has_part[part]) {
    return false;
  }
  picture.has_part[part] = true;
  --picture.missing;
  std::copy_n(bytes, version2::sizeOfPart(datagram.jpeg_size, part),
              picture.jpeg.data() + part * version2::DATAGRAM_PART_SIZE);
  return true;
}

/// @return null if the picture is too late, because a newer one has come
PictureAssembly::Incomplete* PictureAssembly::find(const version2::PictureDatagram& datagram, TimePoint now) {
  const std::int64_t number = datagram.picture;
  if (number <= last_settled_) {
    return nullptr;
  }
  const auto found = incomplete_.find(number);
  if (found != incomplete_.end()) {
    return &found->second;
  }
  const std::size_t parts = version2::numberOfParts(datagram.jpeg_size);
  if (incomplete_.size() == version2::KEPT_PICTURES) {
    giveUpOldest();
  }
  Incomplete& picture = incomplete_[number];
  picture = {datagram.image, std::vector<std::uint8_t>(datagram.jpeg_size), std::vector<bool>(parts), parts, now};
  newest_ = std::max(newest_, number);
  return &picture;
}

// Gives up the picture that has waited longest. Pictures before it stay, because its number may be forged.
void PictureAssembly::giveUpOldest() {
  const auto began_earlier = [](const auto& a, const auto& b) { return a.second.began < b.second.began; };
  incomplete_.erase(std::min_element(incomplete_.begin(), incomplete_.end(), began_earlier));
  ++given_up_in_a_row_;
}

}  // namespace aibo_client
