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

PictureTaker::PictureTaker() : ticket_(0), order_(), header_() {}

bool PictureTaker::Begin(const CameraImage& image, const PictureOrder& order,
                         const protocol::version2::ImageHeader& header) {
  if (image.width > MAX_IMAGE_WIDTH || image.height > MAX_IMAGE_HEIGHT) {
    return false;
  }
  ticket_ = jobs_.NewTicket();
  order_ = order;
  header_ = header;
  PictureJob* const job = jobs_.Memory();
  job->ticket = ticket_;
  job->quality = order.quality;
  job->width = image.width;
  job->height = image.height;
  CopyRows(image, job->pixels);
  jobs_.Send();
  return true;
}

bool PictureTaker::Take(const EncodedPicture& picture) {
  if (picture.ticket != ticket_) {
    return false;
  }
  ticket_ = 0;
  return true;
}
