/// @file source.h
/// Sounds for the robot, from files and from texts.
#ifndef AIBO_DRIVER_SOUND_SOURCE_H
#define AIBO_DRIVER_SOUND_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"

namespace aibo_driver::sound {

/// Supplies the next samples of a sound that the robot will play: mono, aibo_client::kSoundRate samples a second. It
/// returns `most` samples; fewer only at the end.
using Source = std::function<std::vector<std::int16_t>(std::size_t most)>;

/// Opens a sound file: WAV, FLAC or Ogg, of any rate, with up to 8 channels, of which the mean is played. The file is
/// read while it plays, so its length does not matter unless it is gzipped.
///
/// Anybody who may ask for a sound may name any file, and somebody else may have taken the robot's place. So only
/// sounds leave this computer.
/// @param path for files::openToRead()
/// @throw files::FileException the file cannot be read, or is no such sound; the message says why
Source openSoundFile(const std::string& path);

/// Does the same for a file that is open.
/// @param name for messages
Source readSound(host_files::FileDescriptor file, const std::string& name);

/// Speaks a text, by the program espeak-ng. It returns when the whole text has been spoken, which takes a fraction of
/// the time that it plays.
/// @param text of at most 4000 bytes
/// @param voice one of `espeak-ng --voices`, such as "en" or "de"; empty: English
/// @throw InvalidArgumentException there is no text, it is too long, or the voice cannot be one
/// @throw files::FileException espeak-ng is not installed, or has failed; the message says what to do
Source speak(const std::string& text, const std::string& voice);

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_SOURCE_H
