#include "rcserver/camera/ImageObserver.h"

const size_t ImageObserver::MAX_OWED;
const char ImageObserver::TOO_MANY_OWED[] = "too many pictures are owed already; wait until some have come";

ImageObserver::ImageObserver()
    : state_(IOS_IDLE),
      has_detail_(true),
      stream_order_(),
      every_nth_image_(1),
      stream_has_begun_(false),
      last_of_stream_(0),
      oldest_owed_(0),
      number_of_owed_(0) {}

bool ImageObserver::RequestPicture(const PictureOrder& order) {
  if (number_of_owed_ == MAX_OWED) {
    return false;
  }
  PictureOrder& owed = owed_[(oldest_owed_ + number_of_owed_) % MAX_OWED];
  owed = order;
  owed.is_of_stream = false;
  ++number_of_owed_;
  if (state_ != IOS_CONTINUOUS) {
    state_ = IOS_PICTURE;
  }
  return true;
}

void ImageObserver::StartStream(const PictureOrder& order, unsigned short every_nth_image) {
  stream_order_ = order;
  stream_order_.is_of_stream = true;
  every_nth_image_ = every_nth_image;
  stream_has_begun_ = false;
  state_ = IOS_CONTINUOUS;
}

void ImageObserver::StopStream() {
  if (state_ == IOS_CONTINUOUS) {
    state_ = IOS_STOPSEND;
  }
}

bool ImageObserver::ImageArrived(unsigned image_count, PictureOrder* order) {
  switch (state_) {
    case IOS_IDLE:
      return false;
    case IOS_STOPSEND:
      state_ = number_of_owed_ > 0 ? IOS_PICTURE : IOS_IDLE;
      return false;
    case IOS_PICTURE:
      TakeOldestOwed(order);
      state_ = number_of_owed_ > 0 ? IOS_PICTURE : IOS_IDLE;
      return true;
    case IOS_CONTINUOUS:
      if (number_of_owed_ > 0) {
        TakeOldestOwed(order);
        return true;
      }
      return TakeStreamPicture(image_count, order);
  }
  return false;
}

void ImageObserver::TakeAgain(const PictureOrder& order, unsigned image_count) {
  if (order.is_of_stream) {
    last_of_stream_ = image_count;
  }
}

bool ImageObserver::Wants(const PictureOrder& order) const {
  return !order.is_of_stream ||
         (state_ == IOS_CONTINUOUS && order.quality == stream_order_.quality && order.layer == stream_order_.layer);
}

void ImageObserver::ClientGone() {
  state_ = IOS_IDLE;
  number_of_owed_ = 0;
}

void ImageObserver::TakeOldestOwed(PictureOrder* order) {
  *order = owed_[oldest_owed_];
  oldest_owed_ = (oldest_owed_ + 1) % MAX_OWED;
  --number_of_owed_;
}

bool ImageObserver::TakeStreamPicture(unsigned image_count, PictureOrder* order) {
  // The count is used only if images are to be skipped, so that a camera whose count does not advance can still stream
  // every image.
  if (every_nth_image_ > 1 && stream_has_begun_ && image_count - last_of_stream_ < every_nth_image_) {
    return false;
  }
  stream_has_begun_ = true;
  last_of_stream_ = image_count;
  *order = stream_order_;
  return true;
}
