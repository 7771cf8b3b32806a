/// @file speaker_and_microphones.h
/// The simulated robot's speaker and microphones.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_SPEAKER_AND_MICROPHONES_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_SPEAKER_AND_MICROPHONES_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/OPrimitiveControl.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/ers7/sound/wav_file.h"
#include "simulator/openr_host/virtual_robot.h"

namespace simulated_ers7 {

/// The speaker and both microphones (Model Information ERS-7, 3.1.2 and 3.2.2). The loudest volume plays samples
/// unchanged. At lower volumes, samples are softer by Sony's decibels.
class SpeakerAndMicrophones {
 public:
  /// @param speaker_file WAV file for the sound that the speaker plays, without the pauses between sounds; empty for
  ///   none
  /// @param hears_itself share of the speaker's sound that reaches the microphones, 0..1
  /// @throw SoundError the file cannot be written
  SpeakerAndMicrophones(const std::string& speaker_file, double hears_itself);

  OSpeakerSoundType soundType() const { return settings_.type; }

  /// Carries out a request of OPENR::ControlPrimitive() to the speaker.
  OStatus control(OPrimitiveRequest request, void* param, std::size_t param_size);

  /// Plays and hears for 8 ms.
  openr_host::MicrophoneFrame passFrame(longword frame, const openr_host::SpeakerFrame* played);

  /// From the next frame on, the microphones hear these samples once, then silence.
  void hear(std::vector<OSoundSampleStereo16> samples);

  /// Restores the state after boot.
  void reset() { settings_ = Settings(); }

 private:
  struct Settings {
    OSpeakerSoundType type = ospksndMONO8K8B;
    OSpeakerVolume volume = ospkvol10dB;
    bool is_mute = false;
  };

  double gain() const;

  std::unique_ptr<WavWriter> writer_;
  double hears_itself_;
  Settings settings_;
  std::vector<OSoundSampleStereo16> heard_;
  std::optional<longword> heard_since_;  ///< empty until an object listens
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SOUND_SPEAKER_AND_MICROPHONES_H
