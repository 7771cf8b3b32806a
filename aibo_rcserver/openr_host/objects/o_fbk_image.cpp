#include <OPENR/OFbkImage.h>

namespace {

/// How many bands a layer has, interleaved row by row.
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

/// Which of the interleaved rows a band has, or numberOfBands() and more if it is not among them.
int rowOf(OFbkImageBand band, ODataType type) {
  if (type == odataFBK_CDT) {
    return band == ofbkimageBAND_CDT ? 0 : 1;
  }
  // The colour detection's number lies between those of the bands that share a layer.
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

word OFbkImage::FieldCounter() const {
  return static_cast<word>(Tag(0) | Tag(1) << 8);
}

word OFbkImage::ColorFrequency(OCdtChannel channel) const {
  const int tag = static_cast<int>(channel < 4 ? 8 + channel : channel);
  return static_cast<word>(Tag(tag) * 16);
}
