#include "simulator/ers7/camera/fbk_image_writer.h"

#include <algorithm>
#include <cstddef>

namespace simulated_ers7 {
namespace {

constexpr std::size_t kBands = 6;
constexpr std::size_t kColorBands = 3;
constexpr std::size_t kTagBytes = 16;

constexpr byte kNoDetail = 128;
constexpr byte kGrey = 128;

struct LayerFormat {
  OFbkImageLayer layer;
  ODataType type;
  std::size_t width;
  std::size_t height;
  std::size_t bands;

  std::size_t size() const { return width * height * bands; }
};

constexpr LayerFormat kLayers[] = {
    {ofbkimageLAYER_H, odataFBK_YCrCb_HPF, kPictureWidth, kPictureHeight, kBands},
    {ofbkimageLAYER_M, odataFBK_YCrCb_HPF, kPictureWidth / 2, kPictureHeight / 2, kBands},
    {ofbkimageLAYER_L, odataFBK_YCrCb_HPF, kPictureWidth / 4, kPictureHeight / 4, kBands},
    {ofbkimageLAYER_C, odataFBK_CDT, kPictureWidth / 2, kPictureHeight / 2, 1},
};

constexpr std::size_t kNumberOfLayers = std::size(kLayers);
constexpr std::size_t kDataOffset = offsetof(OFbkImageVectorData, info) + kNumberOfLayers * sizeof(OFbkImageInfo);

OFbkImageVectorData* layersIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OFbkImageVectorData*>(base);
}

void writeBand(const YCrCbImage::Plane& plane, byte* first_row) {
  for (std::size_t y = 0; y < kPictureHeight; ++y) {
    std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(y * kPictureWidth), kPictureWidth,
                first_row + y * kBands * kPictureWidth);
  }
}

byte toBand(float detail) {
  return toByte(detail + kNoDetail);
}

/// Computes a layer's fine detail from the next larger layer's Y.
void split(const byte* from, byte* to, std::size_t width, std::size_t height) {
  const std::size_t from_stride = kBands * 2 * width;
  for (std::size_t y = 0; y < height; ++y) {
    const byte* upper = from + 2 * y * from_stride;
    const byte* lower = upper + from_stride;
    byte* row = to + (y * kBands + kColorBands) * width;
    for (std::size_t x = 0; x < width; ++x) {
      const FineDetail detail = fineDetailOf(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
      row[x] = toBand(detail.lh);
      row[width + x] = toBand(detail.hl);
      row[2 * width + x] = toBand(detail.hh);
    }
  }
}

/// Averages 2x2 pixels of the next larger layer.
void halve(const byte* from, byte* to, std::size_t width, std::size_t height) {
  const std::size_t from_stride = kBands * 2 * width;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t band = 0; band < kColorBands; ++band) {
      const byte* upper = from + 2 * y * from_stride + band * 2 * width;
      const byte* lower = upper + from_stride;
      byte* row = to + (y * kBands + band) * width;
      for (std::size_t x = 0; x < width; ++x) {
        row[x] = static_cast<byte>((upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) / 4);
      }
    }
  }
}

ColorCounts detect(const ColorDetection& colors, const byte* medium, byte* plane) {
  constexpr std::size_t kPlaneWidth = kPictureWidth / 2;
  ColorCounts counts{};
  if (!colors.isOn()) {
    std::fill_n(plane, kPlaneWidth * (kPictureHeight / 2), byte{0});
    return counts;
  }
  for (std::size_t y = 0; y < kPictureHeight / 2; ++y) {
    const byte* row = medium + y * kBands * kPlaneWidth;
    colors.detect(row, row + kPlaneWidth, row + 2 * kPlaneWidth, kPlaneWidth, plane + y * kPlaneWidth, &counts);
  }
  return counts;
}

void writeTags(OFbkImageVectorData* vector, longword image_number, const ColorCounts& counts) {
  constexpr std::size_t kPixelsPerCount = 16;
  constexpr std::size_t kMostCounted = 255;
  for (const LayerFormat& format : kLayers) {
    byte* tag = vector->GetData(format.layer) + (format.height - 1) * format.bands * format.width;
    std::fill_n(tag, kTagBytes, static_cast<byte>(0));
    for (unsigned i = 0; i < sizeof(image_number); ++i) {
      tag[i] = static_cast<byte>(image_number >> (8 * i));
    }
    for (std::size_t channel = 0; channel < counts.size(); ++channel) {
      tag[channel < 4 ? 8 + channel : channel] =
          static_cast<byte>(std::min(counts[channel] / kPixelsPerCount, kMostCounted));
    }
  }
}

}  // namespace

std::size_t fbkImageSize() {
  std::size_t size = kDataOffset;
  for (const LayerFormat& format : kLayers) {
    size += format.size();
  }
  return size;
}

void prepareFbkImage(RCRegion* region, OPrimitiveID camera) {
  OFbkImageVectorData* vector = layersIn(region);
  *vector = OFbkImageVectorData();
  vector->vectorInfo.type = odataFBKIMAGE_VECTOR;
  vector->vectorInfo.memRegionID = region->MemID();
  vector->vectorInfo.offset = static_cast<longword>(region->Offset());
  vector->vectorInfo.totalSize = static_cast<longword>(fbkImageSize());
  vector->vectorInfo.infoOffset = offsetof(OFbkImageVectorData, info);
  vector->vectorInfo.infoSize = sizeof(OFbkImageInfo);
  vector->vectorInfo.maxNumData = kNumberOfLayers;
  vector->vectorInfo.numData = kNumberOfLayers;
  std::size_t offset = kDataOffset;
  for (const LayerFormat& format : kLayers) {
    OFbkImageInfo* info = vector->GetInfo(format.layer);
    info->type = format.type;
    info->primitiveID = camera;
    info->dataOffset = static_cast<longword>(offset);
    info->dataSize = static_cast<longword>(format.size());
    info->width = static_cast<longword>(format.width);
    info->height = static_cast<longword>(format.height);
    static_assert(kNoDetail == kGrey, "one fill is enough for both");
    std::fill_n(vector->GetData(format.layer), format.size(), format.type == odataFBK_CDT ? byte{0} : kNoDetail);
    offset += format.size();
  }
}

void announceFbkImage(RCRegion* region, longword frame, longword image_number) {
  OFbkImageVectorData* vector = layersIn(region);
  for (const LayerFormat& format : kLayers) {
    vector->GetInfo(format.layer)->frameNumber = frame;
  }
  writeTags(vector, image_number, {});
}

void drawFbkImage(RCRegion* region, const YCrCbImage& picture, const ColorDetection& colors, longword image_number) {
  OFbkImageVectorData* vector = layersIn(region);
  byte* high = vector->GetData(ofbkimageLAYER_H);
  writeBand(picture.y, high);
  writeBand(picture.cr, high + kPictureWidth);
  writeBand(picture.cb, high + 2 * kPictureWidth);
  writeBand(picture.y_lh, high + 3 * kPictureWidth);
  writeBand(picture.y_hl, high + 4 * kPictureWidth);
  writeBand(picture.y_hh, high + 5 * kPictureWidth);
  byte* medium = vector->GetData(ofbkimageLAYER_M);
  halve(high, medium, kPictureWidth / 2, kPictureHeight / 2);
  split(high, medium, kPictureWidth / 2, kPictureHeight / 2);
  byte* low = vector->GetData(ofbkimageLAYER_L);
  halve(medium, low, kPictureWidth / 4, kPictureHeight / 4);
  split(medium, low, kPictureWidth / 4, kPictureHeight / 4);
  const ColorCounts counts = detect(colors, medium, vector->GetData(ofbkimageLAYER_C));
  writeTags(vector, image_number, counts);
}

}  // namespace simulated_ers7
