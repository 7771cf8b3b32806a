#include "simulator/ers7/sound/wav_file.h"

#include <cstring>

#include "host_files/gzip.h"
#include "host_files/regular_file.h"

namespace simulated_ers7 {
namespace {

constexpr std::uint32_t kRate = 16000;
constexpr std::size_t kHeaderSize = 44;
constexpr std::size_t kLongestFile = 100'000'000;  ///< bytes; 26 minutes in stereo
constexpr std::uint32_t kEndless = 0x7ffff000;     ///< written as the size while it is unknown

/// The beginning of a chunk "fmt ".
struct Format {
  std::uint16_t encoding;
  std::uint16_t channels;
  std::uint32_t rate;
  std::uint32_t bytes_per_second;
  std::uint16_t block_size;
  std::uint16_t bits;
};
constexpr std::uint16_t kPcm = 1;
constexpr std::uint16_t kExtensible = 0xfffe;  ///< some programs use this for PCM

Format formatOf(std::uint16_t channels) {
  const auto block = static_cast<std::uint16_t>(2 * channels);
  return {kPcm, channels, kRate, kRate * block, block, 16};
}

template <typename Value>
Value valueAt(const std::string& bytes, std::size_t offset) {
  Value value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

std::string readFile(const std::string& path) {
  try {
    return host_files::readUnpacked(path, kLongestFile);
  } catch (const host_files::Unreadable& why) {
    throw SoundError(path + ": cannot be read: " + why.what());
  }
}

/// The content of a chunk, cut off if the file is cut off; empty if there is no such chunk.
std::string chunk(const std::string& bytes, const std::string& name) {
  for (std::size_t offset = 12; offset + 8 <= bytes.size();) {
    const std::size_t size = valueAt<std::uint32_t>(bytes, offset + 4);
    if (bytes.compare(offset, 4, name) == 0) {
      return bytes.substr(offset + 8, size);
    }
    offset += 8 + size + size % 2;
  }
  return {};
}

}  // namespace

std::vector<OSoundSampleStereo16> readWav(const std::string& path) {
  const std::string bytes = readFile(path);
  const std::string format_chunk = chunk(bytes, "fmt ");
  if (bytes.compare(0, 4, "RIFF") != 0 || format_chunk.size() < sizeof(Format)) {
    throw SoundError(path + ": is not a WAV file");
  }
  const auto format = valueAt<Format>(format_chunk, 0);
  const bool is_pcm = format.encoding == kPcm || format.encoding == kExtensible;
  if (!is_pcm || format.bits != 16 || format.rate != kRate || format.channels < 1 || format.channels > 2) {
    throw SoundError(path + ": is not in the format 16 kHz, 16 bits, one or two channels; convert it: sox " + path +
                     " -r 16000 -b 16 -c 1 OTHER.wav");
  }
  const std::string data = chunk(bytes, "data");
  std::vector<OSoundSampleStereo16> samples(data.size() / (2U * format.channels));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t left = 2 * i * format.channels;
    samples[i] = {valueAt<sword>(data, left), valueAt<sword>(data, left + 2U * (format.channels - 1U))};
  }
  return samples;
}

WavWriter::WavWriter(const std::string& path) : file_(path, std::ios::binary) {
  writeHeader(kEndless);
  if (!file_.flush()) {
    throw SoundError(path + ": cannot be written");
  }
}

WavWriter::~WavWriter() {
  if (file_.seekp(0)) {  // fails in a pipe
    writeHeader(size_);
  }
}

void WavWriter::write(const openr_host::SpeakerFrame& samples) {
  file_.write(reinterpret_cast<const char*>(samples.data()), sizeof(samples)).flush();
  size_ += static_cast<std::uint32_t>(sizeof(samples));
}

void WavWriter::writeHeader(std::uint32_t size) {
  const auto put = [this](const auto& value) { file_.write(reinterpret_cast<const char*>(&value), sizeof(value)); };
  file_.write("RIFF", 4);
  put(static_cast<std::uint32_t>(size + kHeaderSize - 8));
  file_.write("WAVEfmt ", 8);
  put(static_cast<std::uint32_t>(sizeof(Format)));
  put(formatOf(1));
  file_.write("data", 4);
  put(size);
}

}  // namespace simulated_ers7
