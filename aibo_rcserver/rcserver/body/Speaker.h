#ifndef AIBO_RCSERVER_RCSERVER_BODY_SPEAKER_H
#define AIBO_RCSERVER_RCSERVER_BODY_SPEAKER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OSubject.h>

#include "protocol/sound_requests.h"
#include "rcserver/Queue.h"
#include "rcserver/body/Primitives.h"
#include "rcserver/body/VectorPair.h"

/// Plays one sound at a time. A sample that has not come in time is replaced by silence, and is dropped when it comes.
///
/// The speaker is opened when the first sound is played.
class Speaker {
 public:
  /// Samples in a vector: 32 ms, as in Sony's samples SoundPlay and SoundAgent.
  static const int VECTOR_SAMPLES = 512;

  Speaker();

  /// @param gate to OVirtualRobotAudioComm.Speaker
  void Start(OSubject* gate) { vectors_.Start(gate); }

  /// Takes samples, or an order to stop.
  /// @return NULL, or why the samples are refused; in that case nothing changes
  const char* Play(const protocol::version2::PlayedSound& part);

  unsigned Room() const;

  /// True if little of the present sound waits, and more is to come.
  bool IsShort() const {
    return sound_.is_playing && !sound_.has_last && Room() > protocol::version2::SPEAKER_CAPACITY / 2;
  }

  /// Call this on READY: it sends the next vectors.
  void IsReady();

  /// Takes out the report of a sound that has ended.
  /// @return false if no sound has ended
  bool TakeEnd(protocol::version2::SoundEnd* end) { return ends_.Take(end); }

  /// @param step 0..MAX_VOLUME, or VOLUME_OF_ROBOT
  /// @return false if the robot refuses; the console says why
  bool SetVolume(unsigned char step);

  unsigned char Volume() const;

  /// Stops the sound. Vectors that have already been sent are still played, at most 64 ms.
  void ClientGone();

 private:
  struct Sound {
    bool is_playing;
    bool has_last;          ///< the sound ends at `end`
    int vectors_until_end;  ///< how many vectors must be output until the sound has ended; 0 if it does not end yet
    unsigned begin;         ///< position of the next sample for a vector
    unsigned end;           ///< position after the last sample that waits
    bool is_in_gap;
    unsigned starved;  ///< samples of silence since the last sample came
    unsigned gaps;
    unsigned missing;
  };

  const char* Begin();
  const char* Add(const protocol::version2::PlayedSound& part, unsigned size);
  void AddSilence();
  void End(unsigned char how);
  bool Open();
  bool CreateVectors();
  bool Control(OPrimitiveRequest request, longword value, const char* what);
  void Send();
  void Fill(RCRegion* vector);
  unsigned Waiting() const { return sound_.end - sound_.begin; }

  Primitives primitives_;
  VectorPair vectors_;
  unsigned char volume_;                                 ///< set by a client, or VOLUME_OF_ROBOT
  Sound sound_;                                          ///< the present sound, or the last one
  short samples_[protocol::version2::SPEAKER_CAPACITY];  ///< a ring, in which each sample has its place by its position

  // Two sounds can end before the reports are taken: one that a new sound replaces, and the new one.
  Queue<protocol::version2::SoundEnd, 2> ends_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_SPEAKER_H
