#include "simulator/openr_host/objects/virtual_robot_audio_comm.h"

#include <OPENR/OSyslog.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "simulator/openr_host/objects/system.h"

namespace openr_host {
namespace {

constexpr word kRate = 16000;

void require(bool condition, const std::string& otherwise) {
  if (!condition) {
    throw std::invalid_argument(otherwise);
  }
}

/// Makes a vector of what the microphones have heard from this frame on. The vector belongs to nobody yet.
RegionReference makeVector(longword frame, const std::vector<OSoundSampleStereo16>& samples) {
  const std::size_t size = samples.size() * sizeof(samples[0]);
  auto* const region = new RCRegion(sizeof(OSoundVectorData) + size);
  RegionReference made = reference(region);
  region->RemoveReference();
  void* const base = region->Base();
  auto* const vector = new (base) OSoundVectorData{};
  vector->vectorInfo.type = odataSOUND_VECTOR;
  vector->vectorInfo.infoOffset = static_cast<longword>(offsetof(OSoundVectorData, info));
  vector->vectorInfo.infoSize = sizeof(OSoundInfo);
  vector->vectorInfo.totalSize = static_cast<longword>(region->Size());
  vector->vectorInfo.maxNumData = vector->vectorInfo.numData = 1;
  OSoundInfo& info = *vector->GetInfo(0);
  info.Set(odataSOUND, oprimitiveID_UNDEF, size);
  info.frameNumber = frame;
  info.frameSize = kSamplesPerFrame * sizeof(samples[0]);
  info.dataOffset = sizeof(OSoundVectorData);
  info.maxDataSize = info.actualDataSize = info.dataSize;
  info.format = osoundformatPCM;
  info.channel = osoundchannelSTEREO;
  info.samplingRate = kRate;
  info.bitsPerSample = 16;
  std::memcpy(vector->GetData(0), samples.data(), size);
  return made;
}

}  // namespace

ObjectDescription VirtualRobotAudioComm::describe(VirtualRobot& robot) {
  ObjectDescription description;
  description.name = "OVirtualRobotAudioComm";
  description.subjects.push_back({"OVirtualRobotAudioComm.Mic.OSoundVectorData.S", nullptr, nullptr});
  description.observers.push_back({"OVirtualRobotAudioComm.Speaker.OSoundVectorData.O",
                                   [](OObject& object, const OConnectEvent& event) {
                                     static_cast<VirtualRobotAudioComm&>(object).speaker_->AssertReady(
                                         event.SenderID());
                                   },
                                   [](OObject& object, const ONotifyEvent& event) {
                                     static_cast<VirtualRobotAudioComm&>(object).takeSound(event);
                                   }});
  description.create = [&robot] { return std::make_unique<VirtualRobotAudioComm>(robot); };
  return description;
}

OStatus VirtualRobotAudioComm::DoInit(const OSystemEvent& /*event*/) {
  System& system = System::current();
  microphone_ = std::make_unique<SubjectService>(system, SubjectID{myOID_, 0});
  system.add(*microphone_);
  speaker_ = std::make_unique<OObserver>();
  speaker_->Register(myOID_, 0);
  return oSUCCESS;
}

OStatus VirtualRobotAudioComm::DoStop(const OSystemEvent& /*event*/) {
  speaker_->DeassertReady();
  sounds_.clear();
  return oSUCCESS;
}

OStatus VirtualRobotAudioComm::DoDestroy(const OSystemEvent& /*event*/) {
  microphone_.reset();
  speaker_.reset();
  return oSUCCESS;
}

void VirtualRobotAudioComm::beginFrame(longword frame) {
  const longword passed = last_frame_ ? std::min(frame - *last_frame_, kMostFramesCaughtUp) : 1;
  last_frame_ = frame;
  is_listened_to_ = isListenedTo();
  for (const SubjectID& sender : std::exchange(refused_, {})) {
    speaker_->AssertReady(sender);
  }
  for (longword left = passed; left > 0 && isActive(); --left) {
    const std::optional<SpeakerFrame> played = play();
    hear(frame - (left - 1), robot_.passSound(frame - (left - 1), played ? &*played : nullptr));
  }
  microphone_->notifyAll();
  if (!isListenedTo()) {
    heard_.clear();
  }
}

bool VirtualRobotAudioComm::isActive() const {
  return !sounds_.empty() || !refused_.empty() || isListenedTo();
}

bool VirtualRobotAudioComm::isListenedTo() const {
  return microphone_->isWanted() && (is_listened_to_ || microphone_->isAnyReady());
}

void VirtualRobotAudioComm::takeSound(const ONotifyEvent& event) {
  for (int i = 0; i < event.NumOfData(); ++i) {
    try {
      sounds_.push_back({event.SenderID(), reference(event.RCData(i)), readSamples(*event.RCData(i))});
    } catch (const std::invalid_argument& error) {
      refused_.push_back(event.SenderID());
      OSYSLOG1((osyslogERROR, "sound vector refused: %s", error.what()));
    }
  }
}

/// @throw std::invalid_argument the speaker does not play such a vector
std::vector<sword> VirtualRobotAudioComm::readSamples(const RCRegion& region) const {
  require(region.Size() >= sizeof(OSoundVectorData), "its region has no room for a sound");
  OSoundVectorData vector{};
  std::memcpy(&vector, region.Base(), sizeof(vector));
  const OSoundInfo& info = vector.info[0];
  require(vector.vectorInfo.type == odataSOUND_VECTOR, "its type is not odataSOUND_VECTOR");
  require(vector.vectorInfo.numData == 1, "it has not one sound, but " + std::to_string(vector.vectorInfo.numData));
  const std::optional<OSpeakerSoundType> type = robot_.soundTypeOf(info.primitiveID);
  require(type.has_value(), "primitive " + std::to_string(info.primitiveID) + " is not an open speaker");
  const bool is_wide = *type == ospksndMONO16K16B;
  require(info.format == osoundformatPCM && info.channel == osoundchannelMONO &&
              info.samplingRate == (is_wide ? 16000 : 8000) && info.bitsPerSample == (is_wide ? 16 : 8),
          "it is not PCM, mono, of the rate and bits for which the speaker is set");
  require(info.dataSize > 0 && info.dataOffset >= sizeof(OSoundVectorData) && info.dataOffset <= region.Size() &&
              info.dataSize <= region.Size() - info.dataOffset,
          "its data is empty, or outside of its region");
  const auto* const data = region.Base() + info.dataOffset;
  std::vector<sword> samples(info.dataSize / sizeof(sword));
  if (is_wide) {
    std::memcpy(samples.data(), data, samples.size() * sizeof(sword));
    return samples;
  }
  samples.resize(2 * info.dataSize);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = static_cast<sword>(256 * static_cast<signed char>(data[i / 2]));
  }
  return samples;
}

/// The sound of the next 8 ms; empty if nothing is to be played.
std::optional<SpeakerFrame> VirtualRobotAudioComm::play() {
  if (sounds_.empty()) {
    return std::nullopt;
  }
  SpeakerFrame frame{};
  for (std::size_t filled = 0; filled < frame.size() && !sounds_.empty();) {
    Sound& sound = sounds_.front();
    const std::size_t count = std::min(frame.size() - filled, sound.samples.size() - sound.next);
    std::copy_n(&sound.samples[sound.next], count, &frame[filled]);
    filled += count;
    sound.next += count;
    if (sound.next == sound.samples.size()) {
      speaker_->AssertReady(sound.sender);
      sounds_.pop_front();
    }
  }
  return frame;
}

void VirtualRobotAudioComm::hear(longword frame, const MicrophoneFrame& heard) {
  const longword begin = frame - frame % kFramesPerMicrophoneVector;
  if (frame == begin) {
    heard_.clear();
  } else if (heard_.empty()) {
    return;  // nobody listened when the vector began
  }
  heard_.insert(heard_.end(), heard.begin(), heard.end());
  if (frame == begin + kFramesPerMicrophoneVector - 1) {
    microphone_->setData(makeVector(begin, heard_).get());
  }
}

}  // namespace openr_host
