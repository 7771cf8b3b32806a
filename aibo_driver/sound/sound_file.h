/// @file sound_file.h
#ifndef AIBO_DRIVER_SOUND_SOUND_FILE_H
#define AIBO_DRIVER_SOUND_SOUND_FILE_H

#include <memory>
#include <string>

#include "client/file_descriptor.h"
#include "sound/source.h"

namespace aibo_driver::sound {

/// Opens a sound file: WAV, FLAC or Ogg, of any rate, with up to 8 channels, of which the mean is played. It is read
/// while it plays, so its length does not matter.
///
/// Anybody who may ask for a sound may name any file, and somebody else may have taken the robot's place. So only
/// sounds leave this computer.
/// @param path for files::openToRead()
/// @throw files::FileException the file cannot be read, or is no such sound; the message says why
std::unique_ptr<Source> openSoundFile(const std::string& path);

/// The same for a file that is open.
/// @param name for messages
std::unique_ptr<Source> readSound(aibo_client::FileDescriptor file, const std::string& name);

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_SOUND_FILE_H
