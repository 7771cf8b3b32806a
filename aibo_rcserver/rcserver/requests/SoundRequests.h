#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_SOUND_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_SOUND_REQUESTS_H

#include "protocol/sound_requests.h"
#include "rcserver/body/Microphone.h"
#include "rcserver/body/Speaker.h"
#include "rcserver/requests/Exchange.h"

/// Lets the client hear and play sound, and set the volume.
class SoundRequests {
 public:
  SoundRequests(Microphone& microphone, Speaker& speaker, Exchange& exchange)
      : microphone_(microphone), speaker_(speaker), exchange_(exchange) {}

  /// Carries out `A`.
  void CarryOut();

  /// Pushes sound from the microphone, if the client listens. Sound for which the outbox has no room is lost, which the
  /// client sees from the frame numbers.
  void Heard(OSoundVectorData* vector);

  /// True if the client wants sound before pictures, and some waits or is needed.
  bool GoesFirst() const { return microphone_.GoesFirst() && (exchange_.Out().HasSound() || speaker_.IsShort()); }

  /// Pushes the ends of sounds. An end for which the outbox has no room is pushed the next time.
  void PushEnds();

 private:
  void SetMicrophone();
  void Play();
  void SetVolume();

  Microphone& microphone_;
  Speaker& speaker_;
  Exchange& exchange_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_SOUND_REQUESTS_H
