// The request and the pushes of version 2 about sound.
#include "protocol/sound_requests.h"

#include <stdio.h>

#include "rcserver/requests/Version2.h"

using namespace protocol::version2;

template <>
void Version2::CarryOut<REQUEST_SOUND>() {
  switch (request_.id) {
    case SOUND_MICROPHONE:
      return SetMicrophone();
    case SOUND_SPEAKER:
      return PlaySound();
    case SOUND_VOLUME:
      return SetSpeakerVolume();
    default:
      Refuse(CODE_REFUSED, "bad request: the id is not 1 (microphone), 2 (speaker) or 3 (volume)");
  }
}

// Drops sound that was recorded with the earlier settings.
void Version2::SetMicrophone() {
  MicrophoneSettings wanted;
  if (Decode(&wanted) &&
      ((wanted.mode & MICROPHONE_ON) == 0 || IsAllowed(&Settings::allow_microphone, LISTEN.setting))) {
    robot_.microphone.Set(wanted);
    outbox_.Sound().Drop();
    Reply(wanted);
  }
}

void Version2::PlaySound() {
  PlayedSound part;
  if (!Decode(&part) || !IsAllowed(&Settings::allow_sound, PLAY_SOUND.setting)) {
    return;
  }
  if (const char* const problem = robot_.speaker.Play(part)) {
    return Refuse(CODE_REFUSED, problem);
  }
  const SpeakerRoom room = {robot_.speaker.Room()};
  Reply(room);
}

void Version2::SetSpeakerVolume() {
  protocol::version2::Volume volume;
  if (request_.payload_size > 0) {
    if (!Decode(&volume) || !IsAllowed(&Settings::allow_sound, SET_VOLUME.setting)) {
      return;
    }
    if (!robot_.speaker.SetVolume(volume.step)) {
      return Refuse(CODE_REFUSED, "the robot's speaker does not take this volume; the robot's console says why");
    }
  }
  volume.step = robot_.speaker.Volume();
  Reply(volume);
}

// Sound that does not fit in the outbox is lost. The client can tell by the frame numbers.
void Version2::Heard(OSoundVectorData* vector) {
  if (!robot_.microphone.IsOn()) {
    return;
  }
  HeardSound heard = robot_.microphone.Convert(vector, Payload() + HEARD_SOUND_HEADER_SIZE);
  const size_t samples_size = heard.samples_size;
  heard.samples_size = 0;  // they are already in place
  const size_t size = encode(heard, Payload()) + samples_size;
  outbox_.Sound().Add(message_, Frame(SOUND_PUSH, SOUND_MICROPHONE, 0, size));
}

// An end that does not fit in the outbox is pushed the next time.
void Version2::PushSoundEnds() {
  SoundEnd end;
  while (outbox_.HasRoom() && robot_.speaker.TakeEnd(&end)) {
    outbox_.Add(message_, Frame(SOUND_PUSH, SOUND_SPEAKER, 0, encode(end, Payload())));
  }
}
