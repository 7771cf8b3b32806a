// Compares the RCServer's encoder with bare libjpeg-turbo on the same planes: the same halving of chroma, then
// tjCompressFromYUVPlanes. Both alternate on the same images, so that ratio_to_bare does not depend on the load of the
// machine.
#include <benchmark/benchmark.h>
#include <turbojpeg.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "picture_encoder/JpegEncoder.h"
#include "support/camera_image_fixture.h"

using test_support::CameraImageFixture;

namespace {

constexpr size_t kWidth = 208;
constexpr size_t kHeight = 160;

class BareTurboJpeg {
 public:
  size_t encode(const CameraImage& image, int quality) {
    halve(image.cb, image.stride, cb_.data());
    halve(image.cr, image.stride, cr_.data());
    const unsigned char* planes[] = {image.y, cb_.data(), cr_.data()};
    const int strides[] = {static_cast<int>(image.stride), kWidth / 2, kWidth / 2};
    unsigned char* jpeg = jpeg_.data();
    unsigned long size = jpeg_.size();
    if (tjCompressFromYUVPlanes(handle_.get(), planes, kWidth, strides, kHeight, TJSAMP_420, &jpeg, &size, quality,
                                TJFLAG_NOREALLOC) != 0) {
      throw std::runtime_error(tjGetErrorStr2(handle_.get()));
    }
    return size;
  }

 private:
  static void halve(const unsigned char* plane, size_t stride, uint8_t* half) {
    for (size_t row = 0; row < kHeight / 2; ++row) {
      const unsigned char* upper = plane + 2 * row * stride;
      const unsigned char* lower = upper + stride;
      for (size_t column = 0; column < kWidth / 2; ++column) {
        const int sum = upper[2 * column] + upper[2 * column + 1] + lower[2 * column] + lower[2 * column + 1];
        half[row * kWidth / 2 + column] = static_cast<uint8_t>((sum + 2) / 4);
      }
    }
  }

  std::unique_ptr<void, int (*)(tjhandle)> handle_{tjInitCompress(), tjDestroy};
  std::vector<uint8_t> cb_ = std::vector<uint8_t>(kWidth * kHeight / 4);
  std::vector<uint8_t> cr_ = std::vector<uint8_t>(kWidth * kHeight / 4);
  std::vector<uint8_t> jpeg_ = std::vector<uint8_t>(tjBufSize(kWidth, kHeight, TJSAMP_420));
};

// Adds up the times and the results of calls.
class Account {
 public:
  template <typename Encode>
  void measure(const Encode& encode) {
    const auto begin = std::chrono::steady_clock::now();
    bytes_ += static_cast<double>(encode());
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++pictures_;
  }

  double microseconds() const { return 1e6 * seconds_ / pictures_; }
  double bytes() const { return bytes_ / pictures_; }

 private:
  double seconds_ = 0;
  double bytes_ = 0;
  double pictures_ = 0;
};

void encodePicture(benchmark::State& state) {
  const int quality = static_cast<int>(state.range(0));
  std::vector<CameraImageFixture> scenes;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    scenes.push_back(CameraImageFixture::scene(kWidth, kHeight, seed));
  }
  JpegEncoder encoder;
  BareTurboJpeg bare_encoder;
  std::vector<uint8_t> jpeg(JpegEncoder::WorstCaseSize(kWidth, kHeight));
  Account rcserver;
  Account bare;
  size_t next = 0;
  for (auto _ : state) {
    const CameraImage image = scenes[next++ % scenes.size()].image();
    rcserver.measure([&] { return encoder.Encode(image, quality, jpeg.data(), jpeg.size()); });
    bare.measure([&] { return bare_encoder.encode(image, quality); });
  }
  state.counters["rcserver_us"] = rcserver.microseconds();
  state.counters["bare_us"] = bare.microseconds();
  state.counters["ratio_to_bare"] = rcserver.microseconds() / bare.microseconds();
  state.counters["rcserver_bytes"] = rcserver.bytes();
  state.counters["bare_bytes"] = bare.bytes();
}
BENCHMARK(encodePicture)->ArgName("quality")->Arg(25)->Arg(50)->Arg(85)->Arg(95)->Arg(100);

}  // namespace

BENCHMARK_MAIN();
