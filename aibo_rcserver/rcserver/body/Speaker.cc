#include "rcserver/body/Speaker.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSyslog.h>
#include <string.h>

#include "protocol/version2.h"

using protocol::decodeBigEndianSigned16;
using namespace protocol::version2;

namespace {

const int SPEAKER = 0;

// The speaker's locator on an ERS-7. An ERS-210 has its speaker in the head (the sample SoundPlay).
const char LOCATOR[] = "PRM:/s1-Speaker:S1";
const char LOCATOR_IN_HEAD[] = "PRM:/r1/c1/c2/c3/s1-Speaker:S1";

const unsigned SAMPLES_PER_SECOND = 16000;
const unsigned MOST_STARVED = SPEAKER_TIMEOUT_MS * (SAMPLES_PER_SECOND / 1000);

// The volume of each step (Model Information ERS-7, 3.1.2).
const longword VOLUMES[MAX_VOLUME + 1] = {ospkvolinfdB, ospkvol25dB, ospkvol18dB, ospkvol10dB};

// Positions may overflow, so only their differences are compared.
bool IsAfter(unsigned position, unsigned other) {
  return static_cast<int>(position - other) > 0;
}

OSoundVectorData* VectorIn(RCRegion* region) {
  void* base = region->Base();
  return static_cast<OSoundVectorData*>(base);
}

}  // namespace

const int Speaker::VECTOR_SAMPLES;

Speaker::Speaker() : vectors_(OPENR::DeleteSoundVectorData), volume_(VOLUME_OF_ROBOT), sound_() {}

const char* Speaker::Play(const PlayedSound& part) {
  const unsigned size = static_cast<unsigned>(part.samples_size / BYTES_PER_SAMPLE);
  if (size == 0 && !part.last) {
    return NULL;  // the part without samples only asks for the progress
  }
  if (part.position == 0 && size == 0) {
    End(END_STOPPED);
    return NULL;
  }
  const char* const problem = part.position == 0 && size <= SPEAKER_CAPACITY ? Begin() : NULL;
  return problem != NULL ? problem : Add(part, size);
}

unsigned Speaker::Room() const {
  return SPEAKER_CAPACITY - (sound_.is_playing ? Waiting() : 0);
}

const char* Speaker::Begin() {
  if (!Open()) {
    return "the robot's speaker cannot be used; the robot's console says why";
  }
  if (!vectors_.IsConnected()) {
    return "the robot's speaker takes no sound: CONNECT.CFG on the memory stick does not connect it";
  }
  End(END_REPLACED);
  sound_ = Sound();
  sound_.is_playing = true;
  return NULL;
}

const char* Speaker::Add(const PlayedSound& part, unsigned size) {
  const unsigned after = part.position + size;
  if (!sound_.is_playing || sound_.has_last) {
    return "no sound is being played; one begins with the sample at position 0";
  }
  const unsigned most = sound_.begin + SPEAKER_CAPACITY;
  if (size > SPEAKER_CAPACITY || IsAfter(part.position, most) || IsAfter(after, most)) {
    return "the robot has no room for so many samples yet; the answers say how many may follow";
  }
  while (IsAfter(part.position, sound_.end)) {
    AddSilence();
  }
  while (IsAfter(after, sound_.end)) {
    const size_t offset = (sound_.end - part.position) * BYTES_PER_SAMPLE;
    samples_[sound_.end % SPEAKER_CAPACITY] = decodeBigEndianSigned16(part.samples + offset);
    ++sound_.end;
    sound_.is_in_gap = false;
    sound_.starved = 0;
  }
  sound_.has_last = part.last;
  Send();
  return NULL;
}

// Adds a sample of silence in place of one that has not come.
void Speaker::AddSilence() {
  samples_[sound_.end % SPEAKER_CAPACITY] = 0;
  ++sound_.end;
  sound_.gaps += sound_.is_in_gap ? 0 : 1;
  sound_.is_in_gap = true;
  ++sound_.missing;
}

void Speaker::End(unsigned char how) {
  if (!sound_.is_playing) {
    return;
  }
  sound_.is_playing = false;
  const SoundEnd end = {how, sound_.begin, sound_.gaps, sound_.missing};
  ends_.Add(end);
}

void Speaker::IsReady() {
  if (vectors_.IsReady() && sound_.vectors_until_end > 0 && --sound_.vectors_until_end == 0) {
    End(END_DONE);
  }
  if (sound_.is_playing && sound_.starved >= MOST_STARVED) {
    End(END_REFUSED);
  }
  Send();
}

bool Speaker::SetVolume(unsigned char step) {
  const unsigned char before = volume_;
  volume_ = step;
  const bool succeeds = Open();
  volume_ = succeeds ? step : before;
  return succeeds;
}

unsigned char Speaker::Volume() const {
  OVolumeSwitch robots = ovolumeSW0;
  if (volume_ != VOLUME_OF_ROBOT) {
    return volume_;
  }
  return OPENR::GetVolumeSwitch(&robots) == oSUCCESS && robots <= MAX_VOLUME ? robots : MAX_VOLUME;
}

void Speaker::ClientGone() {
  sound_ = Sound();
  ends_.Clear();
  if (volume_ != VOLUME_OF_ROBOT) {
    volume_ = VOLUME_OF_ROBOT;
    Open();  // if the robot refuses now, the next sound sets the volume
  }
}

// Opens the speaker, unless it is already open, and sets its volume, because the robot's own switch may have moved. At
// volume 0, the speaker is also muted, which is our choice: -infinity dB should suffice.
bool Speaker::Open() {
  if (!primitives_.IsOpen(SPEAKER)) {
    char design[orobotdesignNAME_MAX + 1] = "";
    OPENR::GetRobotDesign(design);
    const char* const locator = strcmp(design, "ERS-7") == 0 ? LOCATOR : LOCATOR_IN_HEAD;
    if (!CreateVectors() || !primitives_.Open(SPEAKER, "speaker", locator)) {
      return false;
    }
    if (!Control(oprmreqSPEAKER_SET_SOUND_TYPE, ospksndMONO16K16B, "sound of 16 kHz")) {
      primitives_.Close();
      return false;
    }
  }
  const unsigned char step = Volume();
  const OStatus mute = OPENR::ControlPrimitive(
      primitives_.Id(SPEAKER), step == 0 ? oprmreqSPEAKER_MUTE_ON : oprmreqSPEAKER_MUTE_OFF, NULL, 0, NULL, 0);
  return Control(oprmreqSPEAKER_SET_VOLUME, VOLUMES[step], "this volume") && mute == oSUCCESS;
}

bool Speaker::Control(OPrimitiveRequest request, longword value, const char* what) {
  const OStatus status = OPENR::ControlPrimitive(primitives_.Id(SPEAKER), request, &value, sizeof(value), NULL, 0);
  if (status != oSUCCESS) {
    OSYSLOG1((osyslogERROR, "RCServer: the speaker does not take %s (status %u)", what, static_cast<unsigned>(status)));
  }
  return status == oSUCCESS;
}

bool Speaker::CreateVectors() {
  for (int i = 0; i < VectorPair::SIZE; ++i) {
    MemoryRegionID memory = MemoryRegionID();
    OSoundVectorData* vector = NULL;
    if (vectors_.HasVector(i)) {
      continue;
    }
    if (OPENR::NewSoundVectorData(1, VECTOR_SAMPLES * sizeof(short), &memory, &vector) != oSUCCESS) {
      OSYSLOG1((osyslogERROR, "RCServer: no memory for sound"));
      return false;
    }
    vector->SetNumData(1);
    vectors_.Own(i, memory, vector);
  }
  return true;
}

void Speaker::Send() {
  while (sound_.is_playing && sound_.vectors_until_end == 0) {
    RCRegion* const vector = vectors_.Next();
    if (vector == NULL) {
      break;
    }
    Fill(vector);
    vectors_.Send(vector);
    sound_.vectors_until_end = sound_.has_last && Waiting() == 0 ? vectors_.VectorsOnTheirWay() : 0;
  }
  vectors_.Notify();
}

// Silence after the last sample does not count as a gap.
void Speaker::Fill(RCRegion* vector) {
  OSoundVectorData* const data = VectorIn(vector);
  OSoundInfo* const info = data->GetInfo(0);
  // The guide names odataSOUND (page 63), but all of Sony's samples, which ran on robots, use this type.
  info->Set(odataSOUND_VECTOR, primitives_.Id(SPEAKER), VECTOR_SAMPLES * sizeof(short));
  info->format = osoundformatPCM;
  info->channel = osoundchannelMONO;
  info->samplingRate = static_cast<word>(SAMPLES_PER_SECOND);
  info->bitsPerSample = 16;
  short samples[VECTOR_SAMPLES] = {0};
  for (int i = 0; i < VECTOR_SAMPLES; ++i) {
    if (Waiting() == 0 && sound_.has_last) {
      break;
    }
    if (Waiting() == 0) {
      AddSilence();
      ++sound_.starved;
    }
    samples[i] = samples_[sound_.begin % SPEAKER_CAPACITY];
    ++sound_.begin;
  }
  memcpy(data->GetData(0), samples, sizeof(samples));
}
