/// @file OFbkImage.h
/// Reads one band of one layer of a camera image.
#ifndef OPENR_OFBKIMAGE_H
#define OPENR_OFBKIMAGE_H

#include <OPENR/ODataFormats.h>

typedef longword OFbkImageBand;
const OFbkImageBand ofbkimageBAND_Y = 0;
const OFbkImageBand ofbkimageBAND_Cr = 1;
const OFbkImageBand ofbkimageBAND_Cb = 2;
const OFbkImageBand ofbkimageBAND_CDT = 3;
const OFbkImageBand ofbkimageBAND_Y_LH = 4;
const OFbkImageBand ofbkimageBAND_Y_HL = 5;
const OFbkImageBand ofbkimageBAND_Y_HH = 6;

/// A view, without a copy, of one band. The bands of a layer are interleaved row by row: a row of Y, the same row of
/// Cr, of Cb, and where the layer has them (odataFBK_YCrCb_HPF) of Y_LH, Y_HL and Y_HH; then the next row of Y.
///
/// The first 16 pixels of the last row are not part of the picture but tag bytes: 0-1 the field counter, little-endian;
/// 4-7 and 8-11 the results of the colour detection in channels 4-7 and 0-3, each the number of pixels in sixteenths.
class OFbkImage {
 public:
  /// @param info, data of one layer: OFbkImageVectorData::GetInfo() and GetData(), which must outlive this
  OFbkImage(OFbkImageInfo* info, byte* data, OFbkImageBand band);

  /// False if the layer has no such band. Then no other function may be called.
  bool IsValid() const { return pointer_ != 0; }

  /// The first pixel. The simulated camera draws its picture when this or Pixel() is called for it first; until then
  /// the image has only its infos and the field counter. So pixels are to be read through this, not through
  /// OFbkImageVectorData::GetData() alone.
  byte* Pointer() const;
  int Width() const { return width_; }
  int Height() const { return height_; }
  /// Bytes between the last pixel of a row and the first of the next: pixel (x, y) is
  /// Pointer()[y * (Width() + Skip()) + x].
  int Skip() const { return skip_; }
  /// @param x 0..Width()-1
  /// @param y 0..Height()-1, from the top
  byte Pixel(int x, int y) const { return Pointer()[y * (width_ + skip_) + x]; }

  /// The camera's count of fields, from the tag bytes. Known before the picture is drawn.
  word FieldCounter() const;
  /// The number of pixels, in sixteenths, that the colour detection found in a channel; from the tag bytes.
  /// @param channel one of ocdtCHANNEL0..ocdtCHANNEL7; 0 for any other
  byte ColorFrequency(OCdtChannel channel) const;

 private:
  byte Tag(int index) const { return pointer_[(height_ - 1) * (width_ + skip_) + index]; }

  byte* pointer_;
  int width_;
  int height_;
  int skip_;
};

#endif  // OPENR_OFBKIMAGE_H
