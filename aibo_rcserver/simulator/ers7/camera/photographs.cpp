#include "simulator/ers7/camera/photographs.h"

#include <strings.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host_files/regular_file.h"

namespace simulated_ers7 {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr double kMostPixels = 100e6;
constexpr int kBytesPerPixel = 3;
constexpr auto kLongestPhotograph = static_cast<std::size_t>(kMostPixels * kBytesPerPixel);

// libjpeg-turbo 2.0 of Ubuntu 20.04 cannot limit scans.
#ifdef TJFLAG_LIMITSCANS
constexpr int kDecoderFlags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
#else
constexpr int kDecoderFlags = TJFLAG_STOPONWARNING;
#endif

/// Red, green and blue for each pixel, row by row from the upper left.
struct RgbImage {
  int width;
  int height;
  Bytes pixels;
};

/// A mistake in a file. readPhotograph() adds the file's name.
class BadContent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Bytes readFile(const std::filesystem::path& file) {
  try {
    return host_files::readRegularFile(file.string(), kLongestPhotograph);
  } catch (const host_files::Unreadable& why) {
    throw BadContent(std::string("it cannot be read: ") + why.what());
  }
}

void checkSize(double width, double height) {
  if (width < 1 || height < 1 || width * height > kMostPixels) {
    throw BadContent("it has no pixels, or more than 100 million");
  }
}

/// The decoder's smallest scale at which the photograph is at least as large as the camera's sensor. This scale saves
/// most of the work on large photographs.
tjscalingfactor smallestSufficientScale(int width, int height) {
  int count = 0;
  const tjscalingfactor* factors = tjGetScalingFactors(&count);
  tjscalingfactor best{1, 1};
  for (int i = 0; i < count; ++i) {
    const bool sufficient =
        TJSCALED(width, factors[i]) >= 2 * kPictureWidth && TJSCALED(height, factors[i]) >= 2 * kPictureHeight;
    if (sufficient && factors[i].num * best.denom < best.num * factors[i].denom) {
      best = factors[i];
    }
  }
  return best;
}

RgbImage decodeJpeg(const Bytes& file) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  const auto check = [&decoder](int result) {
    if (result != 0) {
      throw BadContent(std::string("it is not a JPEG, or damaged (") + tjGetErrorStr2(decoder.get()) + ")");
    }
  };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  check(tjDecompressHeader3(decoder.get(), file.data(), file.size(), &width, &height, &subsampling, &color_space));
  checkSize(width, height);
  const tjscalingfactor scale = smallestSufficientScale(width, height);
  RgbImage image{TJSCALED(width, scale), TJSCALED(height, scale), {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * kBytesPerPixel);
  check(tjDecompress2(decoder.get(), file.data(), file.size(), image.pixels.data(), image.width, 0, image.height,
                      TJPF_RGB, kDecoderFlags));
  return image;
}

/// How much a photograph's pixel contributes to a pixel of the camera, in one direction.
struct Share {
  int source;
  float weight;
};

/// For each of `count` pixels, the source's pixels under it and their weights, which sum to 1.
std::vector<std::vector<Share>> sharesOf(int count, double begin, double length, int source_size) {
  std::vector<std::vector<Share>> all(static_cast<std::size_t>(count));
  const double step = length / count;
  for (int i = 0; i < count; ++i) {
    const double low = begin + i * step;
    const double high = low + step;
    const int last = std::min(source_size - 1, static_cast<int>(std::ceil(high)) - 1);
    for (int source = std::max(0, static_cast<int>(low)); source <= last; ++source) {
      const double overlap = std::min(high, source + 1.0) - std::max(low, static_cast<double>(source));
      all[static_cast<std::size_t>(i)].push_back({source, static_cast<float>(overlap / step)});
    }
  }
  return all;
}

/// The mean colour of the pixels in both shares.
YCrCb meanOf(const RgbImage& image, const std::vector<Share>& row, const std::vector<Share>& column) {
  float sum[kBytesPerPixel] = {};
  for (const Share& down : row) {
    for (const Share& across : column) {
      const std::size_t index = static_cast<std::size_t>(down.source) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(across.source);
      for (std::size_t part = 0; part < kBytesPerPixel; ++part) {
        sum[part] += down.weight * across.weight * static_cast<float>(image.pixels[kBytesPerPixel * index + part]);
      }
    }
  }
  return toYCrCb(sum[0], sum[1], sum[2]);
}

/// Fits the photograph to the sensor, which has twice the width and height of layer H.
YCrCbImage fitToCamera(const RgbImage& image) {
  const double scale =
      std::min(static_cast<double>(image.width) / kPictureWidth, static_cast<double>(image.height) / kPictureHeight);
  const double width = scale * kPictureWidth;
  const double height = scale * kPictureHeight;
  const auto columns = sharesOf(2 * kPictureWidth, (image.width - width) / 2, width, image.width);
  const auto rows = sharesOf(2 * kPictureHeight, (image.height - height) / 2, height, image.height);
  YCrCbImage fitted;
  std::size_t pixel = 0;
  for (std::size_t y = 0; y < rows.size(); y += 2) {
    for (std::size_t x = 0; x < columns.size(); x += 2) {
      const YCrCb parts[] = {meanOf(image, rows[y], columns[x]), meanOf(image, rows[y], columns[x + 1]),
                             meanOf(image, rows[y + 1], columns[x]), meanOf(image, rows[y + 1], columns[x + 1])};
      const FineDetail detail = fineDetailOf(parts[0].y, parts[1].y, parts[2].y, parts[3].y);
      fitted.y[pixel] = toByte((parts[0].y + parts[1].y + parts[2].y + parts[3].y) / 4);
      fitted.cr[pixel] = toByte((parts[0].cr + parts[1].cr + parts[2].cr + parts[3].cr) / 4);
      fitted.cb[pixel] = toByte((parts[0].cb + parts[1].cb + parts[2].cb + parts[3].cb) / 4);
      fitted.y_lh[pixel] = toByte(128 + detail.lh);
      fitted.y_hl[pixel] = toByte(128 + detail.hl);
      fitted.y_hh[pixel] = toByte(128 + detail.hh);
      ++pixel;
    }
  }
  return fitted;
}

}  // namespace

YCrCbImage readPhotograph(const std::filesystem::path& file) {
  try {
    return fitToCamera(decodeJpeg(readFile(file)));
  } catch (const BadContent& error) {
    throw PhotographError("cannot show the picture " + file.string() + ": " + error.what() +
                          ". Repair it or remove it from the folder.");
  }
}

namespace {

bool isPhotographName(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return strcasecmp(ending.c_str(), ".jpg") == 0 || strcasecmp(ending.c_str(), ".jpeg") == 0;
}

std::vector<std::filesystem::path> photographsIn(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.is_regular_file() && isPhotographName(entry.path())) {
      files.push_back(entry.path());
    }
  }
  if (error) {
    throw PhotographError("cannot open the folder of pictures " + folder + ": " + error.message());
  }
  if (files.empty()) {
    throw PhotographError("no picture in the folder " + folder + ": it needs files that end in .jpg or .jpeg");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

PhotoShow::PhotoShow(const std::string& folder) {
  for (const auto& file : photographsIn(folder)) {
    pictures_.push_back(readPhotograph(file));
  }
}

const YCrCbImage& PhotoShow::picture(const CameraPose& /*pose*/, double seconds, longword /*image_number*/,
                                     const CameraSettings& /*settings*/) {
  const auto turn = static_cast<std::uint64_t>(seconds / kSeconds);
  return pictures_[static_cast<std::size_t>(turn % pictures_.size())];
}

}  // namespace simulated_ers7
