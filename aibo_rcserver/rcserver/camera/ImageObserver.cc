#include "rcserver/camera/ImageObserver.h"

const int ImageObserver::MAX_OWED;
const char ImageObserver::TOO_MANY_OWED[] = "too many pictures are owed already; wait until some have come";

ImageObserver::ImageObserver() : state_(IOS_IDLE), has_detail_(true), stream_order_() {}

bool ImageObserver::RequestPicture(const PictureOrder& order) {
  if (owed_.IsFull()) {
    return false;
  }
  owed_.Add(order);
  if (state_ != IOS_CONTINUOUS) {
    state_ = IOS_PICTURE;
  }
  return true;
}

void ImageObserver::StartStream(const PictureOrder& order, unsigned short every_nth_image) {
  stream_order_ = order;
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
      state_ = owed_.IsEmpty() ? IOS_IDLE : IOS_PICTURE;
      return false;
    case IOS_PICTURE:
      owed_.Take(order);
      state_ = owed_.IsEmpty() ? IOS_IDLE : IOS_PICTURE;
      return true;
    case IOS_CONTINUOUS:
      if (owed_.Take(order)) {
        return true;
      }
      *order = stream_order_;
      return stream_interval_.Chooses(image_count);
  }
  return false;
}

bool ImageObserver::TakeAgain(const PictureOrder& order, unsigned image_count) {
  const bool is_wanted = Wants(order);
  if (is_wanted && order.purpose == PictureOrder::FOR_STREAM) {
    stream_interval_.Replace(image_count);
  }
  return is_wanted;
}

bool ImageObserver::Wants(const PictureOrder& order) const {
  return order.purpose != PictureOrder::FOR_STREAM ||
         (state_ == IOS_CONTINUOUS && order.quality == stream_order_.quality && order.layer == stream_order_.layer);
}

void ImageObserver::ClientGone() {
  state_ = IOS_IDLE;
  owed_.Clear();
}
