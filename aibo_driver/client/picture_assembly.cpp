#include "client/picture_assembly.h"

#include <algorithm>
#include <utility>

namespace aibo_driver {

namespace version2 = protocol::version2;

PictureAssembly::Result PictureAssembly::add(const version2::PictureDatagram& datagram, const unsigned char* bytes,
                                             TimePoint now, std::optional<Whole>* whole) {
  Incomplete* const picture = find(datagram, now);
  if (picture == nullptr || picture->jpeg.size() != datagram.jpeg_size ||
      picture->header.frame_number != datagram.image.frame_number) {
    return picture == nullptr ? Result::kUseless : Result::kContradiction;
  }
  const std::size_t part = datagram.part;
  if (picture->has_part[part]) {
    return Result::kUseless;
  }
  picture->has_part[part] = true;
  std::copy_n(bytes, version2::sizeOfPart(datagram.jpeg_size, part),
              picture->jpeg.data() + part * version2::DATAGRAM_PART_SIZE);
  if (--picture->missing == 0) {
    *whole = Whole{picture->header, std::move(picture->jpeg), picture->began};
    lost_ += static_cast<std::uint64_t>(datagram.picture - last_settled_ - 1);
    last_settled_ = datagram.picture;
    incomplete_.erase(incomplete_.begin(), incomplete_.upper_bound(last_settled_));
    given_up_in_a_row_ = 0;
  }
  return Result::kTaken;
}

/// @return null if the picture has been completed or given up
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
  incomplete_[number] = {datagram.image, std::vector<std::uint8_t>(datagram.jpeg_size), std::vector<bool>(parts), parts,
                         now};
  if (incomplete_.size() > kMostIncomplete) {
    giveUpOldest();
  }
  return number <= last_settled_ ? nullptr : &incomplete_[number];
}

void PictureAssembly::giveUpOldest() {
  const std::int64_t number = incomplete_.begin()->first;
  incomplete_.erase(incomplete_.begin());
  lost_ += static_cast<std::uint64_t>(number - last_settled_);
  last_settled_ = number;
  ++given_up_in_a_row_;
}

}  // namespace aibo_driver
