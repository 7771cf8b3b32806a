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

std::string jpeg(int width, int height, const Paint& paint) {
  const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
  std::string raw;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      raw += paint(x, y);
    }
  }
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
    folder_.write(name, content);
    return folder_.path(name);
  }

  std::string errorOf(const std::filesystem::path& file) {
    return test_support::refusalOf<PhotographError>([&] { readPhotograph(file); });
  }
  std::string errorOfShow(const std::filesystem::path& folder) {
    return test_support::refusalOf<PhotographError>([&] { PhotoShow(folder.string()); });
  }

  const test_support::TemporaryFolder folder_;
};

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kPictureWidth + x);
}

TEST_F(PhotographTest, AJpegOfAnySizeFillsThePictureAndLosesItsEndsEvenly) {
  for (const auto& [width, height] :
       {std::pair(208, 160), {104, 80}, {312, 240}, {2080, 1600}, {416, 160}, {208, 320}}) {
    const int across = height * 208 / 160;  // what is to the left and right of it is cut off
    const int down = width * 160 / 208;
    const auto image =
        readPhotograph(write("A.JPEG", jpeg(width, height, [w = width, h = height, across, down](int x, int y) {
                               const bool is_cut_off = std::abs(2 * x - w) > across || std::abs(2 * y - h) > down;
                               return is_cut_off ? kGreen : 2 * x < w ? kRed : kBlue;
                             })));
    for (const int y : {2, 80, 157}) {
      EXPECT_NEAR(image.cr[at(2, y)], 255, 5) << width << " " << height;
      EXPECT_NEAR(image.cr[at(100, y)], 255, 10) << width << " " << height;
      EXPECT_NEAR(image.cb[at(107, y)], 255, 10) << width << " " << height;
      EXPECT_NEAR(image.cb[at(205, y)], 255, 5) << width << " " << height;
    }
  }
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

TEST_F(PhotographTest, ABrokenPictureIsNamedWithTheReason) {
  const std::string whole_jpeg = jpeg(208, 160, [](int x, int y) { return std::string(3, static_cast<char>(x * y)); });
  const std::pair<std::string, std::string> broken[] = {
      {"text.jpg", "this is no picture"},
      {"cut.jpg", whole_jpeg.substr(0, whole_jpeg.size() / 2)},
      {"empty.jpeg", ""},
  };
  for (const auto& [name, content] : broken) {
    const auto file = write(name, content);
    EXPECT_THAT(errorOf(file), AllOf(HasSubstr(file.string()), HasSubstr("folder")));
  }
  const auto pipe = folder_.path("pipe.jpg");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(errorOf(pipe), HasSubstr("it is not a regular file"));
}

TEST_F(PhotographTest, AHugeJpegIsRefusedBeforeItTakesMemory) {
  std::string huge = jpeg(208, 160, [](int, int) { return kGrey; });
  const std::size_t frame = huge.find("\xFF\xC0");  // two bytes of length and one of precision come before the size
  huge.replace(frame + 5, 4, 4, '\x7F');
  EXPECT_THAT(errorOf(write("huge.jpg", huge)), HasSubstr("more than 100 million"));
}

TEST_F(PhotographTest, AShowGoesThroughTheFolderByNameAndStartsAgain) {
  write("b.JPEG", jpeg(208, 160, [](int, int) { return kBlue; }));
  write("a.jpg", jpeg(208, 160, [](int, int) { return kRed; }));
  write("notes.txt", "left alone");
  std::filesystem::create_directory(folder_.path("folder.jpg"));
  PhotoShow show(folder_.path().string());
  const auto is_red = [&show](double seconds) { return show.picture({}, seconds, 1, {}).cr[0] > 200; };
  EXPECT_TRUE(is_red(0));
  EXPECT_TRUE(is_red(1.99));
  EXPECT_FALSE(is_red(2.01));
  EXPECT_TRUE(is_red(4.01));
}

TEST_F(PhotographTest, AShowWithoutPicturesNamesWhatIsMissing) {
  EXPECT_THAT(errorOfShow(folder_.path("absent")), AllOf(HasSubstr("absent"), HasSubstr("No such file")));
  EXPECT_THAT(errorOfShow(folder_.path()), AllOf(HasSubstr(folder_.path().string()), HasSubstr(".jpg")));
  write("a.jpg", "rubbish");
  EXPECT_THAT(errorOfShow(folder_.path()), HasSubstr("a.jpg"));
}

}  // namespace
}  // namespace simulated_ers7
