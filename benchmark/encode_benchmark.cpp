// Compares the RCServer's encoder with bare libjpeg-turbo on the same planes: the same halving of chroma, then
// tjCompressFromYUVPlanes, or libjpeg's own jpeg_write_raw_data. All take turns on the same images, so that their
// ratios do not depend on the load of the machine.
#include <benchmark/benchmark.h>
#include <time.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// After cstdio, which it needs.
#include <jpeglib.h>

#include "figures.h"
#include "picture_encoder/JpegEncoder.h"
#include "picture_encoder/PictureJob.h"
#include "support/camera_image_fixture.h"

using test_support::CameraImageFixture;

namespace {

using Plane = std::vector<uint8_t>;

void halve(const unsigned char* plane, const CameraImage& image, Plane& half) {
  const size_t stride = image.stride;
  const size_t half_width = image.width / 2;
  for (size_t row = 0; row < image.height / 2; ++row) {
    const unsigned char* upper = plane + 2 * row * stride;
    const unsigned char* lower = upper + stride;
    for (size_t column = 0; column < half_width; ++column) {
      const int sum = upper[2 * column] + upper[2 * column + 1] + lower[2 * column] + lower[2 * column + 1];
      half[row * half_width + column] = static_cast<uint8_t>((sum + 2) / 4);
    }
  }
}

class BareTurboJpeg {
 public:
  BareTurboJpeg(size_t width, size_t height)
      : width_(width),
        height_(height),
        cb_(width * height / 4),
        cr_(width * height / 4),
        jpeg_(tjBufSize(static_cast<int>(width), static_cast<int>(height), TJSAMP_420)) {}

  size_t encode(const CameraImage& image, int quality) {
    halve(image.cb, image, cb_);
    halve(image.cr, image, cr_);
    const int half_stride = static_cast<int>(width_ / 2);
    const unsigned char* planes[] = {image.y, cb_.data(), cr_.data()};
    const int strides[] = {static_cast<int>(image.stride), half_stride, half_stride};
    unsigned char* jpeg = jpeg_.data();
    unsigned long size = jpeg_.size();
    if (tjCompressFromYUVPlanes(handle_.get(), planes, static_cast<int>(width_), strides, static_cast<int>(height_),
                                TJSAMP_420, &jpeg, &size, quality, TJFLAG_NOREALLOC) != 0) {
      throw std::runtime_error(tjGetErrorStr2(handle_.get()));
    }
    return size;
  }

 private:
  const size_t width_;
  const size_t height_;
  std::unique_ptr<void, int (*)(tjhandle)> handle_{tjInitCompress(), tjDestroy};
  Plane cb_;
  Plane cr_;
  Plane jpeg_;
};

// An error of libjpeg ends the program, as its default is.
class BareLibjpeg {
 public:
  BareLibjpeg(size_t width, size_t height)
      : half_width_(width / 2),
        cb_(width * height / 4 + kRows),
        cr_(width * height / 4 + kRows),
        jpeg_(tjBufSize(static_cast<int>(width), static_cast<int>(height), TJSAMP_420)) {
    compress_.err = jpeg_std_error(&errors_);
    jpeg_create_compress(&compress_);
    compress_.image_width = static_cast<JDIMENSION>(width);
    compress_.image_height = static_cast<JDIMENSION>(height);
    compress_.input_components = 3;
    compress_.in_color_space = JCS_YCbCr;
    jpeg_set_defaults(&compress_);
    compress_.raw_data_in = TRUE;
  }

  ~BareLibjpeg() { jpeg_destroy_compress(&compress_); }
  BareLibjpeg(const BareLibjpeg&) = delete;
  BareLibjpeg& operator=(const BareLibjpeg&) = delete;

  size_t encode(const CameraImage& image, int quality) {
    halve(image.cb, image, cb_);
    halve(image.cr, image, cr_);
    unsigned char* jpeg = jpeg_.data();
    unsigned long size = jpeg_.size();
    jpeg_mem_dest(&compress_, &jpeg, &size);
    jpeg_set_quality(&compress_, quality, TRUE);
    jpeg_start_compress(&compress_, TRUE);
    while (compress_.next_scanline < compress_.image_height) {
      writeStrip(image, compress_.next_scanline);
    }
    jpeg_finish_compress(&compress_);
    return size;
  }

 private:
  static constexpr size_t kRows = 16;  // of pixels, in a strip of macroblocks

  // After the last row, this row is repeated. After the last column come arbitrary pixels. Readers cut both off.
  void writeStrip(const CameraImage& image, size_t top) {
    std::array<JSAMPROW, kRows> y{};
    std::array<JSAMPROW, kRows / 2> cb{};
    std::array<JSAMPROW, kRows / 2> cr{};
    for (size_t row = 0; row < kRows; ++row) {
      const size_t at = std::min<size_t>(top + row, compress_.image_height - 1);
      y[row] = const_cast<JSAMPROW>(image.y + at * image.stride);
      cb[row / 2] = cb_.data() + at / 2 * half_width_;
      cr[row / 2] = cr_.data() + at / 2 * half_width_;
    }
    std::array<JSAMPARRAY, 3> planes{y.data(), cb.data(), cr.data()};
    jpeg_write_raw_data(&compress_, planes.data(), kRows);
  }

  const size_t half_width_;
  jpeg_compress_struct compress_{};
  jpeg_error_mgr errors_{};
  Plane cb_;
  Plane cr_;
  Plane jpeg_;
};

// The processor time and the results of one encoder's calls.
class Account {
 public:
  template <typename Encode>
  void measure(const Encode& encode) {
    const double begin = processorMicroseconds();
    bytes_ += static_cast<double>(encode());
    microseconds_.push_back(processorMicroseconds() - begin);
  }

  // The median, because an interruption by another program makes some calls take much longer.
  double microseconds() const { return benchmark_figures::quantile(microseconds_, 0.5); }
  double bytes() const { return bytes_ / static_cast<double>(microseconds_.size()); }

 private:
  static double processorMicroseconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
  }

  std::vector<double> microseconds_;
  double bytes_ = 0;
};

// The first encoder fetches the image into the processor's caches, so the encoders take turns at being first.
void encodePicture(benchmark::State& state) {
  const auto width = static_cast<size_t>(state.range(0));
  const size_t height = width * 160 / 208;
  const int quality = static_cast<int>(state.range(1));
  std::vector<CameraImageFixture> scenes;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    scenes.push_back(CameraImageFixture::scene(width, height, seed));
  }
  JpegEncoder encoder;
  BareTurboJpeg turbo_jpeg(width, height);
  BareLibjpeg libjpeg(width, height);
  std::vector<uint8_t> jpeg(ENCODED_PICTURE_CAPACITY);
  const std::array<std::function<size_t(const CameraImage&)>, 3> encoders{
      [&](const CameraImage& image) { return encoder.Encode(image, quality, jpeg.data(), jpeg.size()); },
      [&](const CameraImage& image) { return turbo_jpeg.encode(image, quality); },
      [&](const CameraImage& image) { return libjpeg.encode(image, quality); }};
  std::array<Account, 3> accounts;
  size_t next = 0;
  for (auto _ : state) {
    const CameraImage image = scenes[next % scenes.size()].image();
    const size_t first = next++ / scenes.size();
    for (size_t i = 0; i < encoders.size(); ++i) {
      const size_t turn = (first + i) % encoders.size();
      accounts[turn].measure([&] { return encoders[turn](image); });
    }
  }
  const std::array<std::string, 3> names{"rcserver", "turbo_jpeg", "libjpeg"};
  for (size_t i = 0; i < names.size(); ++i) {
    state.counters[names[i] + "_us"] = accounts[i].microseconds();
    state.counters[names[i] + "_bytes"] = accounts[i].bytes();
  }
}
BENCHMARK(encodePicture)->ArgNames({"width", "quality"})->ArgsProduct({{416, 208, 104, 52}, {50, 85, 95}});

}  // namespace

BENCHMARK_MAIN();
