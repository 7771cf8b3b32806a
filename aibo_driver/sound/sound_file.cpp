#include "sound/source.h"

#include <samplerate.h>
#include <sndfile.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/sound.h"
#include "files/files.h"

namespace aibo_driver::sound {

using files::FileException;
using host_files::FileDescriptor;

namespace {

constexpr int kMostChannels = 8;
constexpr std::size_t kLongestUnpacked = 64U << 20U;  // bytes; a memory stick of Sony's has 16 MB
constexpr sf_count_t kBlock = 4096;                   // frames

struct SoundFileCloser {
  void operator()(SNDFILE* file) const { ::sf_close(file); }
};
struct ResamplerCloser {
  void operator()(SRC_STATE* state) const { ::src_delete(state); }
};

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw FileException("'" + name + "' cannot be played: " + why);
}

/// libsndfile knows many more formats, but nobody has asked for them.
bool isOfKnownFormat(int file) {
  std::array<char, 4> begin{};
  const bool is_read = ::pread(file, begin.data(), begin.size(), 0) == static_cast<ssize_t>(begin.size());
  return is_read && (std::memcmp(begin.data(), "RIFF", 4) == 0 || std::memcmp(begin.data(), "fLaC", 4) == 0 ||
                     std::memcmp(begin.data(), "OggS", 4) == 0);
}

std::int16_t toSample(float value) {
  constexpr float kScale = 32768;  // as libsndfile reads samples of 16 bits
  return std::isnan(value) ? std::int16_t{0}
                           : static_cast<std::int16_t>(std::lrint(std::clamp(value * kScale, -kScale, kScale - 1)));
}

class FileSource : public Source {
 public:
  FileSource(FileDescriptor descriptor, const std::string& name) : descriptor_(std::move(descriptor)) {
    if (!isOfKnownFormat(descriptor_.get())) {
      refuse(name, "it is no WAV, FLAC or Ogg file");
    }
    file_.reset(::sf_open_fd(descriptor_.get(), SFM_READ, &info_, SF_FALSE));
    if (!file_) {
      refuse(name, ::sf_strerror(nullptr));
    }
    if (info_.channels < 1 || info_.channels > kMostChannels) {
      refuse(name, "it has " + std::to_string(info_.channels) + " channels; at most " + std::to_string(kMostChannels) +
                       " are possible");
    }
    ratio_ = static_cast<double>(aibo_client::kSoundRate) / info_.samplerate;
    if (info_.samplerate != aibo_client::kSoundRate) {
      int error = 0;
      const bool is_possible = info_.samplerate > 0 && ::src_is_valid_ratio(ratio_) != 0;
      resampler_.reset(is_possible ? ::src_new(SRC_SINC_FASTEST, 1, &error) : nullptr);
      if (!resampler_) {
        refuse(name, "its rate of " + std::to_string(info_.samplerate) + " samples/s is not possible");
      }
    }
  }

  std::vector<std::int16_t> read(std::size_t most) override {
    while (ready_.size() < most && !is_at_end_) {
      const std::vector<float> block = readBlock();
      is_at_end_ = block.empty();
      resampler_ ? resample(block) : append(block.data(), block.size());
    }
    const auto end = ready_.begin() + static_cast<std::ptrdiff_t>(std::min(most, ready_.size()));
    std::vector<std::int16_t> samples(ready_.begin(), end);
    ready_.erase(ready_.begin(), end);
    return samples;
  }

 private:
  /// @return the mean of the channels; empty at the end, or where the file is damaged
  std::vector<float> readBlock() {
    const auto channels = static_cast<std::size_t>(info_.channels);
    std::vector<float> frames(static_cast<std::size_t>(kBlock) * channels);
    const sf_count_t count = ::sf_readf_float(file_.get(), frames.data(), kBlock);
    std::vector<float> mean(static_cast<std::size_t>(std::max<sf_count_t>(count, 0)));
    for (std::size_t i = 0; i < mean.size(); ++i) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        mean[i] += frames[i * channels + channel] / static_cast<float>(channels);
      }
    }
    return mean;
  }

  /// @param block if empty, the sound has ended, and the resampler gives what it still has
  void resample(const std::vector<float>& block) {
    std::vector<float> out(static_cast<std::size_t>(kBlock));
    SRC_DATA data = {};
    // If data_in were null, the resampler would keep the end of the sound.
    const float nothing = 0;
    data.data_in = block.empty() ? &nothing : block.data();
    data.input_frames = static_cast<long>(block.size());
    data.data_out = out.data();
    data.output_frames = static_cast<long>(out.size());
    data.end_of_input = block.empty() ? 1 : 0;
    data.src_ratio = ratio_;
    do {
      if (::src_process(resampler_.get(), &data) != 0) {
        is_at_end_ = true;
        return;
      }
      append(out.data(), static_cast<std::size_t>(data.output_frames_gen));
      data.data_in += data.input_frames_used;
      data.input_frames -= data.input_frames_used;
    } while (data.input_frames > 0 || data.output_frames_gen > 0);
  }

  void append(const float* samples, std::size_t count) {
    std::transform(samples, samples + count, std::back_inserter(ready_), toSample);
  }

  FileDescriptor descriptor_;
  SF_INFO info_{};
  std::unique_ptr<SNDFILE, SoundFileCloser> file_;
  double ratio_ = 1;
  std::unique_ptr<SRC_STATE, ResamplerCloser> resampler_;  ///< null if the file has the robot's rate
  std::vector<std::int16_t> ready_;
  bool is_at_end_ = false;
};

}  // namespace

std::unique_ptr<Source> openSoundFile(const std::string& path) {
  return readSound(files::openToRead(path, kLongestUnpacked), path);
}

std::unique_ptr<Source> readSound(FileDescriptor file, const std::string& name) {
  return std::make_unique<FileSource>(std::move(file), name);
}

}  // namespace aibo_driver::sound
