// Compares the RCServer's encoder with bare libjpeg-turbo on the same planes: the same halving of chroma, then
// tjCompressFromYUVPlanes. Both alternate on the same images, so that their ratio does not depend on the load of the
// machine.
#include <benchmark/benchmark.h>
#include <time.h>
#include <turbojpeg.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "figures.h"
#include "picture_encoder/JpegEncoder.h"
#include "support/camera_image_fixture.h"

using test_support::CameraImageFixture;

namespace {

class BareTurboJpeg {
 public:
  BareTurboJpeg(size_t width, size_t height)
      : width_(width),
        height_(height),
        cb_(width * height / 4),
        cr_(width * height / 4),
        jpeg_(tjBufSize(static_cast<int>(width), static_cast<int>(height), TJSAMP_420)) {}

  size_t encode(const CameraImage& image, int quality) {
    halve(image.cb, image.stride, cb_.data());
    halve(image.cr, image.stride, cr_.data());
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
  void halve(const unsigned char* plane, size_t stride, uint8_t* half) const {
    const size_t half_width = width_ / 2;
    for (size_t row = 0; row < height_ / 2; ++row) {
      const unsigned char* upper = plane + 2 * row * stride;
      const unsigned char* lower = upper + stride;
      for (size_t column = 0; column < half_width; ++column) {
        const int sum = upper[2 * column] + upper[2 * column + 1] + lower[2 * column] + lower[2 * column + 1];
        half[row * half_width + column] = static_cast<uint8_t>((sum + 2) / 4);
      }
    }
  }

  const size_t width_;
  const size_t height_;
  std::unique_ptr<void, int (*)(tjhandle)> handle_{tjInitCompress(), tjDestroy};
  std::vector<uint8_t> cb_;
  std::vector<uint8_t> cr_;
  std::vector<uint8_t> jpeg_;
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

// The first of the two fetches the image into the processor's caches, so they take turns at that.
void encodePicture(benchmark::State& state) {
  const auto width = static_cast<size_t>(state.range(0));
  const size_t height = width * 160 / 208;
  const int quality = static_cast<int>(state.range(1));
  std::vector<CameraImageFixture> scenes;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    scenes.push_back(CameraImageFixture::scene(width, height, seed));
  }
  JpegEncoder encoder;
  BareTurboJpeg bare_encoder(width, height);
  std::vector<uint8_t> jpeg(JpegEncoder::WorstCaseSize(width, height));
  Account rcserver;
  Account bare;
  size_t next = 0;
  for (auto _ : state) {
    const CameraImage image = scenes[next % scenes.size()].image();
    const bool rcserver_is_first = next++ / scenes.size() % 2 == 0;
    const auto encode = [&] { return encoder.Encode(image, quality, jpeg.data(), jpeg.size()); };
    if (rcserver_is_first) {
      rcserver.measure(encode);
    }
    bare.measure([&] { return bare_encoder.encode(image, quality); });
    if (!rcserver_is_first) {
      rcserver.measure(encode);
    }
  }
  state.counters["rcserver_us"] = rcserver.microseconds();
  state.counters["bare_us"] = bare.microseconds();
  state.counters["rcserver_bytes"] = rcserver.bytes();
  state.counters["bare_bytes"] = bare.bytes();
}
BENCHMARK(encodePicture)->ArgNames({"width", "quality"})->ArgsProduct({{208, 104, 52}, {50, 85, 95}});

}  // namespace

BENCHMARK_MAIN();
