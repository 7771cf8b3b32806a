/// @file wav_files.h
#ifndef TEST_UNIT_SOUND_WAV_FILES_H
#define TEST_UNIT_SOUND_WAV_FILES_H

#include <sndfile.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// Writes a sound file.
/// @param format of libsndfile
inline void writeSoundFile(const std::string& path, const std::vector<std::int16_t>& samples, int rate = 16000,
                           int channels = 1, int format = SF_FORMAT_WAV | SF_FORMAT_PCM_16) {
  SF_INFO info = {};
  info.samplerate = rate;
  info.channels = channels;
  info.format = format;
  SNDFILE* const file = ::sf_open(path.c_str(), SFM_WRITE, &info);
  if (file == nullptr) {
    throw std::runtime_error(::sf_strerror(nullptr));
  }
  ::sf_write_short(file, samples.data(), static_cast<sf_count_t>(samples.size()));
  ::sf_close(file);
}

/// A tone of 1 kHz.
inline std::vector<std::int16_t> tone(std::size_t samples, int rate = 16000) {
  std::vector<std::int16_t> result(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    result[i] =
        static_cast<std::int16_t>(std::lrint(10000 * std::sin(2 * M_PI * 1000 * static_cast<double>(i) / rate)));
  }
  return result;
}

#endif  // TEST_UNIT_SOUND_WAV_FILES_H
