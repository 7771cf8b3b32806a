#include "rcserver/camera/PictureTaker.h"

#include <OPENR/OFbkImage.h>
#include <string.h>

#include "picture_encoder/CameraImage.h"

namespace {

// Finds the bands of a layer; false if one is missing.
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

// Finds the bands of fine detail that belong to layer H; false if the camera has none.
bool FindDetail(OFbkImageVectorData* image_vector, DetailBands* detail) {
  OFbkImageInfo* info = image_vector->GetInfo(ofbkimageLAYER_H);
  byte* data = image_vector->GetData(ofbkimageLAYER_H);
  OFbkImage lh(info, data, ofbkimageBAND_Y_LH);
  OFbkImage hl(info, data, ofbkimageBAND_Y_HL);
  OFbkImage hh(info, data, ofbkimageBAND_Y_HH);
  if (!lh.IsValid() || !hl.IsValid() || !hh.IsValid()) {
    return false;
  }
  detail->lh = lh.Pointer();
  detail->hl = hl.Pointer();
  detail->hh = hh.Pointer();
  return true;
}

// Copies the rows of several planes alternately.
void CopyRows(const CameraImage& image, const unsigned char* const* planes, size_t count, unsigned char* out) {
  for (size_t row = 0; row < image.height; ++row) {
    for (size_t plane = 0; plane < count; ++plane) {
      memcpy(out, planes[plane] + row * image.stride, image.width);
      out += image.width;
    }
  }
}

}  // namespace

PictureTaker::PictureTaker()
    : image_count_(0), is_waiting_(false), waiting_order_(), waiting_header_(), ticket_(0), order_(), header_() {}

void PictureTaker::CountImage(OFbkImageVectorData* image) {
  OFbkImageInfo* info = image->GetInfo(ofbkimageLAYER_H);
  byte* data = image->GetData(ofbkimageLAYER_H);
  OFbkImage y(info, data, ofbkimageBAND_Y);
  if (y.IsValid()) {
    image_count_ += static_cast<unsigned short>(y.FieldCounter() - image_count_);
  }
}

// A layer that has one band of fine detail has all three.
bool PictureTaker::HasDetail(OFbkImageVectorData* image) {
  return OFbkImage(image->GetInfo(ofbkimageLAYER_H), image->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y_HH).IsValid();
}

const char* PictureTaker::Offer(OFbkImageVectorData* image, const PictureOrder& order,
                                const protocol::version2::CameraSettings& settings) {
  if (!jobs_.HasReceiver()) {
    return "no picture: the object PictureEncoder does not run: ENCODER.BIN is missing on the memory stick, or in its "
           "OBJECT.CFG or CONNECT.CFG";
  }
  const bool is_double = order.layer == protocol::version2::LAYER_DOUBLE;
  const OFbkImageLayer source = is_double ? ofbkimageLAYER_H : static_cast<OFbkImageLayer>(order.layer);
  CameraImage layer;
  DetailBands detail = {NULL, NULL, NULL};
  if (!FindPlanes(image, source, &layer)) {
    return "the camera image has no Y, Cr and Cb bands";
  }
  if (layer.width > MAX_IMAGE_WIDTH || layer.height > MAX_IMAGE_HEIGHT) {
    return "the camera image is larger than an ERS-7's";
  }
  if (is_double && !FindDetail(image, &detail)) {
    return "the camera image has no bands for double resolution";
  }
  PictureJob* const job = jobs_.Memory();
  job->quality = order.quality;
  job->width = layer.width;
  job->height = layer.height;
  job->is_double = is_double;
  const unsigned char* const planes[] = {layer.y, layer.cr, layer.cb, detail.lh, detail.hl, detail.hh};
  CopyRows(layer, planes, is_double ? 6 : 3, job->pixels);
  const size_t scale = is_double ? 2 : 1;
  const protocol::version2::ImageHeader header = {image_count_,
                                                  image->GetInfo(source)->frameNumber,
                                                  static_cast<unsigned short>(scale * layer.width),
                                                  static_cast<unsigned short>(scale * layer.height),
                                                  order.quality,
                                                  static_cast<protocol::version2::Layer>(order.layer),
                                                  settings};
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

bool PictureTaker::TakeBack(PictureOrder* order) {
  const bool is_any = is_waiting_ || HasPicture();
  if (is_any) {
    *order = is_waiting_ ? waiting_order_ : order_;
  }
  if (!is_waiting_) {
    DropPicture();
  }
  is_waiting_ = false;
  return is_any;
}

bool PictureTaker::Take(const ONotifyEvent& event, OObserver* observer) {
  picture_.Hold(event, observer);
  if (Picture().ticket != ticket_) {
    DropPicture();
    return false;
  }
  ticket_ = 0;
  header_.quality = static_cast<unsigned char>(Picture().quality);
  return true;
}

void PictureTaker::Forget() {
  ticket_ = 0;
  is_waiting_ = false;
  DropPicture();
}
