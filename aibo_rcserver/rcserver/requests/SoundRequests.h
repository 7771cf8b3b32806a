/// @file SoundRequests.h
/// The request of version 2 about sound, and its pushes.
#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_SOUND_REQUESTS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_SOUND_REQUESTS_H

#include "protocol/sound_requests.h"
#include "rcserver/body/Microphone.h"
#include "rcserver/body/Speaker.h"
#include "rcserver/requests/Exchange.h"

/// Lets the client hear and play sound, and set the volume.
class SoundRequests {
 public:
  /// All must outlive this.
  SoundRequests(Microphone& microphone, Speaker& speaker, Exchange& exchange)
      : microphone_(microphone), speaker_(speaker), exchange_(exchange) {}

  /// `A`
  void CarryOut();

  /// Pushes sound from the microphone, if the client listens. What does not fit in the outbox is lost. The frame
  /// numbers show this to the client.
  void Heard(OSoundVectorData* vector);

  /// Pushes the ends of sounds. One that does not fit in the outbox is pushed the next time.
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
