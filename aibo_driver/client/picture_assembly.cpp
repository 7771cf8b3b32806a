#include "client/picture_assembly.h"

#include <algorithm>
#include <utility>

namespace aibo_client {

namespace version2 = protocol::version2;

PictureAssembly::Result PictureAssembly::add(const version2::PictureDatagram& datagram, const unsigned char* bytes,
                                             TimePoint now, std::optional<Whole>* whole) {
  Incomplete* const picture = find(datagram, now);
  if (picture == nullptr || picture->jpeg.size() != datagram.jpeg_size ||
      picture->header.frame_number != datagram.image.frame_number) {
    return picture == nullptr ? Result::kUseless : Result::kContradiction;
  }
  if (!take(datagram, bytes, *picture)) {
    return Result::kUseless;
  }
  repair(*picture, datagram.part / version2::PARTS_PER_PARITY);
  if (picture->missing == 0) {
    *whole = Whole{datagram.picture, picture->header, std::move(picture->jpeg), picture->began};
    incomplete_.erase(datagram.picture);
    far_ahead_.erase(datagram.picture);
  }
  return Result::kTaken;
}

void PictureAssembly::settle(std::int64_t number) {
  lost_ += static_cast<std::uint64_t>(number - last_settled_ - 1);
  last_settled_ = number;
  incomplete_.erase(incomplete_.begin(), incomplete_.upper_bound(number));
  far_ahead_.clear();
  given_up_in_a_row_ = 0;
}

/// @return false if the picture already has this part or parity
bool PictureAssembly::take(const version2::PictureDatagram& datagram, const unsigned char* bytes, Incomplete& picture) {
  const std::size_t part = datagram.part;
  const std::size_t size = version2::sizeOfPart(datagram.jpeg_size, part);
  if (datagram.is_parity) {
    std::vector<std::uint8_t>& parity = picture.parities[part / version2::PARTS_PER_PARITY];
    if (!parity.empty()) {
      return false;
    }
    parity.assign(bytes, bytes + size);
    return true;
  }
  if (picture.has_part[part]) {
    return false;
  }
  picture.has_part[part] = true;
  --picture.missing;
  std::copy_n(bytes, size, picture.jpeg.data() + part * version2::DATAGRAM_PART_SIZE);
  return true;
}

/// If a group lacks only one part, makes it from the others and their parity.
void PictureAssembly::repair(Incomplete& picture, std::size_t group) {
  const std::size_t begin = group * version2::PARTS_PER_PARITY;
  const std::size_t end = std::min(begin + version2::PARTS_PER_PARITY, picture.has_part.size());
  const auto first = picture.has_part.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = picture.has_part.begin() + static_cast<std::ptrdiff_t>(end);
  std::vector<std::uint8_t> sum = picture.parities[group];
  if (sum.empty() || std::count(first, last, false) != 1) {
    return;
  }
  const std::size_t size = picture.jpeg.size();
  for (std::size_t part = begin; part < end; ++part) {
    if (picture.has_part[part]) {
      version2::addToParity(picture.jpeg.data() + part * version2::DATAGRAM_PART_SIZE, version2::sizeOfPart(size, part),
                            sum.data());
    }
  }
  const auto lost = static_cast<std::size_t>(std::find(first, last, false) - picture.has_part.begin());
  std::copy_n(sum.begin(), version2::sizeOfPart(size, lost),
              picture.jpeg.begin() + static_cast<std::ptrdiff_t>(lost * version2::DATAGRAM_PART_SIZE));
  picture.has_part[lost] = true;
  --picture.missing;
  ++repaired_;
}

/// @return null if the picture is too late, because a newer good one has come
PictureAssembly::Incomplete* PictureAssembly::find(const version2::PictureDatagram& datagram, TimePoint now) {
  const std::int64_t number = datagram.picture;
  if (number <= last_settled_) {
    return nullptr;
  }
  std::map<std::int64_t, Incomplete>& place = isFarAhead(number) ? far_ahead_ : incomplete_;
  const auto found = place.find(number);
  if (found != place.end()) {
    return &found->second;
  }
  far_ahead_.clear();
  const std::size_t parts = version2::numberOfParts(datagram.jpeg_size);
  if (&place == &incomplete_ && incomplete_.size() == kMostIncomplete) {
    giveUpOldest();
  }
  place[number] = {datagram.image,
                   std::vector<std::uint8_t>(datagram.jpeg_size),
                   std::vector<bool>(parts),
                   std::vector<std::vector<std::uint8_t>>(version2::numberOfParities(parts)),
                   parts,
                   now};
  return &place[number];
}

// Gives up the picture that has waited longest. Pictures before it stay, because its number may be forged.
void PictureAssembly::giveUpOldest() {
  const auto began_earlier = [](const auto& a, const auto& b) { return a.second.began < b.second.began; };
  incomplete_.erase(std::min_element(incomplete_.begin(), incomplete_.end(), began_earlier));
  ++given_up_in_a_row_;
}

}  // namespace aibo_client
