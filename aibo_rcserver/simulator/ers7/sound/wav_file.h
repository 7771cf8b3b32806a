/// @file wav_file.h
/// Sound files that the simulated robot hears and writes.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_WAV_FILE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_WAV_FILE_H

#include <OPENR/ODataFormats.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/openr_host/virtual_robot.h"

namespace simulated_ers7 {

/// Thrown if a sound file cannot be used. The text names the file and a remedy.
class SoundError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a WAV file: PCM, 16 bits, 16 kHz, one channel, which both microphones hear, or two.
/// @throw SoundError the file has another format or cannot be read
std::vector<OSoundSampleStereo16> readWav(const std::string& path);

/// Writes the speaker's sound to a mono WAV file, or to a pipe, so that a program can play it at once. The header of a
/// file gets the size when this object is destroyed. Until then, as in a pipe, the sound ends where the file ends.
class WavWriter {
 public:
  /// @throw SoundError the file cannot be written
  explicit WavWriter(const std::string& path);
  ~WavWriter();
  WavWriter(const WavWriter&) = delete;
  WavWriter& operator=(const WavWriter&) = delete;

  void write(const openr_host::SpeakerFrame& samples);

 private:
  void writeHeader(std::uint32_t size);

  std::ofstream file_;
  std::uint32_t size_ = 0;  ///< bytes of samples
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_WAV_FILE_H
