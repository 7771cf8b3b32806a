#include "rcserver/camera/PictureTaker.h"

#include <string.h>

namespace {

void CopyRows(const CameraImage& image, unsigned char* out) {
  for (size_t row = 0; row < image.height; ++row) {
    const size_t begin = row * image.stride;
    memcpy(out, image.y + begin, image.width);
    memcpy(out + image.width, image.cr + begin, image.width);
    memcpy(out + 2 * image.width, image.cb + begin, image.width);
    out += 3 * image.width;
  }
}

}  // namespace

PictureTaker::PictureTaker()
    : is_waiting_(false), waiting_order_(), waiting_header_(), ticket_(0), order_(), header_() {}

bool PictureTaker::Offer(const CameraImage& image, const PictureOrder& order,
                         const protocol::version2::ImageHeader& header) {
  if (image.width > MAX_IMAGE_WIDTH || image.height > MAX_IMAGE_HEIGHT) {
    return false;
  }
  PictureJob* const job = jobs_.Memory();
  job->quality = order.quality;
  job->width = image.width;
  job->height = image.height;
  CopyRows(image, job->pixels);
  is_waiting_ = true;
  waiting_order_ = order;
  waiting_header_ = header;
  return true;
}

void PictureTaker::Begin() {
  is_waiting_ = false;
  order_ = waiting_order_;
  header_ = waiting_header_;
  ticket_ = jobs_.NewTicket();
  jobs_.Memory()->ticket = ticket_;
  jobs_.Send();
}

bool PictureTaker::Take(const EncodedPicture& picture) {
  if (picture.ticket != ticket_) {
    return false;
  }
  ticket_ = 0;
  return true;
}
