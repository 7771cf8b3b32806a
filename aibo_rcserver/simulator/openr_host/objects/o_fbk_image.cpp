#include <OPENR/OFbkImage.h>

#include "simulator/openr_host/objects/filled_on_read.h"

namespace {

/// How many bands a layer has. They are interleaved row by row.
int numberOfBands(ODataType type) {
  switch (type) {
    case odataFBK_YCrCb:
      return 3;
    case odataFBK_YCrCb_HPF:
      return 6;
    case odataFBK_CDT:
      return 1;
    default:
      return 0;
  }
}

/// A band's index among interleaved rows; numberOfBands() or more if the layer lacks the band.
int rowOf(OFbkImageBand band, ODataType type) {
  if (type == odataFBK_CDT) {
    return band == ofbkimageBAND_CDT ? 0 : 1;
  }
  // The colour detection's number lies among the other bands' numbers.
  const int absent = 6;
  if (band == ofbkimageBAND_CDT || band > ofbkimageBAND_Y_HH) {
    return absent;
  }
  return static_cast<int>(band < ofbkimageBAND_CDT ? band : band - 1);
}

}  // namespace

OFbkImage::OFbkImage(OFbkImageInfo* info, byte* data, OFbkImageBand band)
    : pointer_(nullptr), width_(0), height_(0), skip_(0) {
  const int bands = numberOfBands(info->type);
  const int row = rowOf(band, info->type);
  if (row < bands) {
    width_ = static_cast<int>(info->width);
    height_ = static_cast<int>(info->height);
    skip_ = (bands - 1) * width_;
    pointer_ = data + row * width_;
  }
}

byte* OFbkImage::Pointer() const {
  openr_host::FilledOnRead::read(pointer_);
  return pointer_;
}

word OFbkImage::FieldCounter() const {
  return static_cast<word>(Tag(0) | Tag(1) << 8);
}

byte OFbkImage::ColorFrequency(OCdtChannel channel) const {
  openr_host::FilledOnRead::read(pointer_);
  for (int i = 0; i < 8; ++i) {
    if (channel == OCdtChannel{1} << i) {
      return Tag(i < 4 ? 8 + i : i);
    }
  }
  return 0;
}
