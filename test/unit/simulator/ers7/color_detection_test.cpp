#include "simulator/ers7/camera/color_detection.h"

#include <gmock/gmock.h>

namespace simulated_ers7 {
namespace {

OCdtVectorData tablesOf(OCdtChannel channel) {
  OCdtVectorData tables{};
  tables.SetNumData(1);
  tables.GetInfo(0)->Init(1, channel);
  return tables;
}

class ColorDetectionTest : public ::testing::Test {
 protected:
  byte pixelOf(byte y, byte cr, byte cb) {
    byte pixel = 0xff;
    detection_.detect(&y, &cr, &cb, 1, &pixel, &counts_);
    return pixel;
  }

  ColorDetection detection_;
  ColorCounts counts_{};
};

TEST_F(ColorDetectionTest, APixelBelongsToTheRangesOfItsSegment) {
  OCdtVectorData tables = tablesOf(ocdtCHANNEL3);
  tables.GetInfo(0)->Set(2, 230, 150, 190, 120);
  ASSERT_EQ(detection_.load(tables), oSUCCESS);
  EXPECT_TRUE(detection_.isOn());
  for (const byte y : {byte{16}, byte{23}}) {
    EXPECT_EQ(pixelOf(y, 150, 120), ocdtCHANNEL3);
    EXPECT_EQ(pixelOf(y, 230, 190), ocdtCHANNEL3);
    EXPECT_EQ(pixelOf(y, 149, 150), 0);
    EXPECT_EQ(pixelOf(y, 231, 150), 0);
    EXPECT_EQ(pixelOf(y, 200, 119), 0);
    EXPECT_EQ(pixelOf(y, 200, 191), 0);
  }
  EXPECT_EQ(pixelOf(15, 200, 150), 0);
  EXPECT_EQ(pixelOf(24, 200, 150), 0);
  EXPECT_THAT(counts_, testing::ElementsAre(0, 0, 0, 4, 0, 0, 0, 0));
}

TEST_F(ColorDetectionTest, AnErs7HasNoChannel7) {
  OCdtVectorData tables = tablesOf(ocdtCHANNEL1);
  tables.GetInfo(0)->Set(0, 255, 0, 255, 0);
  tables.SetNumData(2);
  for (const OCdtChannel channel : {ocdtCHANNEL7, ocdtCHANNEL_UNDEF, ocdtCHANNEL0 | ocdtCHANNEL1}) {
    tables.GetInfo(1)->Init(1, channel);
    EXPECT_EQ(detection_.load(tables), oINVALID_ARG);
  }
  EXPECT_FALSE(detection_.isOn()) << "nothing of it is loaded";
}

}  // namespace
}  // namespace simulated_ers7
