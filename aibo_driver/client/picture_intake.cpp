#include "client/picture_intake.h"

#include <algorithm>
#include <utility>

#include "aibo_client/jpeg_inspector.h"
#include "client/fault.h"

namespace aibo_client {

PictureIntake::PictureIntake(const ConnectionContext& context, TimePoint connected)
    : context_(context), stall_detector_(connected), off_since_(connected), last_sign_(connected) {}

void PictureIntake::streamRequested(bool on, int quality, TimePoint now, const StreamFormat& format) {
  quality_ = quality;
  if (format != std::exchange(format_, format)) {
    signOfPicture(now);  // the time to wait for the next picture begins again
  }
  if (on == std::exchange(streaming_, on)) {
    return;
  }
  stall_detector_.restart(now);
  signOfPicture(now);
  if (!on) {
    off_since_ = now;
  }
}

void PictureIntake::bytesArrived(TimePoint now) {
  if (streaming_) {
    stall_detector_.bytesArrived(now);
  }
}

std::shared_ptr<Picture> PictureIntake::inspect(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time) {
  const JpegInspection inspection = inspectJpeg(jpeg.data(), jpeg.size());
  last_is_damaged_ = !inspection.good();
  if (last_is_damaged_) {
    ++context_.counters.corrupt_pictures;
    if (inspection.problem != std::exchange(last_damage_, inspection.problem)) {
      context_.warn("sent a damaged picture, which is dropped: " + inspection.problem);
    }
    return nullptr;
  }
  auto picture = std::make_shared<Picture>();
  picture->jpeg = std::move(jpeg);
  picture->first_byte_time = last_first_byte_ = std::max(first_byte_time, last_first_byte_ + TimePoint::duration(1));
  picture->width = inspection.width;
  picture->height = inspection.height;
  picture->connection_number = context_.number;
  return picture;
}

void PictureIntake::deliver(const PicturePtr& picture) {
  ++context_.counters.pictures;
  context_.notifier.tell(&Callbacks::on_picture, "on_picture", picture);
}

bool PictureIntake::deliverFromStream(const PicturePtr& picture, TimePoint now) {
  if (!streaming_) {
    ++context_.counters.unexpected_pictures;
    if (now - off_since_ > kStopTime) {
      throw ProtocolException("it sends pictures although it was told to stop, or was never asked for any");
    }
    return false;
  }
  if (stall_detector_.isStale(picture->first_byte_time)) {
    ++context_.counters.stale_pictures;
    return false;
  }
  deliver(picture);
  return true;
}

std::string PictureIntake::damageRemark() const {
  return last_is_damaged_ ? "; the last one was damaged: " + last_damage_ + "." : ".";
}

}  // namespace aibo_client
