#include "rcserver/camera/PictureTaker.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OSyslog.h>
#include <string.h>

#include "picture_encoder/CameraImage.h"

namespace {

// Finds the bands of a layer. False if one is missing.
bool FindPlanes(OFbkImageVectorData* image_vector, OFbkImageLayer layer, CameraImage* image) {
  OFbkImageInfo* info = image_vector->GetInfo(layer);
  byte* data = image_vector->GetData(layer);
  OFbkImage y(info, data, ofbkimageBAND_Y);
  OFbkImage cr(info, data, ofbkimageBAND_Cr);
  OFbkImage cb(info, data, ofbkimageBAND_Cb);
  if (!y.IsValid() || !cr.IsValid() || !cb.IsValid()) {
    return false;
  }
  image->y = y.Pointer();
  image->cr = cr.Pointer();
  image->cb = cb.Pointer();
  image->width = static_cast<size_t>(y.Width());
  image->height = static_cast<size_t>(y.Height());
  image->stride = static_cast<size_t>(y.Width() + y.Skip());
  return true;
}

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
    : image_count_(0),
      is_waiting_(false),
      waiting_order_(),
      waiting_header_(),
      ticket_(0),
      order_(),
      header_(),
      is_streaming_(false),
      last_sent_(0),
      pictures_sent_(0),
      images_left_out_(0) {}

void PictureTaker::CountImage(OFbkImageVectorData* image) {
  CameraImage layer;
  if (FindPlanes(image, ofbkimageLAYER_H, &layer)) {
    image_count_ += static_cast<unsigned short>(layer.FieldCounter() - image_count_);
  }
}

const char* PictureTaker::Offer(OFbkImageVectorData* image, const PictureOrder& order) {
  if (!jobs_.HasReceiver()) {
    return "no picture: the object PictureEncoder does not run: ENCODER.BIN is missing on the memory stick, or in its "
           "OBJECT.CFG or CONNECT.CFG";
  }
  CameraImage layer;
  if (!FindPlanes(image, order.layer, &layer)) {
    return "the camera image has no Y, Cr and Cb bands";
  }
  if (layer.width > MAX_IMAGE_WIDTH || layer.height > MAX_IMAGE_HEIGHT) {
    return "the camera image is larger than an ERS-7's";
  }
  PictureJob* const job = jobs_.Memory();
  job->quality = order.quality;
  job->width = layer.width;
  job->height = layer.height;
  CopyRows(layer, job->pixels);
  const protocol::version2::ImageHeader header = {image_count_,
                                                  image->GetInfo(order.layer)->frameNumber,
                                                  static_cast<unsigned short>(layer.width),
                                                  static_cast<unsigned short>(layer.height),
                                                  order.quality,
                                                  static_cast<protocol::version2::Layer>(order.layer)};
  is_waiting_ = true;
  waiting_order_ = order;
  waiting_header_ = header;
  return NULL;
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

void PictureTaker::Forget() {
  ticket_ = 0;
  is_waiting_ = false;
  is_streaming_ = false;
}

void PictureTaker::CountSent() {
  if (!is_streaming_) {
    return;
  }
  if (pictures_sent_ > 0 && header_.image_count != last_sent_) {
    images_left_out_ += header_.image_count - last_sent_ - 1;
  }
  last_sent_ = header_.image_count;
  ++pictures_sent_;
}

void PictureTaker::ReportStream(const ImageObserver& camera, longword now, ReportLimit* limit) {
  const bool is_streaming = camera.State() == IOS_CONTINUOUS;
  if (is_streaming == is_streaming_) {
    return;
  }
  is_streaming_ = is_streaming;
  const bool is_reported = limit->Admits(now);
  if (is_reported && is_streaming) {
    OSYSPRINT(("RCServer: stream on, quality %d\n", static_cast<int>(camera.StreamQuality())));
  } else if (is_reported) {
    OSYSPRINT(
        ("RCServer: stream off after %lu pictures, %lu camera images left out\n", pictures_sent_, images_left_out_));
  }
  if (is_streaming) {
    pictures_sent_ = 0;
    images_left_out_ = 0;
  }
}
