/// @file Microphone.h
/// What the robot hears.
#ifndef AIBO_RCSERVER_RCSERVER_SOUND_MICROPHONE_H
#define AIBO_RCSERVER_RCSERVER_SOUND_MICROPHONE_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObserver.h>

#include "protocol/sound_requests.h"

/// Asks OVirtualRobotAudioComm for sound while a client listens, and converts it into what the client has asked for.
/// OPEN-R gives 16 kHz, 16 bits, left and right (Level2 Reference Guide, page 44), in vectors of 16 ms on an ERS-7
/// (sample SoundRec).
class Microphone {
 public:
  /// Samples of each channel in the largest vector that is converted, 64 ms; the rest of a larger one is left out.
  static const size_t MAX_SAMPLES = 1024;

  Microphone();

  /// Call in DoStart. Nothing is heard yet.
  /// @param gate to OVirtualRobotAudioComm.Mic; must outlive this
  void Start(OObserver* gate);

  bool IsOn() const { return (settings_.mode & protocol::version2::MICROPHONE_ON) != 0; }

  /// True if the client wants pictures to wait for sound.
  bool GoesFirst() const { return (settings_.mode & protocol::version2::SOUND_FIRST) != 0; }

  /// Sets what is to be heard from now on.
  void Set(const protocol::version2::MicrophoneSettings& settings);

  /// Hears no more.
  void ClientGone();

  /// A vector has been dealt with.
  void AskForMore();

  /// Converts a vector. Only if IsOn().
  /// @param[out] out room for 4 * MAX_SAMPLES bytes: samples as they are sent
  /// @return what goes before them
  protocol::version2::HeardSound Convert(OSoundVectorData* vector, unsigned char* out);

 private:
  Microphone(const Microphone&);
  Microphone& operator=(const Microphone&);

  // A power of two that is not less than the 23 samples that the filter looks at.
  static const int RING_SIZE = 32;

  int Filtered(int channel) const;

  OObserver* gate_;
  protocol::version2::MicrophoneSettings settings_;
  int last_[2][RING_SIZE];  ///< the last samples of each channel, as a ring
  int next_;                ///< in the rings, where the newest samples are
  bool left_out_;           ///< at 8 kHz: the last sample was
};

#endif  // AIBO_RCSERVER_RCSERVER_SOUND_MICROPHONE_H
