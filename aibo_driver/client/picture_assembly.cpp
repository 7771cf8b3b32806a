#include "client/picture_assembly.h"

#include <algorithm>
#include <utility>

namespace aibo_client {

namespace version2 = protocol::version2;

bool PictureAssembly::add(const version2::PictureDatagram& datagram, const unsigned char* bytes, TimePoint now) {
  if (datagram.picture <= last_settled_) {
    return true;
  }
  Begun& picture = findOrBegin(datagram, now);
  if (picture.jpeg.size() != datagram.jpeg_size || picture.header.frame_number != datagram.image.frame_number) {
    return false;
  }
  const std::size_t part = datagram.part;
  picture.sent = std::max(picture.sent, part + 1);
  if (!picture.has_part[part]) {
    picture.has_part[part] = true;
    --picture.missing;
    std::copy_n(bytes, version2::sizeOfPart(datagram.jpeg_size, part),
                picture.jpeg.data() + part * version2::DATAGRAM_PART_SIZE);
  }
  return true;
}

std::optional<PictureAssembly::Begun> PictureAssembly::takeWhole() {
  const auto oldest =
      std::find_if(begun_.begin(), begun_.end(), [](const auto& each) { return each.second.missing == 0; });
  return oldest == begun_.end() ? std::nullopt : std::optional<Begun>(std::move(begun_.extract(oldest).mapped()));
}

/// The oldest picture that is not settled and that the robot can still repeat.
std::int64_t PictureAssembly::nextWanted() const {
  return std::max(last_settled_ + 1, newest_ + 1 - std::int64_t{version2::KEPT_PICTURES});
}

version2::DatagramStatus PictureAssembly::status(bool all_sent) const {
  const std::int64_t number = nextWanted();
  const bool has_newer = newest_ > number;
  version2::DatagramStatus status = {0, static_cast<unsigned>(number), 0};
  const auto found = begun_.find(number);
  if (found == begun_.end()) {
    status.missing = has_newer ? ~0U : 0;  // no part of this picture has come
    return status;
  }
  const Begun& picture = found->second;
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
  begun_.erase(begun_.begin(), begun_.upper_bound(number));
  given_up_in_a_row_ = 0;
}

PictureAssembly::Begun& PictureAssembly::findOrBegin(const version2::PictureDatagram& datagram, TimePoint now) {
  const std::int64_t number = datagram.picture;
  if (const auto found = begun_.find(number); found != begun_.end()) {
    return found->second;
  }
  if (begun_.size() == version2::KEPT_PICTURES) {
    giveUpOldest();
  }
  newest_ = std::max(newest_, number);
  const std::size_t parts = version2::numberOfParts(datagram.jpeg_size);
  Begun begun = {number, datagram.image, std::vector<std::uint8_t>(datagram.jpeg_size), std::vector<bool>(parts), parts,
                 now};
  return begun_.emplace(number, std::move(begun)).first->second;
}

// Gives up the picture that has waited longest. Pictures before it stay, because its number may be forged.
void PictureAssembly::giveUpOldest() {
  const auto began_earlier = [](const auto& a, const auto& b) { return a.second.began < b.second.began; };
  begun_.erase(std::min_element(begun_.begin(), begun_.end(), began_earlier));
  ++given_up_in_a_row_;
}

}  // namespace aibo_client
