#include "picture_encoder/JpegEncoder.h"

#include <gtest/gtest.h>

#include <array>

#include "picture_checks.h"
#include "picture_encoder/PictureJob.h"
#include "support/camera_image_fixture.h"

namespace {

using test_support::CameraImageFixture;
using Pixel = CameraImageFixture::Pixel;

// The source as RGB, by the equations of JFIF, without the tag.
std::array<double, 3> rgbOf(const CameraImage& image, size_t x, size_t y) {
  const size_t row = y == image.height - 1 && x < CameraImage::TAG_SIZE ? y - 1 : y;
  const double luminance = image.y[row * image.stride + x];
  const double cb = image.cb[row * image.stride + x] - 128.0;
  const double cr = image.cr[row * image.stride + x] - 128.0;
  const auto clip = [](double value) { return std::min(255.0, std::max(0.0, value)); };
  return {clip(luminance + 1.402 * cr), clip(luminance - 0.344136 * cb - 0.714136 * cr), clip(luminance + 1.772 * cb)};
}

double psnr(const CameraImage& image, const Decoded& decoded) {
  double error = 0;
  for (size_t y = 0; y < image.height; ++y) {
    for (size_t x = 0; x < image.width; ++x) {
      const std::array<double, 3> source = rgbOf(image, x, y);
      for (size_t channel = 0; channel < 3; ++channel) {
        const double difference = source[channel] - decoded.rgb[3 * (y * image.width + x) + channel];
        error += difference * difference;
      }
    }
  }
  return 10 * std::log10(255.0 * 255.0 * 3.0 * static_cast<double>(image.width * image.height) / error);
}

class JpegEncoderTest : public ::testing::Test {
 protected:
  std::vector<uint8_t> encode(const CameraImage& image, int quality) {
    std::vector<uint8_t> jpeg(ENCODED_PICTURE_CAPACITY);
    jpeg.resize(encoder_.Encode(image, quality, jpeg.data(), jpeg.size()));
    EXPECT_FALSE(jpeg.empty()) << encoder_.LastError();
    return jpeg;
  }

  JpegEncoder encoder_;
};

TEST_F(JpegEncoderTest, MakesABaselineJpegOf208x160WithHalvedChroma) {
  const CameraImageFixture scene = CameraImageFixture::scene();
  const std::vector<uint8_t> jpeg = encode(scene.image(), 85);
  const Decoded decoded = decodeJpeg(jpeg);
  EXPECT_EQ(decoded.subsampling, TJSAMP_420);
  EXPECT_EQ(decoded.colorspace, TJCS_YCbCr);
  EXPECT_GT(psnr(scene.image(), decoded), 33.0);
  EXPECT_GT(jpeg.size(), 3000U);
  EXPECT_LT(jpeg.size(), 7000U);
  const std::string text(jpeg.begin(), jpeg.end());
  EXPECT_EQ(text.substr(0, 3), "\xff\xd8\xff");
  EXPECT_EQ(text.substr(text.size() - 2), "\xff\xd9");
  EXPECT_NE(text.find(std::string("\xff\xc0\x00\x11\x08", 5)), std::string::npos) << "no SOF0: not baseline";
}

// The layers of the ERS-7, double resolution, the layers of the ERS-210, and sizes that no macroblock divides.
TEST_F(JpegEncoderTest, EachSizeIsEncodedCompletelyWithoutReadingBeyondTheImage) {
  const std::pair<size_t, size_t> sizes[] = {{208, 160}, {104, 80}, {52, 40}, {416, 320}, {176, 144}, {88, 72},
                                             {44, 36},   {33, 17},  {32, 19}, {15, 3},    {1, 2}};
  for (const auto& [width, height] : sizes) {
    CameraImageFixture scene = CameraImageFixture::scene(width, height);
    if (width >= CameraImage::TAG_SIZE) {
      scene.setTag(255, 0xffff);
    }
    const Decoded decoded = decodeJpeg(encode(scene.image(), 95));
    EXPECT_EQ(decoded.width, static_cast<int>(width));
    EXPECT_EQ(decoded.height, static_cast<int>(height));
    EXPECT_GT(psnr(scene.image(), decoded), 30.0) << width << " x " << height;
  }
}

TEST_F(JpegEncoderTest, NoiseAtQuality100Fits) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> level(0, 255);
  const auto any = [&] { return static_cast<uint8_t>(level(random)); };
  const CameraImageFixture noise(208, 160, [&](size_t, size_t) { return Pixel{any(), any(), any()}; });
  const std::size_t size = encode(noise.image(), 100).size();
  EXPECT_GT(size, 64U * 1024U) << "the report's buffer would have been enough";
  EXPECT_LE(size, 101888U) << "no picture has more, says docs/protocol.md";
}

TEST_F(JpegEncoderTest, WhatCannotBeEncodedSaysWhy) {
  const CameraImageFixture scene = CameraImageFixture::scene(208, 160);
  std::vector<uint8_t> jpeg(100);
  EXPECT_EQ(encoder_.Encode(scene.image(), 85, jpeg.data(), jpeg.size()), 0U);
  EXPECT_STRNE(encoder_.LastError(), "") << "the buffer is too small";
  CameraImage empty = scene.image();
  empty.width = 0;
  EXPECT_EQ(encoder_.Encode(empty, 85, jpeg.data(), jpeg.size()), 0U);
  EXPECT_STREQ(encoder_.LastError(), "cannot encode 0 x 160 pixels: 1 x 2 to 416 x 320 is possible");
}

// The equations of Sony's sample W3AIBO (JPEGEncoder.cc, ReconstructAndConvertYCbCr), with its names, as a picture of
// twice the size.
CameraImageFixture reconstructed(const CameraImageFixture& bands) {
  const CameraImage image = bands.image();
  const DetailBands detail = bands.detail();
  const auto clip = [](int value) { return static_cast<uint8_t>(std::min(255, std::max(0, value))); };
  return CameraImageFixture(2 * image.width, 2 * image.height, [&](size_t x, size_t y) {
    const size_t row = y / 2 == image.height - 1 && x / 2 < CameraImage::TAG_SIZE ? y / 2 - 1 : y / 2;
    const size_t at = row * image.stride + x / 2;
    const int ll = image.y[at];
    const int lh = detail.lh[at] - 128;
    const int hl = detail.hl[at] - 128;
    const int hh = detail.hh[at] - 128;
    const int a = ll + lh + hl + hh;
    const int pixels[2][2] = {{2 * (ll + hh) - a, 2 * (ll + hl) - a}, {2 * (ll + lh) - a, a}};
    return Pixel{clip(pixels[y % 2][x % 2]), image.cb[at], image.cr[at]};
  });
}

TEST_F(JpegEncoderTest, DoubleResolutionIsThePictureThatSonysSampleReconstructs) {
  for (const size_t width : {size_t{208}, size_t{176}, size_t{33}, size_t{7}}) {
    CameraImageFixture scene = CameraImageFixture::scene(width, 20);
    std::minstd_rand random(3);
    scene.setDetail([&](size_t, size_t, size_t) { return static_cast<uint8_t>(random() % 256); });
    scene.setTag(255, 0xffff);
    std::vector<uint8_t> jpeg(ENCODED_PICTURE_CAPACITY);
    jpeg.resize(encoder_.EncodeDouble(scene.image(), scene.detail(), 95, jpeg.data(), jpeg.size()));
    ASSERT_FALSE(jpeg.empty()) << encoder_.LastError();
    EXPECT_EQ(decodeJpeg(jpeg).width, static_cast<int>(2 * width));
    EXPECT_GT(psnr(reconstructed(scene).image(), decodeJpeg(jpeg)), 20.0) << width;
  }
}

}  // namespace
