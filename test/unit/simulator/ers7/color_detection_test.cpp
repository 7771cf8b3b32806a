#include "simulator/ers7/camera/color_detection.h"

#include <gmock/gmock.h>

namespace simulated_ers7 {
namespace {

TEST(ColorDetection, PutsAPixelIntoTheRangesOfItsSegment) {
  OCdtVectorData tables{};
  tables.SetNumData(1);
  tables.GetInfo(0)->Init(1, ocdtCHANNEL3);
  tables.GetInfo(0)->Set(2, 230, 150, 190, 120);
  ColorDetection detection;
  ASSERT_EQ(detection.load(tables), oSUCCESS);
  const std::tuple<byte, byte, byte, bool> rows[] = {
      // Y, Cr, Cb, is of the colour
      {16, 150, 120, true},  {16, 230, 190, true},  {23, 150, 120, true},  {23, 230, 190, true},  {16, 149, 150, false},
      {16, 231, 150, false}, {23, 200, 119, false}, {23, 200, 191, false}, {15, 200, 150, false}, {24, 200, 150, false},
  };
  ColorCounts counts{};
  for (const auto& [y, cr, cb, is_in] : rows) {
    byte pixel = 0xff;
    detection.detect(&y, &cr, &cb, 1, &pixel, &counts);
    EXPECT_EQ(pixel, is_in ? ocdtCHANNEL3 : 0) << int{y} << " " << int{cr} << " " << int{cb};
  }
  EXPECT_THAT(counts, testing::ElementsAre(0, 0, 0, 4, 0, 0, 0, 0));
}

TEST(ColorDetection, RefusesAllTablesIfOneIsOfAChannelThatAnErs7DoesNotHave) {
  for (const OCdtChannel channel : {ocdtCHANNEL7, ocdtCHANNEL_UNDEF, ocdtCHANNEL0 | ocdtCHANNEL1}) {
    OCdtVectorData tables{};
    tables.SetNumData(2);
    tables.GetInfo(0)->Init(1, ocdtCHANNEL1);
    tables.GetInfo(1)->Init(1, channel);
    ColorDetection detection;
    EXPECT_EQ(detection.load(tables), oINVALID_ARG);
    EXPECT_FALSE(detection.isOn());
  }
}

}  // namespace
}  // namespace simulated_ers7
