#include "rcserver/camera/PictureTaker.h"

#include <OPENR/OFbkImage.h>
#include <string.h>

namespace {

const OFbkImageBand COLOR_BANDS[] = {ofbkimageBAND_Y, ofbkimageBAND_Cr, ofbkimageBAND_Cb};
const OFbkImageBand DETAIL_BANDS[] = {ofbkimageBAND_Y_LH, ofbkimageBAND_Y_HL, ofbkimageBAND_Y_HH};

// Finds three bands of a layer; false if one is missing.
bool FindBands(OFbkImageVectorData* image_vector, OFbkImageLayer layer, const OFbkImageBand* bands,
               const unsigned char** pixels) {
  for (int i = 0; i < 3; ++i) {
    OFbkImage band(image_vector->GetInfo(layer), image_vector->GetData(layer), bands[i]);
    if (!band.IsValid()) {
      return false;
    }
    pixels[i] = band.Pointer();
  }
  return true;
}

// Copies the rows of several planes alternately. All planes have the size of this image.
void CopyRows(const OFbkImage& image, const unsigned char* const* planes, size_t count, unsigned char* out) {
  const size_t width = static_cast<size_t>(image.Width());
  const size_t stride = width + static_cast<size_t>(image.Skip());
  for (size_t row = 0; row < static_cast<size_t>(image.Height()); ++row) {
    for (size_t plane = 0; plane < count; ++plane) {
      memcpy(out, planes[plane] + row * stride, width);
      out += width;
    }
  }
}

}  // namespace

PictureTaker::PictureTaker() : image_count_(0), is_waiting_(false), waiting_(), ticket_(0), made_() {}

void PictureTaker::CountImage(OFbkImageVectorData* image) {
  OFbkImage y(image->GetInfo(ofbkimageLAYER_H), image->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y);
  if (y.IsValid()) {
    image_count_ += static_cast<unsigned short>(y.FieldCounter() - image_count_);
  }
}

// A layer that has one band of fine detail has all three.
bool PictureTaker::HasDetail(OFbkImageVectorData* image) {
  return OFbkImage(image->GetInfo(ofbkimageLAYER_H), image->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y_HH).IsValid();
}

ColorPlane PictureTaker::FindColorPlane(OFbkImageVectorData* image) {
  const OFbkImage colors(image->GetInfo(ofbkimageLAYER_C), image->GetData(ofbkimageLAYER_C), ofbkimageBAND_CDT);
  const bool is_there = colors.IsValid() && colors.Width() > 0 && colors.Height() > 1;
  const ColorPlane plane = {is_there ? colors.Pointer() : NULL, static_cast<size_t>(colors.Width()),
                            static_cast<size_t>(colors.Height()), static_cast<size_t>(colors.Width() + colors.Skip())};
  return plane;
}

const char* PictureTaker::Offer(OFbkImageVectorData* image, ImageObserver& wanted, bool may_begin,
                                const protocol::version2::CameraSettings& settings) {
  PictureOrder order;
  if (!FindOrder(wanted, may_begin, &order)) {
    return NULL;
  }
  if (!jobs_.HasReceiver()) {
    return "the object PictureEncoder does not run: ENCODER.BIN is missing on the memory stick, or in its "
           "OBJECT.CFG or CONNECT.CFG";
  }
  const bool is_double = order.layer == protocol::version2::LAYER_DOUBLE;
  const OFbkImageLayer source = is_double ? ofbkimageLAYER_H : static_cast<OFbkImageLayer>(order.layer);
  const unsigned char* planes[6];
  if (!FindBands(image, source, COLOR_BANDS, planes)) {
    return "the camera image has no Y, Cr and Cb bands";
  }
  OFbkImage y(image->GetInfo(source), image->GetData(source), ofbkimageBAND_Y);
  const size_t width = static_cast<size_t>(y.Width());
  const size_t height = static_cast<size_t>(y.Height());
  if (width > MAX_IMAGE_WIDTH || height > MAX_IMAGE_HEIGHT) {
    return "the camera image is larger than an ERS-7's";
  }
  if (is_double && !FindBands(image, ofbkimageLAYER_H, DETAIL_BANDS, planes + 3)) {
    return "the camera image has no bands for double resolution";
  }
  PictureJob* const job = jobs_.Memory();
  job->quality = order.quality;
  job->width = width;
  job->height = height;
  job->is_double = is_double;
  CopyRows(y, planes, is_double ? 6 : 3, job->pixels);
  const size_t scale = is_double ? 2 : 1;
  const protocol::version2::ImageHeader header = {image_count_,
                                                  image->GetInfo(source)->frameNumber,
                                                  static_cast<unsigned short>(scale * width),
                                                  static_cast<unsigned short>(scale * height),
                                                  order.quality,
                                                  static_cast<protocol::version2::Layer>(order.layer),
                                                  settings};
  is_waiting_ = true;
  waiting_.order = order;
  waiting_.header = header;
  return NULL;
}

void PictureTaker::Begin() {
  is_waiting_ = false;
  made_ = waiting_;
  ticket_ = jobs_.NewTicket();
  jobs_.Memory()->ticket = ticket_;
  jobs_.Send();
}

bool PictureTaker::Take(const ONotifyEvent& event, OObserver* observer) {
  picture_.Hold(event, observer);
  if (Picture().ticket != ticket_) {
    DropPicture();
    return false;
  }
  ticket_ = 0;
  made_.header.quality = static_cast<unsigned char>(Picture().quality);
  return true;
}

void PictureTaker::Forget() {
  ticket_ = 0;
  is_waiting_ = false;
  DropPicture();
}

// Finds the kind of picture to make of the last image; false if none is due.
bool PictureTaker::FindOrder(ImageObserver& wanted, bool may_begin, PictureOrder* order) {
  if (!is_waiting_ && !HasPicture()) {
    return may_begin && wanted.ImageArrived(image_count_, order);
  }
  *order = is_waiting_ ? waiting_.order : made_.order;
  if (!is_waiting_) {
    DropPicture();
  }
  is_waiting_ = false;
  return wanted.TakeAgain(*order, image_count_);
}
