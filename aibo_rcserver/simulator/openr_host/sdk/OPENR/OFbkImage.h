/// @file OFbkImage.h
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

/// A view of one band of one layer of a camera image; it copies nothing. A layer's bands are interleaved row by row: a
/// row of Y, of Cr, of Cb, then (odataFBK_YCrCb_HPF) of Y_LH, Y_HL and Y_HH.
///
/// The first 16 pixels of the last row are tag bytes instead of picture. Bytes 0-1 are the field counter,
/// little-endian. Bytes 4-7 and 8-11 count the pixels that colour channels 4-7 and 0-3 found, one for every 16 pixels.
class OFbkImage {
 public:
  /// @param info, data of one layer: OFbkImageVectorData::GetInfo() and GetData(), which must outlive the object
  OFbkImage(OFbkImageInfo* info, byte* data, OFbkImageBand band);

  /// False if the layer lacks the band. In that case, no other function may be called.
  bool IsValid() const { return pointer_ != 0; }

  /// The first pixel. The simulated camera draws its picture at the first call of this or Pixel(). Until then the image
  /// has only infos and the field counter, so do not read pixels through OFbkImageVectorData::GetData() alone.
  byte* Pointer() const;
  int Width() const { return width_; }
  int Height() const { return height_; }
  /// Bytes between the end of a row and the next row. Pixel (x, y) is Pointer()[y * (Width() + Skip()) + x].
  int Skip() const { return skip_; }
  /// @param x 0..Width()-1
  /// @param y 0..Height()-1, from the top
  byte Pixel(int x, int y) const { return Pointer()[y * (width_ + skip_) + x]; }

  /// The camera's counter of fields, from the tag bytes. It is known before the picture is drawn.
  word FieldCounter() const;
  /// How many pixels a colour channel found, in sixteenths; from the tag bytes.
  /// @param channel ocdtCHANNEL0..ocdtCHANNEL7; any other gives 0
  byte ColorFrequency(OCdtChannel channel) const;

 private:
  byte Tag(int index) const { return pointer_[(height_ - 1) * (width_ + skip_) + index]; }

  byte* pointer_;
  int width_;
  int height_;
  int skip_;
};

#endif  // OPENR_OFBKIMAGE_H
