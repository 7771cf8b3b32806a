#include "camera/jpeg_decoder.h"

#include <gmock/gmock.h>
#include <turbojpeg.h>

#include <array>
#include <cstdint>

#include "support/refusal.h"

namespace aibo_driver::camera {
namespace {

constexpr int kWidth = 208;  // report, section 2.1.2
constexpr int kHeight = 160;

// Left half pure blue, right half a ramp from black to white, from top to bottom.
std::vector<std::uint8_t> makeScene() {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto grey = static_cast<std::uint8_t>(255 * y / kHeight);
      if (x < kWidth / 2) {
        pixels.insert(pixels.end(), {255, 0, 0});
      } else {
        pixels.insert(pixels.end(), {grey, grey, grey});
      }
    }
  }
  return pixels;
}

std::vector<std::uint8_t> encode() {
  const std::vector<std::uint8_t> pixels = makeScene();
  const tjhandle compressor = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const int result =
      tjCompress2(compressor, pixels.data(), kWidth, 0, kHeight, TJPF_BGR, &data, &size, TJSAMP_420, 95, 0);
  EXPECT_EQ(result, 0) << tjGetErrorStr2(compressor);
  std::vector<std::uint8_t> jpeg(data, data + size);
  tjFree(data);
  tjDestroy(compressor);
  return jpeg;
}

std::string decodingRefusal(const std::vector<std::uint8_t>& jpeg) {
  return test_support::refusalOf<DecodeException>([&] { decodeJpeg(jpeg.data(), jpeg.size()); });
}

TEST(DecodeJpeg, DecodesToBlueGreenRedFromTopToBottom) {
  const std::vector<std::uint8_t> jpeg = encode();
  const BgrImage image = decodeJpeg(jpeg.data(), jpeg.size());
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  const std::vector<std::uint8_t> scene = makeScene();
  ASSERT_EQ(image.pixels.size(), scene.size());
  double error = 0.0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const double difference = static_cast<double>(scene[i]) - static_cast<double>(image.pixels[i]);
    error += difference * difference;
  }
  EXPECT_LT(error / static_cast<double>(scene.size()), 40.0);
}

TEST(DecodeJpeg, RefusesDamagedCompressedDataInsteadOfReturningHalfAPicture) {
  std::vector<std::uint8_t> jpeg = encode();
  // The decoder only warns of an end-of-image marker in the middle.
  jpeg.erase(jpeg.begin() + static_cast<std::ptrdiff_t>(jpeg.size() - jpeg.size() / 3), jpeg.end() - 2);
  EXPECT_THAT(decodingRefusal(jpeg), testing::HasSubstr("the compressed data is damaged"));
}

TEST(DecodeJpeg, DoesNotDecodeAPictureWithATableOfThePictureBefore) {
  std::vector<std::uint8_t> jpeg = encode();
  ASSERT_EQ(decodingRefusal(jpeg), "");
  constexpr std::array<std::uint8_t, 2> kQuantizationTable = {0xFF, 0xDB};
  constexpr std::uint8_t kApplicationData = 0xEF;  // which decoders skip
  const auto last = std::find_end(jpeg.begin(), jpeg.end(), kQuantizationTable.begin(), kQuantizationTable.end());
  ASSERT_NE(last, jpeg.end());
  *(last + 1) = kApplicationData;
  EXPECT_THAT(decodingRefusal(jpeg), testing::HasSubstr("the compressed data is damaged"));
}

}  // namespace
}  // namespace aibo_driver::camera
