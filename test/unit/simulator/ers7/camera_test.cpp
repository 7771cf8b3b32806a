#include "simulator/ers7/camera/camera.h"

#include <OPENR/OFbkImage.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

TEST(CameraTiming, FiveOfSixImagesComeAfter32MillisecondsAndTheOthersAfter40) {
  std::map<longword, int> gaps;
  longword last = 0;
  for (longword frame = 1; frame <= 125 * 60; ++frame) {
    if (imagesUpTo(frame) != imagesUpTo(frame - 1)) {
      EXPECT_EQ(imagesUpTo(frame), imagesUpTo(frame - 1) + 1);
      ++gaps[frame - last];
      last = frame;
    }
  }
  ASSERT_EQ(gaps.size(), 2u);
  const double share_of_32 = static_cast<double>(gaps[4]) / (gaps[4] + gaps[5]);
  EXPECT_NEAR(share_of_32, 0.82, 0.02);
}

TEST(CameraTiming, TheMeanIs33Point47Milliseconds) {
  const longword frames = 125 * 3600;
  EXPECT_NEAR(frames * openr_host::kFrameSeconds / imagesUpTo(frames), 0.03347, 0.00001);
}

TEST(CameraTiming, TheFirstImageComesInTheFirstFrame) {
  EXPECT_EQ(imagesUpTo(0), 1u);
  EXPECT_EQ(imagesUpTo(1), 1u);
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

  void setHead(const HeadAngles& angles) override { last_head_pan = angles.head_pan; }
  void setBody(const Eigen::Isometry3d& in_room) override { last_x = in_room.translation().x(); }
  const YCrCbImage& picture(double seconds, longword image_number, const CameraSettings& settings) override {
    ++times_drawn;
    last_seconds = seconds;
    last_image_number = image_number;
    last_settings = settings;
    return shows_other ? other_ : image_;
  }

  bool hasConstantPictures() const override { return is_constant; }
  void setFirstPixel(byte y) { image_.y[0] = y; }

  bool is_constant = false;
  bool shows_other = false;
  int times_drawn = 0;
  double last_head_pan = -1;
  double last_x = -1;
  double last_seconds = -1;
  longword last_image_number = 0;
  CameraSettings last_settings;

 private:
  YCrCbImage image_;
  YCrCbImage other_;
};

OFbkImageVectorData* vectorIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OFbkImageVectorData*>(base);
}

OFbkImage bandOf(RCRegion* region, OFbkImageLayer layer, OFbkImageBand band) {
  return OFbkImage(vectorIn(region)->GetInfo(layer), vectorIn(region)->GetData(layer), band);
}

class CameraTest : public testing::Test {
 protected:
  TestPicture source_;
  Camera camera_{source_, kId};
};

TEST_F(CameraTest, TheNextImageIsKnownInAdvance) {
  for (longword frame = 0; frame < 1000; ++frame) {
    const longword next = imageAfter(frame);
    EXPECT_EQ(imagesUpTo(next), imagesUpTo(frame) + 1);
    EXPECT_EQ(imagesUpTo(next - 1), imagesUpTo(frame));
  }
}

TEST_F(CameraTest, EveryImageIsDueOnceInItsFrame) {
  for (longword frame = 0; frame < 1000; ++frame) {
    const bool expected = frame == 0 || imagesUpTo(frame) != imagesUpTo(frame - 1);
    EXPECT_EQ(camera_.imageDue(frame), expected) << "frame " << frame;
    EXPECT_FALSE(camera_.imageDue(frame));
  }
}

TEST_F(CameraTest, AnImageThatWasDueInASkippedFrameIsDueNow) {
  EXPECT_TRUE(camera_.imageDue(0));
  EXPECT_TRUE(camera_.imageDue(31)) << "once, even if there were several";
  EXPECT_FALSE(camera_.imageDue(31));
}

TEST_F(CameraTest, TheLayersHaveTheSizesOfTheErs7) {
  RCRegion* region = camera_.capture(0);
  const int sizes[][2] = {{208, 160}, {104, 80}, {52, 40}};
  for (const OFbkImageLayer layer : {ofbkimageLAYER_H, ofbkimageLAYER_M, ofbkimageLAYER_L}) {
    for (const OFbkImageBand band : {ofbkimageBAND_Y, ofbkimageBAND_Cr, ofbkimageBAND_Cb}) {
      const OFbkImage image = bandOf(region, layer, band);
      ASSERT_TRUE(image.IsValid());
      EXPECT_EQ(image.Width(), sizes[layer][0]);
      EXPECT_EQ(image.Height(), sizes[layer][1]);
      EXPECT_EQ(image.Skip(), 5 * image.Width());
    }
  }
  EXPECT_TRUE(bandOf(region, ofbkimageLAYER_C, ofbkimageBAND_CDT).IsValid());
}

TEST_F(CameraTest, TheBandsOfHAreThePictureCrBeforeCb) {
  RCRegion* region = camera_.capture(0);
  const OFbkImage luminance = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y);
  const OFbkImage red = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Cr);
  const OFbkImage blue = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Cb);
  EXPECT_EQ(red.Pointer(), luminance.Pointer() + 208);
  EXPECT_EQ(blue.Pointer(), luminance.Pointer() + 2 * 208);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 208; ++x) {
      if (y < 159 || x >= 16) {
        ASSERT_EQ(luminance.Pixel(x, y), (x + 2 * y) % 256);
      }
      ASSERT_EQ(red.Pixel(x, y), (2 * y) % 256);
      ASSERT_EQ(blue.Pixel(x, y), x);
    }
  }
}

TEST_F(CameraTest, TheLowerLayersAreMeansOfTheHigherOnes) {
  RCRegion* region = camera_.capture(0);
  const OFbkImage medium = bandOf(region, ofbkimageLAYER_M, ofbkimageBAND_Cr);
  const OFbkImage low = bandOf(region, ofbkimageLAYER_L, ofbkimageBAND_Cb);
  EXPECT_EQ(medium.Pixel(50, 10), 2 * 20 + 1);
  EXPECT_EQ(low.Pixel(10, 20), 4 * 10 + 2);
  const OFbkImage luminance = bandOf(region, ofbkimageLAYER_M, ofbkimageBAND_Y);
  EXPECT_EQ(luminance.Pixel(30, 20), 2 * 30 + 4 * 20 + 2);
}

TEST_F(CameraTest, TheFineDetailOfHIsThatOfThePicture) {
  RCRegion* region = camera_.capture(0);
  const std::pair<OFbkImageBand, int> bands[] = {
      {ofbkimageBAND_Y_LH, 100}, {ofbkimageBAND_Y_HL, 150}, {ofbkimageBAND_Y_HH, 77}};
  for (const auto& [band, value] : bands) {
    const OFbkImage detail = bandOf(region, ofbkimageLAYER_H, band);
    ASSERT_TRUE(detail.IsValid());
    EXPECT_EQ(detail.Pixel(0, 0), value);
    EXPECT_EQ(detail.Pixel(207, 159), value);
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
  tables.SetNumData(3);
  tables.GetInfo(2)->Init(kId, ocdtCHANNEL6);
  tables.GetInfo(0)->Init(kId, ocdtCHANNEL1);
  tables.GetInfo(1)->Init(kId, ocdtCHANNEL4);
  for (int segment = 0; segment < ocdtMAX_Y_SEGMENT; ++segment) {
    tables.GetInfo(0)->Set(segment, 41, 41, 255, 0);  // Cr of the rows 10 and 74 of layer M
    tables.GetInfo(1)->Set(segment, 255, 0, 255, 0);  // everything
    tables.GetInfo(2)->Set(segment, 45, 41, 255, 0);  // the rows 10 to 11 and 74 to 75
  }
  ASSERT_EQ(camera_.colors().load(tables), oSUCCESS);
  RCRegion* region = camera_.capture(0);
  const OFbkImage plane = bandOf(region, ofbkimageLAYER_C, ofbkimageBAND_CDT);
  EXPECT_EQ(plane.Width(), 104);
  EXPECT_EQ(plane.Height(), 80);
  EXPECT_EQ(plane.Pixel(50, 9), ocdtCHANNEL4);
  EXPECT_EQ(plane.Pixel(50, 10), ocdtCHANNEL1 | ocdtCHANNEL4 | ocdtCHANNEL6);
  for (const OFbkImage& image :
       {plane, bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y), bandOf(region, ofbkimageLAYER_L, ofbkimageBAND_Y)}) {
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL0), 0);
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL1), 2 * 104 / 16);
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL4), 255) << "as far as a byte goes";
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL5), 0);
    EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL6), 4 * 104 / 16);
    EXPECT_EQ(image.FieldCounter(), 1);
  }
  EXPECT_EQ(bandOf(camera_.capture(4), ofbkimageLAYER_H, ofbkimageBAND_Y).ColorFrequency(ocdtCHANNEL4), 255)
      << "also if nothing else is read";
  camera_.reset();
  EXPECT_EQ(bandOf(camera_.capture(8), ofbkimageLAYER_C, ofbkimageBAND_CDT).Pixel(50, 10), 0);
}

TEST_F(CameraTest, TheTagInTheLastRowCountsTheCamerasImages) {
  const longword frame = 100000000;
  RCRegion* region = camera_.capture(frame);
  const longword number = imagesUpTo(frame);
  ASSERT_GT(number, 1U << 24);
  const OFbkImage luminance = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y);
  EXPECT_EQ(luminance.FieldCounter(), number % 65536) << "before it is drawn";
  EXPECT_EQ(luminance.Pixel(2, 159) + 256 * luminance.Pixel(3, 159), static_cast<int>(number / 65536));
  EXPECT_EQ(luminance.FieldCounter(), number % 65536) << "and afterwards";
  for (int x = 4; x < 16; ++x) {
    EXPECT_EQ(luminance.Pixel(x, 159), 0);
  }
  EXPECT_EQ(luminance.Pixel(16, 159), (16 + 2 * 159) % 256);
  EXPECT_EQ(source_.last_image_number, number);
  EXPECT_DOUBLE_EQ(source_.last_seconds, 100000000 * 0.008);
}

TEST_F(CameraTest, APictureIsDrawnWhenItIsReadAsItWasWhenItWasTaken) {
  longword shutter = ocamparamSHUTTER_FAST;
  camera_.control(oprmreqCAM_SET_SHUTTER_SPEED, &shutter, sizeof(shutter));
  CameraPose pose;
  pose.head.head_pan = 0.3;
  pose.body = Eigen::Translation3d(2, 0, 0);
  RCRegion* early = camera_.capture(100, pose);
  early->AddReference();
  camera_.reset();
  camera_.capture(104);
  EXPECT_EQ(source_.times_drawn, 0);

  EXPECT_EQ(bandOf(early, ofbkimageLAYER_M, ofbkimageBAND_Cr).Pixel(50, 10), 2 * 20 + 1);
  EXPECT_EQ(source_.times_drawn, 1);
  EXPECT_DOUBLE_EQ(source_.last_seconds, 0.8);
  EXPECT_EQ(source_.last_image_number, imagesUpTo(100));
  EXPECT_DOUBLE_EQ(source_.last_head_pan, 0.3);
  EXPECT_DOUBLE_EQ(source_.last_x, 2);
  EXPECT_EQ(source_.last_settings.shutter, static_cast<longword>(ocamparamSHUTTER_FAST));
  early->RemoveReference();
}

TEST_F(CameraTest, OnlyWhatIsReadIsWrittenWithoutDrawingThePictureAgain) {
  RCRegion* region = camera_.capture(0);
  const OFbkImage detail = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y_LH);
  const byte* const unread = vectorIn(region)->GetData(ofbkimageLAYER_H) + 3 * 208;
  EXPECT_EQ(bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Cr).Pixel(50, 10), 20);
  EXPECT_EQ(*unread, 128);
  EXPECT_EQ(detail.Pixel(0, 0), 100);
  EXPECT_EQ(bandOf(region, ofbkimageLAYER_M, ofbkimageBAND_Cr).Pixel(50, 10), 2 * 20 + 1);
  EXPECT_EQ(*unread, 100);
  EXPECT_EQ(source_.times_drawn, 1);
}

TEST_F(CameraTest, AnImageThatIsReadLaterThanTheNextOneIsDrawnAsItWas) {
  RCRegion* early = camera_.capture(100);
  early->AddReference();
  bandOf(early, ofbkimageLAYER_H, ofbkimageBAND_Y).Pixel(0, 0);
  bandOf(camera_.capture(104), ofbkimageLAYER_H, ofbkimageBAND_Y).Pixel(0, 0);
  EXPECT_DOUBLE_EQ(source_.last_seconds, 104 * 0.008);
  bandOf(early, ofbkimageLAYER_L, ofbkimageBAND_Y).Pixel(0, 0);
  EXPECT_DOUBLE_EQ(source_.last_seconds, 0.8);
  EXPECT_EQ(source_.times_drawn, 3);
  early->RemoveReference();
}

TEST_F(CameraTest, ARegionThatIsUsedAgainShowsTheNewPicture) {
  RCRegion* region = camera_.capture(100);
  bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y).Pixel(0, 0);
  ASSERT_EQ(camera_.capture(104), region);
  bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y).Pixel(0, 0);
  EXPECT_EQ(source_.times_drawn, 2);
}

TEST_F(CameraTest, AConstantPictureIsWrittenToARegionOnce) {
  source_.is_constant = true;
  const auto firstPixel = [this](longword frame, OFbkImageLayer first_read) {
    RCRegion* region = camera_.capture(frame);
    bandOf(region, first_read, ofbkimageBAND_Y).Pixel(0, 0);
    const OFbkImage luminance = bandOf(region, ofbkimageLAYER_H, ofbkimageBAND_Y);
    EXPECT_EQ(luminance.FieldCounter(), imagesUpTo(frame));
    return luminance.Pixel(0, 0);
  };
  EXPECT_EQ(firstPixel(100, ofbkimageLAYER_H), 0);
  source_.setFirstPixel(7);  // against the promise, to see whether it is written
  EXPECT_EQ(firstPixel(104, ofbkimageLAYER_H), 0);
  EXPECT_EQ(firstPixel(108, ofbkimageLAYER_M), 7) << "with everything";
}

TEST_F(CameraTest, AConstantPictureIsWrittenAgainAfterAnotherOne) {
  source_.is_constant = true;
  source_.setFirstPixel(7);
  const auto firstPixel = [this](longword frame) {
    return bandOf(camera_.capture(frame), ofbkimageLAYER_H, ofbkimageBAND_Y).Pixel(0, 0);
  };
  EXPECT_EQ(firstPixel(100), 7);
  source_.shows_other = true;
  bandOf(camera_.capture(104), ofbkimageLAYER_M, ofbkimageBAND_Y).Pixel(0, 0);  // draws everything
  source_.shows_other = false;
  EXPECT_EQ(firstPixel(108), 7);
}

TEST_F(CameraTest, TheInfosContainCameraAndFrame) {
  RCRegion* const region = camera_.capture(1234);
  OFbkImageVectorData* vector = vectorIn(region);
  const ODataVectorInfo& header = vector->vectorInfo;
  EXPECT_EQ(header.type, odataFBKIMAGE_VECTOR);
  EXPECT_EQ(header.totalSize, region->Size());
  EXPECT_EQ(header.infoOffset, offsetof(OFbkImageVectorData, info));
  EXPECT_EQ(header.infoSize, sizeof(OFbkImageInfo));
  EXPECT_EQ(header.maxNumData, 4u);
  EXPECT_EQ(header.numData, 4u);
  for (const OFbkImageLayer layer : {ofbkimageLAYER_H, ofbkimageLAYER_M, ofbkimageLAYER_L, ofbkimageLAYER_C}) {
    EXPECT_EQ(vector->GetInfo(layer)->primitiveID, kId);
    EXPECT_EQ(vector->GetInfo(layer)->frameNumber, 1234u);
  }
  EXPECT_EQ(vector->GetInfo(ofbkimageLAYER_H)->dataSize, 6u * 208 * 160);
}

TEST_F(CameraTest, ARegionIsReusedOnlyWhenNothingElseRefersToIt) {
  RCRegion* kept = camera_.capture(0);
  kept->AddReference();
  RCRegion* other = camera_.capture(4);
  EXPECT_NE(other, kept);
  EXPECT_EQ(vectorIn(kept)->GetInfo(ofbkimageLAYER_H)->frameNumber, 0u);
  kept->RemoveReference();
  std::set<RCRegion*> used;
  for (longword frame = 8; frame < 40; frame += 4) {
    used.insert(camera_.capture(frame));
  }
  EXPECT_EQ(used.size(), 1u);
}

}  // namespace
}  // namespace simulated_ers7
