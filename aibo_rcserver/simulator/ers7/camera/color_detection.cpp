#include "simulator/ers7/camera/color_detection.h"

#include <algorithm>

namespace simulated_ers7 {
namespace {

constexpr OCdtChannel kChannels[] = {ocdtCHANNEL0, ocdtCHANNEL1, ocdtCHANNEL2, ocdtCHANNEL3,
                                     ocdtCHANNEL4, ocdtCHANNEL5, ocdtCHANNEL6};

bool hasChannel(const OCdtInfo& table) {
  return std::find(std::begin(kChannels), std::end(kChannels), table.channel) != std::end(kChannels);
}

}  // namespace

OStatus ColorDetection::load(const OCdtVectorData& tables) {
  const OCdtInfo* const end = tables.info + tables.vectorInfo.numData;
  if (!std::all_of(tables.info, end, hasChannel)) {
    return oINVALID_ARG;
  }
  std::for_each(tables.info, end, [this](const OCdtInfo& table) { loadChannel(table); });
  is_on_ = std::any_of(with_cr_.begin(), with_cr_.end(), [](const auto& segment) {
    return std::any_of(segment.begin(), segment.end(), [](byte channels) { return channels != 0; });
  });
  return oSUCCESS;
}

void ColorDetection::clear() {
  for (std::size_t segment = 0; segment < with_cr_.size(); ++segment) {
    with_cr_[segment].fill(0);
    with_cb_[segment].fill(0);
  }
  is_on_ = false;
}

void ColorDetection::loadChannel(const OCdtInfo& table) {
  const auto bit = static_cast<byte>(table.channel);
  for (std::size_t segment = 0; segment < with_cr_.size(); ++segment) {
    const longword ranges = table.table[segment];
    const bool is_empty = ranges == ocdtINIT;
    const longword cr_max = (ranges & ocdtCr_MAX_MASK) >> 8;
    const longword cr_min = ranges & ocdtCr_MIN_MASK;
    const longword cb_max = (ranges & ocdtCb_MAX_MASK) >> 24;
    const longword cb_min = (ranges & ocdtCb_MIN_MASK) >> 16;
    for (longword value = 0; value < 256; ++value) {
      const bool has_cr = !is_empty && cr_min <= value && value <= cr_max;
      const bool has_cb = !is_empty && cb_min <= value && value <= cb_max;
      byte& cr = with_cr_[segment][value];
      byte& cb = with_cb_[segment][value];
      cr = static_cast<byte>(has_cr ? cr | bit : cr & ~bit);
      cb = static_cast<byte>(has_cb ? cb | bit : cb & ~bit);
    }
  }
}

void ColorDetection::detect(const byte* y, const byte* cr, const byte* cb, std::size_t width, byte* pixels,
                            ColorCounts* counts) const {
  for (std::size_t x = 0; x < width; ++x) {
    const std::size_t segment = y[x] / (256 / ocdtMAX_Y_SEGMENT);
    pixels[x] = with_cr_[segment][cr[x]] & with_cb_[segment][cb[x]];
    for (std::size_t channel = 0; pixels[x] >> channel != 0; ++channel) {
      (*counts)[channel] += pixels[x] >> channel & 1U;
    }
  }
}

}  // namespace simulated_ers7
