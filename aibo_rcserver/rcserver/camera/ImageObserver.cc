#include "rcserver/camera/ImageObserver.h"

const size_t ImageObserver::MAX_OWED;
const char ImageObserver::TOO_MANY_OWED[] = "too many pictures are owed already; wait until some have come";

ImageObserver::ImageObserver()
    : state_(IOS_IDLE), has_detail_(true), stream_order_(), oldest_owed_(0), number_of_owed_(0) {}

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
  stream_interval_ = Interval(every_nth_image);
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
      *order = stream_order_;
      return stream_interval_.Chooses(image_count);
  }
  return false;
}

bool ImageObserver::TakeAgain(const PictureOrder& order, unsigned image_count) {
  const bool is_wanted = Wants(order);
  if (is_wanted && order.is_of_stream) {
    stream_interval_.Replace(image_count);
  }
  return is_wanted;
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
