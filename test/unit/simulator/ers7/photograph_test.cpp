#include "simulator/ers7/camera/photographs.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <turbojpeg.h>

namespace simulated_ers7 {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Paint = std::function<std::string(int x, int y)>;  ///< three characters: red, green, blue

const std::string kRed("\xFF\0\0", 3);
const std::string kGreen("\0\xFF\0", 3);
const std::string kBlue("\0\0\xFF", 3);
const std::string kGrey("\x80\x80\x80", 3);

std::string pixels(int width, int height, const Paint& paint) {
  std::string all;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      all += paint(x, y);
    }
  }
  return all;
}

std::string jpeg(int width, int height, const Paint& paint) {
  const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
  const std::string raw = pixels(width, height, paint);
  const auto* source = reinterpret_cast<const unsigned char*>(raw.data());
  unsigned char* out = nullptr;
  unsigned long size = 0;
  tjCompress2(encoder.get(), source, width, 0, height, TJPF_RGB, &out, &size, TJSAMP_444, 100, 0);
  std::string encoded(out, out + size);
  tjFree(out);
  return encoded;
}

class PhotographTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  std::string errorOf(const std::function<void()>& action) {
    return test_support::refusalOf<PhotographError>([&] { action(); });
  }

  const test_support::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kPictureWidth + x);
}

TEST_F(PhotographTest, APictureOfTheCamerasSizeIsNotChanged) {
  const auto image = readPhotograph(
      write("a.jpg", jpeg(208, 160, [](int x, int y) { return std::string(3, static_cast<char>((x + y) / 2)); })));
  EXPECT_NEAR(image.y[at(5, 7)], 6, 1);
  EXPECT_NEAR(image.y[at(200, 150)], 175, 1);
  EXPECT_NEAR(image.cr[at(5, 7)], 128, 1);
  EXPECT_NEAR(image.cb[at(5, 7)], 128, 1);
}

TEST_F(PhotographTest, AWideOrTallPictureLosesItsEndsEvenly) {
  // Twice as wide or as high as the camera's picture, green at both ends, which must be cut off.
  const auto wide = readPhotograph(write("WIDE.JPG", jpeg(416, 160, [](int x, int) {
                                           return x < 104 || x >= 312 ? kGreen : x < 208 ? kRed : kBlue;
                                         })));
  EXPECT_NEAR(wide.cr[at(0, 80)], 255, 2);
  EXPECT_NEAR(wide.cr[at(103, 80)], 255, 2);
  EXPECT_NEAR(wide.cb[at(104, 80)], 255, 2);
  EXPECT_NEAR(wide.cb[at(207, 80)], 255, 2);
  const auto high =
      readPhotograph(write("high.jpeg", jpeg(208, 320, [](int, int y) { return y < 80 || y >= 240 ? kGreen : kRed; })));
  EXPECT_NEAR(high.cr[at(100, 0)], 255, 2);
  EXPECT_NEAR(high.cr[at(100, 159)], 255, 2);
}

/// The luminance of the sensor, put together by the equations of Sony's sample W3AIBO (JPEGEncoder.cc).
int luminanceAt(const YCrCbImage& image, int x, int y) {
  const std::size_t i = at(x / 2, y / 2);
  const int across = x % 2 == 0 ? -1 : 1;
  const int down = y % 2 == 0 ? -1 : 1;
  return image.y[i] + down * (image.y_lh[i] - 128) + across * (image.y_hl[i] - 128) +
         across * down * (image.y_hh[i] - 128);
}

TEST_F(PhotographTest, DoubleResolutionShowsAPictureOfTheSensorsSizeSharply) {
  const auto level = [](int x, int y) { return 40 + (x * 7 + y * 13 + x / 3 * y) % 170; };
  const auto image = readPhotograph(
      write("fine.jpg", jpeg(416, 320, [&](int x, int y) { return std::string(3, static_cast<char>(level(x, y))); })));
  for (int y = 0; y < 320; ++y) {
    for (int x = 0; x < 416; ++x) {
      ASSERT_NEAR(luminanceAt(image, x, y), level(x, y), 4) << x << ", " << y;
    }
  }
}

TEST_F(PhotographTest, AJpegOfAnySizeFillsThePicture) {
  for (const int scale : {1, 3, 20}) {
    const auto image = readPhotograph(
        write("a.JPG", jpeg(104 * scale, 80 * scale, [scale](int x, int) { return x < 52 * scale ? kRed : kBlue; })));
    EXPECT_GT(image.cr[at(50, 80)], 245) << scale;
    EXPECT_GT(image.cb[at(150, 80)], 245) << scale;
  }
}

TEST_F(PhotographTest, ABrokenPictureIsNamedWithTheReason) {
  const std::string whole_jpeg = jpeg(208, 160, [](int x, int y) { return std::string(3, static_cast<char>(x * y)); });
  const std::pair<std::string, std::string> broken[] = {
      {"text.jpg", "this is no picture"},
      {"cut.jpg", whole_jpeg.substr(0, whole_jpeg.size() / 2)},
      {"empty.jpeg", ""},
  };
  for (const auto& [name, content] : broken) {
    const auto file = write(name, content);
    EXPECT_THAT(errorOf([&file] { readPhotograph(file); }), AllOf(HasSubstr(file.string()), HasSubstr("folder")));
  }
  const auto pipe = folder_ / "pipe.jpg";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(errorOf([&pipe] { readPhotograph(pipe); }), HasSubstr("it is not a regular file"));
}

TEST_F(PhotographTest, AHugeJpegIsRefusedBeforeItTakesMemory) {
  std::string huge = jpeg(208, 160, [](int, int) { return kGrey; });
  const std::size_t frame = huge.find("\xFF\xC0");  // two bytes of length and one of precision come before the size
  huge.replace(frame + 5, 4, 4, '\x7F');
  const auto file = write("huge.jpg", huge);
  EXPECT_THAT(errorOf([&file] { readPhotograph(file); }), HasSubstr("more than 100 million"));
}

TEST_F(PhotographTest, AShowGoesThroughTheFolderByNameAndStartsAgain) {
  write("b.JPEG", jpeg(208, 160, [](int, int) { return kBlue; }));
  write("a.jpg", jpeg(208, 160, [](int, int) { return kRed; }));
  write("notes.txt", "left alone");
  std::filesystem::create_directory(folder_ / "folder.jpg");
  PhotoShow show(folder_.string());
  const auto is_red = [&show](double seconds) { return show.picture({}, seconds, 1, {}).cr[0] > 200; };
  EXPECT_TRUE(is_red(0));
  EXPECT_TRUE(is_red(1.99));
  EXPECT_FALSE(is_red(2.01));
  EXPECT_TRUE(is_red(4.01));
}

TEST_F(PhotographTest, AShowWithoutPicturesNamesWhatIsMissing) {
  EXPECT_THAT(errorOf([this] { PhotoShow((folder_ / "absent").string()); }),
              AllOf(HasSubstr("absent"), HasSubstr("No such file")));
  EXPECT_THAT(errorOf([this] { PhotoShow(folder_.string()); }), AllOf(HasSubstr(folder_.string()), HasSubstr(".jpg")));
  write("a.jpg", "rubbish");
  EXPECT_THAT(errorOf([this] { PhotoShow(folder_.string()); }), HasSubstr("a.jpg"));
}

}  // namespace
}  // namespace simulated_ers7
