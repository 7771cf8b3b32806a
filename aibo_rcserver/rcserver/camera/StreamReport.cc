#include "rcserver/camera/StreamReport.h"

#include <OPENR/OSyslog.h>

StreamReport::StreamReport() : is_streaming_(false), last_image_(0), pictures_(0), images_out_(0) {}

void StreamReport::Update(const ImageObserver& camera) {
  const bool is_streaming = camera.State() == IOS_CONTINUOUS;
  if (is_streaming && !is_streaming_) {
    pictures_ = 0;
    images_out_ = 0;
    OSYSPRINT(("RCServer: stream on, quality %d\n", static_cast<int>(camera.StreamQuality())));
  } else if (!is_streaming && is_streaming_) {
    OSYSPRINT(("RCServer: stream off after %lu pictures, %lu camera images left out\n", pictures_, images_out_));
  }
  is_streaming_ = is_streaming;
}

void StreamReport::PictureIsSent(unsigned image_count) {
  if (!is_streaming_) {
    return;
  }
  if (pictures_ > 0 && image_count != last_image_) {
    images_out_ += image_count - last_image_ - 1;
  }
  last_image_ = image_count;
  ++pictures_;
}
