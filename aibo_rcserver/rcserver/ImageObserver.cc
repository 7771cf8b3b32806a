#include "rcserver/ImageObserver.h"

const size_t ImageObserver::MAX_OWED;

ImageObserver::ImageObserver() : state_(IOS_IDLE), stream_quality_(0), oldest_owed_(0), number_of_owed_(0) {}

bool ImageObserver::RequestPicture(unsigned char quality) {
  if (number_of_owed_ == MAX_OWED) {
    return false;
  }
  owed_[(oldest_owed_ + number_of_owed_) % MAX_OWED] = quality;
  ++number_of_owed_;
  if (state_ != IOS_CONTINUOUS) {
    state_ = IOS_PICTURE;
  }
  return true;
}

void ImageObserver::ToggleStream(unsigned char quality) {
  if (state_ == IOS_CONTINUOUS) {
    state_ = IOS_STOPSEND;
    return;
  }
  stream_quality_ = quality;
  state_ = IOS_CONTINUOUS;
}

bool ImageObserver::ImageArrived(unsigned char* quality) {
  switch (state_) {
    case IOS_IDLE:
      return false;
    case IOS_STOPSEND:
      state_ = number_of_owed_ > 0 ? IOS_PICTURE : IOS_IDLE;
      return false;
    case IOS_PICTURE:
      *quality = TakeOldestOwed();
      state_ = number_of_owed_ > 0 ? IOS_PICTURE : IOS_IDLE;
      return true;
    case IOS_CONTINUOUS:
      *quality = number_of_owed_ > 0 ? TakeOldestOwed() : stream_quality_;
      return true;
  }
  return false;
}

void ImageObserver::ClientGone() {
  state_ = IOS_IDLE;
  number_of_owed_ = 0;
}

unsigned char ImageObserver::TakeOldestOwed() {
  const unsigned char quality = owed_[oldest_owed_];
  oldest_owed_ = (oldest_owed_ + 1) % MAX_OWED;
  --number_of_owed_;
  return quality;
}
