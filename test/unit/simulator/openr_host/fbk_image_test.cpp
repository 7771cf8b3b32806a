#include <OPENR/OFbkImage.h>
#include <OPENR/RCRegion.h>
#include <gtest/gtest.h>

#include <vector>

#include "simulator/openr_host/objects/filled_on_read.h"

namespace {

constexpr int kWidth = 20;
constexpr int kHeight = 3;

OFbkImageInfo infoOf(ODataType type) {
  OFbkImageInfo info{};
  info.type = type;
  info.width = kWidth;
  info.height = kHeight;
  return info;
}

TEST(OFbkImageTest, FindsEachBandInTheInterleavedRows) {
  OFbkImageInfo info = infoOf(odataFBK_YCrCb_HPF);
  std::vector<byte> data(6 * kWidth * kHeight);
  for (std::size_t i = 0; i < data.size(); ++i) {
    data[i] = static_cast<byte>(i / kWidth);  // the number of the interleaved row
  }
  const std::vector<OFbkImageBand> bands = {ofbkimageBAND_Y,    ofbkimageBAND_Cr,   ofbkimageBAND_Cb,
                                            ofbkimageBAND_Y_LH, ofbkimageBAND_Y_HL, ofbkimageBAND_Y_HH};
  for (std::size_t band = 0; band < bands.size(); ++band) {
    const OFbkImage image(&info, data.data(), bands[band]);
    ASSERT_TRUE(image.IsValid());
    EXPECT_EQ(image.Width(), kWidth);
    EXPECT_EQ(image.Height(), kHeight);
    EXPECT_EQ(image.Skip(), 5 * kWidth);
    for (int y = 0; y < kHeight; ++y) {
      EXPECT_EQ(image.Pixel(0, y), 6 * y + static_cast<int>(band));
      EXPECT_EQ(image.Pixel(kWidth - 1, y), 6 * y + static_cast<int>(band));
      EXPECT_EQ(&image.Pointer()[y * (image.Width() + image.Skip())],
                &data[static_cast<std::size_t>(6 * y * kWidth) + band * kWidth]);
    }
  }
}

TEST(OFbkImageTest, ALayerOfThreeBandsHasNoFineDetail) {
  OFbkImageInfo info = infoOf(odataFBK_YCrCb);
  std::vector<byte> data(3 * kWidth * kHeight);
  EXPECT_EQ(OFbkImage(&info, data.data(), ofbkimageBAND_Cb).Skip(), 2 * kWidth);
  EXPECT_FALSE(OFbkImage(&info, data.data(), ofbkimageBAND_Y_LH).IsValid());
  EXPECT_FALSE(OFbkImage(&info, data.data(), ofbkimageBAND_CDT).IsValid());
}

TEST(OFbkImageTest, TheLayerOfTheColourDetectionHasOneBand) {
  OFbkImageInfo info = infoOf(odataFBK_CDT);
  std::vector<byte> data(kWidth * kHeight);
  EXPECT_TRUE(OFbkImage(&info, data.data(), ofbkimageBAND_CDT).IsValid());
  EXPECT_EQ(OFbkImage(&info, data.data(), ofbkimageBAND_CDT).Skip(), 0);
  EXPECT_FALSE(OFbkImage(&info, data.data(), ofbkimageBAND_Y).IsValid());
}

TEST(OFbkImageTest, ReadsTheTagBytesOfTheLastRow) {
  OFbkImageInfo info = infoOf(odataFBK_CDT);
  std::vector<byte> data(kWidth * kHeight);
  byte* tag = &data[(kHeight - 1) * kWidth];
  for (int i = 0; i < 16; ++i) {
    tag[i] = static_cast<byte>(0x10 + i);
  }
  const OFbkImage image(&info, data.data(), ofbkimageBAND_CDT);
  EXPECT_EQ(image.FieldCounter(), 0x1110);
  EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL0), 0x18);
  EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL3), 0x1b);
  EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL4), 0x14);
  EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL7), 0x17);
  EXPECT_EQ(image.ColorFrequency(ocdtCHANNEL_UNDEF), 0);
}

/// An image that is drawn when it is read, next to bytes that are not part of it.
class UnreadImageTest : public testing::Test {
 protected:
  void announce() {
    pixels_.fillBy([this] { ++times_drawn_; });
  }

  OFbkImageInfo info_ = infoOf(odataFBK_CDT);
  std::vector<byte> data_ = std::vector<byte>(3 * kWidth * kHeight);
  byte* const middle_ = data_.data() + kWidth * kHeight;
  openr_host::FilledOnRead pixels_{middle_, kWidth* kHeight};
  const OFbkImage image_{&info_, middle_, ofbkimageBAND_CDT};
  int times_drawn_ = 0;
};

TEST_F(UnreadImageTest, IsDrawnOnceWhenItsPixelsAreRead) {
  announce();
  EXPECT_EQ(times_drawn_, 0);
  EXPECT_EQ(image_.Pointer(), middle_);
  EXPECT_EQ(times_drawn_, 1);
  image_.Pixel(0, 0);
  EXPECT_EQ(times_drawn_, 1);
  announce();
  image_.Pixel(0, 0);
  EXPECT_EQ(times_drawn_, 2);
}

TEST_F(UnreadImageTest, IsDrawnForTheColourDetectionButNotForTheFieldCounter) {
  announce();
  image_.FieldCounter();
  EXPECT_EQ(times_drawn_, 0);
  image_.ColorFrequency(ocdtCHANNEL0);
  EXPECT_EQ(times_drawn_, 1);
}

TEST_F(UnreadImageTest, IsReplacedByTheNextOneInItsMemory) {
  int first_drawn = 0;
  pixels_.fillBy([&] { ++first_drawn; });
  announce();
  image_.Pointer();
  EXPECT_EQ(first_drawn, 0);
  EXPECT_EQ(times_drawn_, 1);
}

TEST_F(UnreadImageTest, IsNotDrawnForOneInOtherMemory) {
  announce();
  OFbkImage(&info_, data_.data(), ofbkimageBAND_CDT).Pointer();
  OFbkImage(&info_, middle_ + kWidth * kHeight, ofbkimageBAND_CDT).Pointer();
  EXPECT_EQ(times_drawn_, 0);
}

TEST(RCRegionTest, StartsWithItsCreatorsReference) {
  auto* region = new RCRegion(100);
  EXPECT_EQ(region->NumberOfReference(), 1);
  EXPECT_EQ(region->Size(), 100U);
  region->AddReference();
  EXPECT_EQ(region->NumberOfReference(), 2);
  region->RemoveReference();
  EXPECT_EQ(region->NumberOfReference(), 1);
  region->RemoveReference();  // a sanitizer's leak check shows that it is deleted
}

TEST(RCRegionTest, RefersToMemoryThatIsOwnedElsewhere) {
  byte memory[8] = {};
  auto* region = new RCRegion(5, 16, memory, sizeof(memory));
  EXPECT_EQ(region->Base(), reinterpret_cast<char*>(memory));
  EXPECT_EQ(region->MemID(), 5U);
  EXPECT_EQ(region->Offset(), 16U);
  region->RemoveReference();
}

}  // namespace
