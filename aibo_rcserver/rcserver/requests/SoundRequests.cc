#include "rcserver/requests/SoundRequests.h"

using namespace protocol::version2;

void SoundRequests::CarryOut() {
  switch (exchange_.Id()) {
    case SOUND_MICROPHONE:
      return SetMicrophone();
    case SOUND_SPEAKER:
      return Play();
    case SOUND_VOLUME:
      return SetVolume();
    default:
      exchange_.Refuse(CODE_REFUSED, "bad request: the id is not 1 (microphone), 2 (speaker) or 3 (volume)");
  }
}

// Sets the microphone. Sound that waits was recorded with the earlier settings, and is dropped.
void SoundRequests::SetMicrophone() {
  MicrophoneSettings wanted;
  if (exchange_.Decode(&wanted) && ((wanted.mode & MICROPHONE_ON) == 0 || exchange_.IsAllowed(LISTEN.setting))) {
    microphone_.Set(wanted);
    exchange_.Out().Sound().Drop();
    exchange_.Reply(wanted);
  }
}

void SoundRequests::Play() {
  PlayedSound part;
  if (!exchange_.Decode(&part) || !exchange_.IsAllowed(PLAY_SOUND.setting)) {
    return;
  }
  if (const char* const problem = speaker_.Play(part)) {
    return exchange_.Refuse(CODE_REFUSED, problem);
  }
  const SpeakerRoom room = {speaker_.Room()};
  exchange_.Reply(room);
}

void SoundRequests::SetVolume() {
  protocol::version2::Volume volume;
  if (exchange_.HasPayload()) {
    if (!exchange_.Decode(&volume) || !exchange_.IsAllowed(SET_VOLUME.setting)) {
      return;
    }
    if (!speaker_.SetVolume(volume.step)) {
      return exchange_.Refuse(CODE_REFUSED,
                              "the robot's speaker does not take this volume; the robot's console says why");
    }
  }
  volume.step = speaker_.Volume();
  exchange_.Reply(volume);
}

void SoundRequests::Heard(OSoundVectorData* vector) {
  if (!microphone_.IsOn()) {
    return;
  }
  HeardSound heard = microphone_.Convert(vector, exchange_.Payload() + HEARD_SOUND_HEADER_SIZE);
  const size_t samples_size = heard.samples_size;
  heard.samples_size = 0;  // the samples are already in place
  const size_t payload_size = encode(heard, exchange_.Payload()) + samples_size;
  const size_t size = exchange_.Complete(SOUND_PUSH, SOUND_MICROPHONE, 0, payload_size);
  exchange_.Out().Sound().Add(exchange_.Message(), size);
}

void SoundRequests::PushEnds() {
  SoundEnd end;
  while (exchange_.HasRoom() && speaker_.TakeEnd(&end)) {
    exchange_.Push(SOUND_PUSH, end, SOUND_SPEAKER);
  }
}
