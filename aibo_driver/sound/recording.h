/// @file recording.h
#ifndef AIBO_DRIVER_SOUND_RECORDING_H
#define AIBO_DRIVER_SOUND_RECORDING_H

#include <sndfile.h>

#include <cstdint>
#include <memory>
#include <string>

#include "aibo_client/sound.h"

namespace aibo_driver::sound {

/// Writes what the robot hears to a WAV file. Sound that is missing becomes silence, so that the rest keeps its place
/// in time. After each part the file is complete, so nothing is lost if the disk is full or the program is killed.
class Recording {
 public:
  /// @param path the path of a file that does not exist yet, in a folder that does
  /// @param settings the settings of the sound
  /// @throw files::FileException it cannot be written
  Recording(const std::string& path, const aibo_client::MicrophoneSettings& settings);

  /// Adds the sound that was heard next.
  /// @throw files::FileException it cannot be written
  void add(const aibo_client::HeardSound& sound);

 private:
  void write(const std::int16_t* samples, std::size_t frames);

  const std::string path_;
  const aibo_client::MicrophoneSettings settings_;
  std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> file_;
};

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_RECORDING_H
