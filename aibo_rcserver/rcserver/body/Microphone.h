#ifndef AIBO_RCSERVER_RCSERVER_BODY_MICROPHONE_H
#define AIBO_RCSERVER_RCSERVER_BODY_MICROPHONE_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObserver.h>

#include "protocol/sound_requests.h"

/// Asks OVirtualRobotAudioComm for sound while a client listens, and converts it to the client's settings. OPEN-R
/// delivers 16 kHz, 16 bits, left and right (Level2 Reference Guide, page 44), in vectors of 16 ms on an ERS-7 (sample
/// SoundRec).
class Microphone {
 public:
  /// Most samples of each channel that are converted in a vector: 64 ms. Further ones are left out.
  static const size_t MAX_SAMPLES = 1024;

  Microphone();

  /// Call this in DoStart. No sound is requested yet.
  /// @param gate to OVirtualRobotAudioComm.Mic
  void Start(OObserver* gate);

  bool IsOn() const { return (settings_.mode & protocol::version2::MICROPHONE_ON) != 0; }

  /// True if the client wants pictures to wait for sound.
  bool GoesFirst() const { return (settings_.mode & protocol::version2::SOUND_FIRST) != 0; }

  void Set(const protocol::version2::MicrophoneSettings& settings);
  void ClientGone();

  /// Call this after a vector has been processed.
  void AskForMore();

  /// Converts a vector. Call this only if IsOn().
  /// @param[out] out room for 4 * MAX_SAMPLES bytes; gets the samples as they are sent
  /// @return the header that precedes them
  protocol::version2::HeardSound Convert(OSoundVectorData* vector, unsigned char* out);

 private:
  // A power of two that is at least the 23 samples of the filter.
  static const int RING_SIZE = 32;

  int Filtered(int channel) const;

  OObserver* gate_;
  protocol::version2::MicrophoneSettings settings_;
  int last_[2][RING_SIZE];  ///< the last samples of each channel, as a ring
  int next_;                ///< index of the newest samples in the rings
  bool left_out_;           ///< at 8 kHz: the last sample was left out
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_MICROPHONE_H
