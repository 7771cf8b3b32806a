#include "simulator/ers7/camera/camera.h"

#include <OPENR/OFbkImage.h>
#include <gmock/gmock.h>

#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

// docs/ros_interface.md, "Stamps".
TEST(CameraTiming, AnImageComesEvery32Or40Milliseconds) {
  longword last = 0;
  for (longword frame = 1; frame <= 125 * 60; ++frame) {
    if (imagesUpTo(frame) != imagesUpTo(frame - 1)) {
      EXPECT_TRUE(frame - last == 4 || frame - last == 5 || last == 0) << frame;
      last = frame;
    }
  }
  EXPECT_EQ(imagesUpTo(0), 1U) << "the first comes in the first frame";
  EXPECT_NEAR(125 * 3600 * openr_host::kFrameSeconds / imagesUpTo(125 * 3600), 0.03347, 0.00001);
}

constexpr OPrimitiveID kId = 42;

/// A picture in which every byte depends on its position.
class TestPicture : public PictureSource {
 public:
  TestPicture() {
    for (std::size_t i = 0; i < image_.y.size(); ++i) {
      const std::size_t x = i % kPictureWidth;
      const std::size_t y = i / kPictureWidth;
      image_.y[i] = static_cast<std::uint8_t>(x + 2 * y);
      image_.cr[i] = static_cast<std::uint8_t>(2 * y);
      image_.cb[i] = static_cast<std::uint8_t>(x);
      image_.y_lh[i] = 100;
      image_.y_hl[i] = 150;
      image_.y_hh[i] = 77;
    }
  }

  const YCrCbImage& picture(const CameraPose&, double, longword, const CameraSettings&) override { return image_; }

 private:
  YCrCbImage image_;
};

OFbkImage bandOf(RCRegion* region, OFbkImageLayer layer, OFbkImageBand band) {
  void* const base = region->Base();
  auto* const vector = static_cast<OFbkImageVectorData*>(base);
  return OFbkImage(vector->GetInfo(layer), vector->GetData(layer), band);
}

class CameraTest : public testing::Test {
 protected:
  TestPicture source_;
  Camera camera_{source_, kId};
};

TEST_F(CameraTest, TheBandsOfHAreThePictureWithATagThatCountsTheCamerasImages) {
  const longword frame = 100000000;
  RCRegion* region = camera_.capture(frame);
  const OFbkImage luminance = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y);
  const OFbkImage red = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Cr);
  const OFbkImage blue = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Cb);
  EXPECT_EQ(luminance.FieldCounter(), imagesUpTo(frame) % 65536) << "before it is drawn";
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 208; ++x) {
      if (y < 159 || x >= 16) {
        ASSERT_EQ(luminance.Pixel(x, y), (x + 2 * y) % 256);
      }
      ASSERT_EQ(red.Pixel(x, y), (2 * y) % 256);
      ASSERT_EQ(blue.Pixel(x, y), x);
    }
  }
  EXPECT_EQ(luminance.FieldCounter(), imagesUpTo(frame) % 65536) << "and afterwards";
  for (const auto& [band, value] :
       {std::pair(ofbkimageBAND_Y_LH, 100), {ofbkimageBAND_Y_HL, 150}, {ofbkimageBAND_Y_HH, 77}}) {
    EXPECT_EQ(bandOf(region, ofbkimageLAYER_H, band).Pixel(207, 159), value);
  }
}

// The equations of Sony's sample W3AIBO (JPEGEncoder.cc) put each layer together from the next lower one.
TEST_F(CameraTest, ALayerIsReconstructedFromTheBandsOfTheNextLowerOne) {
  RCRegion* region = camera_.capture(0);
  for (const OFbkImageLayer layer : {ofbkimageLAYER_M, ofbkimageLAYER_L}) {
    const OFbkImage higher = bandOf(region, layer - 1, ofbkimageBAND_Y);
    const OFbkImage low = bandOf(region, layer, ofbkimageBAND_Y);
    for (int y = 0; y < low.Height() - 1; ++y) {  // the last row has the tag
      for (int x = 0; x < low.Width(); ++x) {
        const int ll = low.Pixel(x, y);
        const int lh = bandOf(region, layer, ofbkimageBAND_Y_LH).Pixel(x, y) - 128;
        const int hl = bandOf(region, layer, ofbkimageBAND_Y_HL).Pixel(x, y) - 128;
        const int hh = bandOf(region, layer, ofbkimageBAND_Y_HH).Pixel(x, y) - 128;
        ASSERT_NEAR(higher.Pixel(2 * x, 2 * y), ll - lh - hl + hh, 2);
        ASSERT_NEAR(higher.Pixel(2 * x + 1, 2 * y), ll - lh + hl - hh, 2);
        ASSERT_NEAR(higher.Pixel(2 * x, 2 * y + 1), ll + lh - hl - hh, 2);
        ASSERT_NEAR(higher.Pixel(2 * x + 1, 2 * y + 1), ll + lh + hl + hh, 2);
      }
    }
  }
}

TEST_F(CameraTest, DetectedColoursAreInTheirPlaneAndCountedInEveryTag) {
  OCdtVectorData tables{};
  tables.SetNumData(2);
  tables.GetInfo(0)->Init(kId, ocdtCHANNEL1);
  tables.GetInfo(1)->Init(kId, ocdtCHANNEL4);
  for (int segment = 0; segment < ocdtMAX_Y_SEGMENT; ++segment) {
    tables.GetInfo(0)->Set(segment, 41, 41, 255, 0);  // Cr of the rows 10 and 74 of layer M
    tables.GetInfo(1)->Set(segment, 255, 0, 255, 0);  // everything
  }
  ASSERT_EQ(camera_.colors().load(tables), oSUCCESS);
  RCRegion* region = camera_.capture(0);
  const OFbkImage plane = bandOf(region, ofbkimageLAYER_C, ofbkimageBAND_CDT);
  EXPECT_EQ(plane.Width(), 104);
  EXPECT_EQ(plane.Height(), 80);
  EXPECT_EQ(plane.Pixel(50, 9), ocdtCHANNEL4);
  EXPECT_EQ(plane.Pixel(50, 10), ocdtCHANNEL1 | ocdtCHANNEL4);
  for (const OFbkImage& image :
       {plane, bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y), bandOf(region, ofbkimageLAYER_L, ofbkimageBAND_Y)}) {
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL0), 0);
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL1), 2 * 104 / 16);
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL4), 255) << "as far as a byte goes";
  }
  camera_.reset();
  EXPECT_EQ(bandOf(camera_.capture(4), ofbkimageLAYER_C, ofbkimageBAND_CDT).Pixel(50, 10), 0);
}

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
