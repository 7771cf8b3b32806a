#include "rcserver/camera/ColorCounter.h"

#include <string.h>

using namespace protocol::version2;

namespace {

// The counts of one channel. The sums of columns and rows fit, because an ERS-7's plane has 8320 pixels.
struct Count {
  unsigned pixels;
  unsigned sum_x;
  unsigned sum_y;
  unsigned left;
  unsigned right;  // the last column
  unsigned top;
  unsigned bottom;  // the last row
};

// Adds the pixels from column `begin` up to, but not including, column `end`.
void AddRun(unsigned begin, unsigned end, unsigned y, Count* count) {
  const unsigned pixels = end - begin;
  if (count->pixels == 0) {
    count->left = begin;
    count->top = y;
  }
  count->left = begin < count->left ? begin : count->left;
  count->right = end - 1 > count->right ? end - 1 : count->right;
  count->bottom = y;
  count->pixels += pixels;
  count->sum_x += pixels * (begin + end - 1) / 2;
  count->sum_y += pixels * y;
}

void AddRunOfChannels(unsigned channels, unsigned begin, unsigned end, unsigned y, Count* counts) {
  for (; channels != 0; channels >>= 1, ++counts) {
    if ((channels & 1) != 0) {
      AddRun(begin, end, y, counts);
    }
  }
}

void CountRow(const unsigned char* row, unsigned width, unsigned channels, unsigned y, Count* counts) {
  for (unsigned x = 0; x < width;) {
    const unsigned found = row[x] & channels;
    const unsigned begin = x;
    do {
      ++x;
    } while (x < width && (row[x] & channels) == found);
    if (found != 0) {
      AddRunOfChannels(found, begin, x, y, counts);
    }
  }
}

unsigned short Mean(unsigned sum, unsigned pixels) {
  return static_cast<unsigned short>((sum * COLOR_CENTROID_SCALE + pixels / 2) / pixels);
}

ColorRegion RegionOf(int channel, const Count& count) {
  ColorRegion region = {static_cast<unsigned char>(channel), count.pixels, 0, 0, 0, 0, 0, 0};
  if (count.pixels > 0) {
    region.x = Mean(count.sum_x, count.pixels);
    region.y = Mean(count.sum_y, count.pixels);
    region.left = static_cast<unsigned short>(count.left);
    region.top = static_cast<unsigned short>(count.top);
    region.width = static_cast<unsigned short>(count.right - count.left + 1);
    region.height = static_cast<unsigned short>(count.bottom - count.top + 1);
  }
  return region;
}

}  // namespace

void countColors(const ColorPlane& plane, unsigned char channels, ColorRegions* regions) {
  Count counts[MAX_COLOR_CHANNELS];
  memset(counts, 0, sizeof(counts));
  for (size_t y = 0; y < plane.Rows(); ++y) {
    CountRow(plane.pixels + y * plane.stride, static_cast<unsigned>(plane.width), channels, static_cast<unsigned>(y),
             counts);
  }
  regions->count = 0;
  for (int channel = 0; channel < MAX_COLOR_CHANNELS; ++channel) {
    if ((channels >> channel & 1) != 0) {
      regions->regions[regions->count] = RegionOf(channel, counts[channel]);
      ++regions->count;
    }
  }
}

bool canPackPlane(const ColorPlane& plane) {
  return plane.width <= MAX_COLOR_PLANE_WIDTH && plane.height <= MAX_COLOR_PLANE_HEIGHT;
}

size_t packPlane(const ColorPlane& plane, unsigned char* out) {
  static const unsigned char EMPTY_ROW[MAX_COLOR_PLANE_WIDTH] = {0};
  size_t size = 0;
  for (size_t y = 0; y < plane.height; ++y) {
    const unsigned char* const row = y < plane.Rows() ? plane.pixels + y * plane.stride : EMPTY_ROW;
    size += packColorPlane(row, plane.width, out + size);
  }
  return size;
}
