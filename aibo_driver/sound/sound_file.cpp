#include "sound/source.h"

#include <samplerate.h>
#include <sndfile.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
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
constexpr std::size_t kBlock = 4096;                  // frames

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

class SoundFile {
 public:
  SoundFile(FileDescriptor descriptor, const std::string& name) : descriptor_(std::move(descriptor)) {
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
      resampler_.reset(is_possible ? ::src_callback_new(nextBlock, SRC_SINC_FASTEST, 1, &error, this) : nullptr);
      if (!resampler_) {
        refuse(name, "its rate of " + std::to_string(info_.samplerate) + " samples/s is not possible");
      }
    }
  }

  SoundFile(const SoundFile&) = delete;  // the resampler knows where it is
  SoundFile& operator=(const SoundFile&) = delete;

  std::vector<std::int16_t> read(std::size_t most) {
    const std::vector<float> sound = resampler_ ? resample(most) : readMean(most);
    std::vector<std::int16_t> samples(sound.size());
    std::transform(sound.begin(), sound.end(), samples.begin(), toSample);
    return samples;
  }

 private:
  /// @return the mean of the channels; less at the end, or where the file is damaged
  std::vector<float> readMean(std::size_t most) {
    const auto channels = static_cast<std::size_t>(info_.channels);
    std::vector<float> frames(most * channels);
    const sf_count_t count =
        is_at_end_ ? 0 : ::sf_readf_float(file_.get(), frames.data(), static_cast<sf_count_t>(most));
    is_at_end_ = count <= 0;
    std::vector<float> mean(static_cast<std::size_t>(std::max<sf_count_t>(count, 0)));
    for (std::size_t i = 0; i < mean.size(); ++i) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        mean[i] += frames[i * channels + channel] / static_cast<float>(channels);
      }
    }
    return mean;
  }

  std::vector<float> resample(std::size_t most) {
    std::vector<float> sound(most);
    const long count = ::src_callback_read(resampler_.get(), ratio_, static_cast<long>(most), sound.data());
    sound.resize(static_cast<std::size_t>(count));
    return sound;
  }

  // The resampler calls this.
  static long nextBlock(void* file, float** samples) {
    auto* const self = static_cast<SoundFile*>(file);
    self->block_ = self->readMean(kBlock);
    if (!self->block_.empty()) {
      *samples = self->block_.data();
    }
    return static_cast<long>(self->block_.size());
  }

  FileDescriptor descriptor_;
  SF_INFO info_{};
  std::unique_ptr<SNDFILE, SoundFileCloser> file_;
  double ratio_ = 1;
  std::unique_ptr<SRC_STATE, ResamplerCloser> resampler_;  ///< null if the file has the robot's rate
  std::vector<float> block_;                               ///< what the resampler reads
  bool is_at_end_ = false;
};

}  // namespace

Source openSoundFile(const std::string& path) {
  return readSound(files::openToRead(path, kLongestUnpacked), path);
}

Source readSound(FileDescriptor file, const std::string& name) {
  const auto sound = std::make_shared<SoundFile>(std::move(file), name);
  return [sound](std::size_t most) { return sound->read(most); };
}

}  // namespace aibo_driver::sound
