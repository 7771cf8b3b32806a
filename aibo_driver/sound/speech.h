/// @file speech.h
#ifndef AIBO_DRIVER_SOUND_SPEECH_H
#define AIBO_DRIVER_SOUND_SPEECH_H

#include <memory>
#include <string>

#include "sound/source.h"

namespace aibo_driver::sound {

/// Speaks a text, by the program espeak-ng. It returns when the whole text has been spoken, which takes a fraction of
/// the time that it plays.
/// @param text of at most 4000 bytes
/// @param voice one of `espeak-ng --voices`, such as "en" or "de"; empty: English
/// @throw InvalidArgumentException there is no text, it is too long, or the voice cannot be one
/// @throw files::FileException espeak-ng is not installed, or has failed; the message says what to do
std::unique_ptr<Source> speak(const std::string& text, const std::string& voice);

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_SPEECH_H
