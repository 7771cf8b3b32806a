// F6: damaged pictures in intact messages.

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "campaign/client_experiment.h"
#include "node/camera/jpeg_decoder.h"
#include "support/test_pictures.h"

namespace fault_bench {
namespace {

using test_pictures::PictureKind;

/// A way to damage a picture.
struct Spoiling {
  Bytes (*spoil)(Bytes jpeg, Random& random);
  bool always_found;  ///< found without decoding, so that the picture must not be delivered
};

std::ptrdiff_t position(Random& random, const Bytes& jpeg) {
  return uniform(random, 0, static_cast<int>(jpeg.size()) - 1);
}

Bytes flipBits(Bytes jpeg, Random& random) {
  for (int count = uniform(random, 1, 8); count > 0; --count) {
    jpeg[static_cast<std::size_t>(position(random, jpeg))] ^= static_cast<std::uint8_t>(1 << uniform(random, 0, 7));
  }
  return jpeg;
}

Bytes cutShort(Bytes jpeg, Random& random) {
  jpeg.resize(static_cast<std::size_t>(position(random, jpeg)) + 1);
  return jpeg;
}

Bytes loseBytes(Bytes jpeg, Random& random) {
  const auto begin = jpeg.begin() + position(random, jpeg);
  jpeg.erase(begin, begin + std::min<std::ptrdiff_t>(uniform(random, 1, 100), jpeg.end() - begin));
  return jpeg.empty() ? Bytes{0} : jpeg;
}

Bytes withoutEnd(Bytes jpeg, Random&) {
  jpeg.resize(jpeg.size() - 2);
  return jpeg;
}

Bytes withMoreBehind(Bytes jpeg, Random& random) {
  jpeg.resize(jpeg.size() + static_cast<std::size_t>(uniform(random, 1, 1000)), 0x55);
  return jpeg;
}

Bytes randomNoise(Bytes jpeg, Random& random) {
  std::generate(jpeg.begin(), jpeg.end(), [&] { return static_cast<std::uint8_t>(uniform(random, 0, 255)); });
  return jpeg;
}

Bytes ofWrongSize(Bytes, Random& random) {
  PictureKind kind;
  kind.width = uniform(random, 16, 640) | 1;  // no camera has an odd width
  kind.height = uniform(random, 16, 480);
  return test_pictures::make(kind);
}

Bytes progressive(Bytes, Random& random) {
  PictureKind kind;
  kind.seed = static_cast<unsigned>(uniform(random, 1, 1000));
  kind.flags = TJFLAG_PROGRESSIVE;
  return test_pictures::make(kind);
}

// A few KB that announce many GB of pixels.
Bytes sizeBomb(Bytes jpeg, Random& random) {
  const std::size_t frame = test_pictures::findMarker(jpeg, 0xC0);
  for (std::size_t i = frame + 5; i < frame + 9; ++i) {
    jpeg[i] = static_cast<std::uint8_t>(uniform(random, 0xF0, 0xFF));
  }
  return jpeg;
}

// Thousands of scans, which a decoder would all decode.
Bytes scanBomb(Bytes jpeg, Random& random) {
  const Bytes scan = {0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0};
  jpeg.resize(jpeg.size() - 2);
  for (int count = uniform(random, 1000, 9000); count > 0; --count) {
    jpeg.insert(jpeg.end(), scan.begin(), scan.end());
  }
  jpeg.insert(jpeg.end(), {0xFF, 0xD9});
  return jpeg;
}

/// Processor time of this thread.
Milliseconds threadTime() {
  timespec time = {};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// True if libjpeg reports an error or a warning.
bool libjpegComplains(const Bytes& jpeg) {
  const std::unique_ptr<void, int (*)(tjhandle)> decompressor(tjInitDecompress(), &tjDestroy);
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colors = 0;
  const auto size = static_cast<unsigned long>(jpeg.size());
  if (tjDecompressHeader3(decompressor.get(), jpeg.data(), size, &width, &height, &subsampling, &colors) != 0) {
    return true;
  }
  Bytes pixels(static_cast<std::size_t>(width * height) * 3);
  return tjDecompress2(decompressor.get(), jpeg.data(), size, pixels.data(), width, 0, height, TJPF_BGR, 0) != 0;
}

/// F6: the server sends a damaged picture in an intact message. Either the client does not deliver it, or the decoder
/// refuses it and takes no longer than twice the time for a good one. The next picture comes.
class CorruptExperiment : public ClientExperiment {
 public:
  explicit CorruptExperiment(unsigned remainder) : ClientExperiment(remainder) {
    const Bytes good = test_pictures::makeNamed({1, 1});
    for (int i = 0; i < 20; ++i) {
      decode(good);
    }
    normal_time_ = bestTime(good);
  }

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    constexpr std::array<Spoiling, 10> kWays = {{{flipBits, false},
                                                 {cutShort, false},
                                                 {loseBytes, false},
                                                 {withoutEnd, true},
                                                 {withMoreBehind, true},
                                                 {randomNoise, true},
                                                 {ofWrongSize, true},
                                                 {progressive, true},
                                                 {sizeBomb, true},
                                                 {scanBomb, true}}};
    const unsigned which = trial / 4 % (2 * kWays.size());
    const Spoiling& way =
        kWays[which < kWays.size() ? which : 0];  // half of the time flipped bits, the most common damage
    const std::uint32_t before = connection();
    const std::uint64_t spoilt_before = server_.lastSpoilt().first.number;
    server_.spoilNext([&](Bytes jpeg) { return way.spoil(std::move(jpeg), random); });
    const auto next = witness_.waitFor(
        [&](const Witness::Sighting& each) {
          const std::uint64_t spoilt = server_.lastSpoilt().first.number;
          return spoilt > spoilt_before && each.name.number > spoilt;
        },
        kPatience);
    Outcome outcome;
    if (!next || next->name.connection != before) {
      outcome.violations.push_back(next ? lossOfConnection() : "no picture came any more");
    }
    if (way.always_found && witness_.hasSeenSpoilt()) {
      outcome.violations.emplace_back("a damaged picture was delivered");
    }
    judge(server_.lastSpoilt().second, &outcome);
    return outcome;
  }

  void judge(const Bytes& jpeg, Outcome* outcome) {
    if (decode(jpeg) && (jpeg.size() < 4 || libjpegComplains(jpeg))) {
      outcome->violations.emplace_back("a damaged picture was decoded");
    }
    const Milliseconds time = bestTime(jpeg);
    if (time > 2 * normal_time_) {
      outcome->violations.push_back("M: decoding took " + std::to_string(time.count()) + " ms, a good picture takes " +
                                    std::to_string(normal_time_.count()));
    }
  }

  bool decode(const Bytes& jpeg) {
    try {
      const aibo_driver::node::BgrImage image = aibo_driver::node::decodeJpeg(jpeg.data(), jpeg.size());
      return image.width > 0;
    } catch (const aibo_driver::node::DecodeException&) {
      return false;
    }
  }

  Milliseconds bestTime(const Bytes& jpeg) {
    Milliseconds best = Milliseconds::max();
    for (int i = 0; i < 20 && (i < 3 || best > 2 * normal_time_); ++i) {
      const Milliseconds before = threadTime();
      decode(jpeg);
      best = std::min(best, threadTime() - before);
    }
    return best;
  }

  Milliseconds normal_time_{1e9};
};

}  // namespace

std::vector<Row> pictureRows() {
  return {{"F6", "damaged and hostile JPEGs", 10000, 4, {}, maker<CorruptExperiment>()}};
}

}  // namespace fault_bench
