/// Version 2's request `A` and its push `a`: what the robot hears, what it plays, and how loud.
///
/// Sound is linear PCM, 16 bits a sample, big-endian as all integers are. Time is that of the robot: 128 samples at
/// 16000/s last one OPEN-R frame (8 ms).
#ifndef AIBO_RCSERVER_PROTOCOL_SOUND_REQUESTS_H
#define AIBO_RCSERVER_PROTOCOL_SOUND_REQUESTS_H

#include "protocol/fields.h"
#include "protocol/request.h"

namespace protocol {
namespace version2 {

const char REQUEST_SOUND = 'A';  ///< microphone, speaker or volume, id = SoundPart
const char SOUND_PUSH = 'a';     ///< what was heard, or how a sound ended, if request_number is 0; otherwise a reply

const Request LISTEN = {REQUEST_SOUND, "listen", 0, "ALLOW_MICROPHONE"};
const Request PLAY_SOUND = {REQUEST_SOUND, "play sound", 0, "ALLOW_SOUND"};
const Request TELL_VOLUME = {REQUEST_SOUND, "tell its volume", 0, NULL};
const Request SET_VOLUME = {REQUEST_SOUND, "set its volume", 0, "ALLOW_SOUND"};

/// The id of `A` and of `a`.
enum SoundPart {
  SOUND_MICROPHONE = 1,  ///< MicrophoneSettings, answered by the same; then HeardSound is pushed
  SOUND_SPEAKER = 2,     ///< PlayedSound, answered by SpeakerRoom; SoundEnd is pushed when the sound has ended
  SOUND_VOLUME = 3       ///< Volume, or no payload to read it; answered by the volume in force
};

const unsigned SAMPLES_PER_FRAME = 128;  ///< at 16000/s
const size_t BYTES_PER_SAMPLE = 2;

/// Bits of MicrophoneSettings::mode. Without SOUND_FIRST, a picture that is ready is sent before the sound that waits
/// on the robot. With SOUND_FIRST, pictures wait until what was heard has been sent, and while less than half a second
/// waits for the speaker.
enum MicrophoneMode { MICROPHONE_ON = 1, SOUND_FIRST = 2 };

/// Payload of `A` 1 and of its reply. The ERS-7 hears two channels at 16000 samples/s. One channel is the mean of both.
struct MicrophoneSettings {
  unsigned char mode;                 ///< bits of MicrophoneMode
  unsigned char channels;             ///< 1, or 2: left, right
  unsigned short samples_per_second;  ///< 8000 or 16000

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(mode);
    fields.require(mode <= (MICROPHONE_ON | SOUND_FIRST), "the mode has bits besides 1 (on) and 2 (sound goes first)");
    fields.number(channels);
    fields.require(channels == 1 || channels == 2, "sound has one or two channels");
    fields.number(samples_per_second);
    fields.require(samples_per_second == 8000 || samples_per_second == 16000, "the rate is neither 8000 nor 16000");
  }
};

/// Payload of a pushed `a` 1. If the frame numbers of two pushes are further apart than the first push lasts, sound is
/// missing between them: it could not be sent in time.
struct HeardSound {
  unsigned frame_number;  ///< OPEN-R frame (8 ms) in which the first sample was heard
  unsigned short count;   ///< number of samples of each channel
  unsigned char channels;
  const unsigned char* samples;  ///< big-endian int16; left and right in turn; after decoding, points into the payload
  size_t samples_size;           ///< bytes; 0 encodes everything except the samples, which the caller appends

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(frame_number);
    fields.number(count);
    fields.number(channels);
    fields.require(channels == 1 || channels == 2, "sound has one or two channels");
    fields.zeros(1);
    fields.content(samples, samples_size);
    fields.require(samples_size == count * channels * BYTES_PER_SAMPLE,
                   "the count does not match the size of the payload");
  }
};

const size_t HEARD_SOUND_HEADER_SIZE = 8;

/// Payload of `A` 2: mono sound, 16000 samples/s.
///
/// Position 0 begins a sound and replaces one that plays; if it is the last and has no samples, it only stops the sound
/// that plays. A sound begins with its first samples, so 64 ms or more should come at once. A sample is played
/// `position` samples after the first one. So the robot plays silence in place of samples that come too late or not at
/// all, and leaves out late ones. A part that has no samples and is not the last asks how many may follow.
struct PlayedSound {
  unsigned position;             ///< position of the first sample in the whole sound
  bool last;                     ///< the sound ends with these samples
  const unsigned char* samples;  ///< big-endian int16; after decoding, points into the payload
  size_t samples_size;           ///< bytes

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(position);
    fields.flag(last, "the mark of the last samples is neither 0 nor 1");
    fields.zeros(3);
    fields.content(samples, samples_size);
    fields.require(samples_size % BYTES_PER_SAMPLE == 0, "half a sample");
  }
};

/// The most samples that can wait on the robot, 1.02 s. A request with more than there is room for is refused.
const unsigned SPEAKER_CAPACITY = 16384;

/// A sound ends (END_REFUSED) when no sample has come for this long.
const unsigned SPEAKER_TIMEOUT_MS = 2000;

/// Payload of the reply to `A` 2. While the sound plays, 16000 more may follow each second.
struct SpeakerRoom {
  unsigned samples;  ///< how many may follow now

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(samples);
  }
};

/// Payload of an `a` 2 that is pushed when the last sample has been played, or when the sound has ended otherwise.
struct SoundEnd {
  unsigned char how;  ///< END_DONE, END_REPLACED, END_STOPPED, END_REFUSED: nothing more came; expect others
  unsigned samples;   ///< samples that were played, with the silence in the gaps
  unsigned gaps;      ///< how often samples did not come in time
  unsigned missing;   ///< samples of silence in these gaps

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(how);
    fields.zeros(3);
    fields.number(samples);
    fields.number(gaps);
    fields.number(missing);
  }
};

/// The volume that the robot's own switch selects. It is in force until a client sets another volume, and again when
/// that client has gone. A reply never has this value.
const unsigned char VOLUME_OF_ROBOT = 255;
const unsigned char MAX_VOLUME = 3;

/// Payload of `A` 3 and of its reply: 0 is silent, 3 the loudest, and VOLUME_OF_ROBOT is allowed. On an ERS-7, 1, 2 and
/// 3 are -25, -18 and -10 dB (Model Information ERS-7, 3.1.2).
struct Volume {
  unsigned char step;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(step);
    fields.require(step <= MAX_VOLUME || step == VOLUME_OF_ROBOT, "the volume is not 0 to 3, nor 255 for the robot's");
  }
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_SOUND_REQUESTS_H
