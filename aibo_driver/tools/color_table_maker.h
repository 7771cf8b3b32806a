/// @file color_table_maker.h
/// Makes a table for the colour detection from a part of a picture.
#ifndef AIBO_DRIVER_TOOLS_COLOR_TABLE_MAKER_H
#define AIBO_DRIVER_TOOLS_COLOR_TABLE_MAKER_H

#include <string>

#include "aibo_client/colors.h"
#include "camera/jpeg_decoder.h"

namespace aibo_driver::color_table {

/// A part of a picture, in pixels from its upper left corner.
struct Region {
  int left;
  int top;
  int width;
  int height;

  bool contains(int x, int y) const { return x >= left && x < left + width && y >= top && y < top + height; }
};

/// Makes a table of the colours in a region. The table contains the range of Y, in whole segments and one more at each
/// end, and the ranges of Cr and Cb, widened by a margin. Of each range, the lowest and the highest hundredth of the
/// values are left out, because the edges of things have other colours.
/// @param margin added to both ends of Cr and Cb, 0..127
/// @throw InvalidArgumentException the region is not within the picture, or has fewer than 16 pixels; the message says
///   what is wrong
aibo_client::ColorTable makeTable(const camera::BgrImage& picture, const Region& region, const std::string& name,
                                  int margin);

/// How much of a picture a table contains, as shares of all pixels.
struct Coverage {
  double inside;   ///< the share of the region
  double outside;  ///< the share of the rest of the picture; 0 if there is no rest
};
Coverage coverageOf(const aibo_client::ColorTable& table, const camera::BgrImage& picture, const Region& region);

}  // namespace aibo_driver::color_table

#endif  // AIBO_DRIVER_TOOLS_COLOR_TABLE_MAKER_H
