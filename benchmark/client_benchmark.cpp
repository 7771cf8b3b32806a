// Measures the driver's own work on a picture: finding it in the byte stream, checking it, and decoding it, compared
// with bare TurboJPEG. Times are per picture of 208x160 at quality 85, 4:2:0.
#include <benchmark/benchmark.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "aibo_client/jpeg_inspector.h"
#include "client/notifier.h"
#include "client/reply_parser.h"
#include "client/version1_session.h"
#include "node/camera/jpeg_decoder.h"
#include "support/test_pictures.h"

namespace {

using test_pictures::Bytes;

constexpr std::size_t kPictures = 16;
constexpr std::size_t kReadSize = 16 * 1024;  // the most that one read from the socket returns

std::vector<Bytes> makePictures() {
  std::vector<Bytes> pictures;
  for (unsigned i = 0; i < kPictures; ++i) {
    pictures.push_back(test_pictures::makeNumbered(i));
  }
  return pictures;
}

Bytes makeStream() {
  Bytes stream;
  for (const Bytes& picture : makePictures()) {
    const Bytes reply = test_pictures::makeReply(picture);
    stream.insert(stream.end(), reply.begin(), reply.end());
  }
  return stream;
}

template <typename Feed>
void feedInReads(const Bytes& stream, const Feed& feed) {
  for (std::size_t at = 0; at < stream.size(); at += kReadSize) {
    feed(stream.data() + at, std::min(kReadSize, stream.size() - at));
  }
}

/// The average size of a reply: picture and header.
void reportSize(benchmark::State& state) {
  state.counters["bytes"] = static_cast<double>(makeStream().size()) / kPictures;
}

void BM_Parse(benchmark::State& state) {
  const Bytes stream = makeStream();
  aibo_client::ReplyParser parser;
  const auto parse = [&parser](const std::uint8_t* data, std::size_t size) {
    for (std::size_t taken = 0; size > 0; data += taken, size -= taken) {
      if (parser.append(data, size, {}, &taken) == aibo_client::ReplyParser::Result::kPicture) {
        benchmark::DoNotOptimize(parser.takeJpeg().data());
      }
    }
  };
  while (state.KeepRunningBatch(kPictures)) {
    feedInReads(stream, parse);
  }
  reportSize(state);
}
BENCHMARK(BM_Parse);

void BM_Inspect(benchmark::State& state) {
  const std::vector<Bytes> pictures = makePictures();
  while (state.KeepRunningBatch(kPictures)) {
    for (const Bytes& picture : pictures) {
      benchmark::DoNotOptimize(aibo_client::inspectJpeg(picture.data(), picture.size()));
    }
  }
  reportSize(state);
}
BENCHMARK(BM_Inspect);

/// Everything between the socket and the callback: parse, inspect, judge, wrap.
void BM_Session(benchmark::State& state) {
  const Bytes stream = makeStream();
  const auto now = aibo_client::Session::TimePoint() + std::chrono::hours(1);
  aibo_client::Callbacks callbacks;
  callbacks.on_picture = [](const aibo_client::PicturePtr& p) { benchmark::DoNotOptimize(p.get()); };
  const aibo_client::Notifier notifier(callbacks);
  aibo_client::ClientStatistics counters;
  aibo_client::ServerHabits habits;
  aibo_client::Connection connection({"robot", std::chrono::milliseconds(500), notifier, counters}, now);
  aibo_client::Version1Session session(connection, habits, aibo_client::Version1Session::VersionAnswer::kNotAsked, now);
  aibo_client::Wish wish;
  wish.streaming = true;
  session.nextRequest(wish, now);
  while (state.KeepRunningBatch(kPictures)) {
    feedInReads(stream, [&](const std::uint8_t* data, std::size_t size) {
      connection.pictures.bytesArrived(now);
      session.bytesArrived(data, size, now);
    });
  }
  if (counters.pictures == 0 || counters.corrupt_pictures + counters.stale_pictures > 0) {
    state.SkipWithError("pictures were lost");
  }
  reportSize(state);
}
BENCHMARK(BM_Session);

void BM_Decode(benchmark::State& state) {
  const std::vector<Bytes> pictures = makePictures();
  while (state.KeepRunningBatch(kPictures)) {
    for (const Bytes& picture : pictures) {
      benchmark::DoNotOptimize(aibo_driver::node::decodeJpeg(picture.data(), picture.size()).pixels.data());
    }
  }
  reportSize(state);
}
BENCHMARK(BM_Decode);

/// The lower limit: one handle, one buffer, no checks.
void BM_DecodeBareTurboJpeg(benchmark::State& state) {
  const std::vector<Bytes> pictures = makePictures();
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
  std::vector<unsigned char> pixels(208 * 160 * 3);
  while (state.KeepRunningBatch(kPictures)) {
    for (const Bytes& picture : pictures) {
      if (tjDecompress2(decoder.get(), picture.data(), picture.size(), pixels.data(), 208, 0, 160, TJPF_BGR, 0) != 0) {
        state.SkipWithError(tjGetErrorStr2(decoder.get()));
      }
      benchmark::DoNotOptimize(pixels.data());
    }
  }
  reportSize(state);
}
BENCHMARK(BM_DecodeBareTurboJpeg);

}  // namespace

BENCHMARK_MAIN();
