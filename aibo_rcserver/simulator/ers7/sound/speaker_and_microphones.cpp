#include "simulator/ers7/sound/speaker_and_microphones.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace simulated_ers7 {
namespace {

sword sampleOf(double value) {
  return static_cast<sword>(std::clamp(std::lround(value), -32768L, 32767L));
}

bool isVolume(longword value) {
  return value == ospkvolinfdB || value == ospkvol25dB || value == ospkvol18dB || value == ospkvol10dB;
}

}  // namespace

SpeakerAndMicrophones::SpeakerAndMicrophones(const std::string& speaker_file, double hears_itself)
    : writer_(speaker_file.empty() ? nullptr : std::make_unique<WavWriter>(speaker_file)),
      hears_itself_(hears_itself) {}

OStatus SpeakerAndMicrophones::control(OPrimitiveRequest request, void* param, std::size_t param_size) {
  longword value = 0;
  if (param != nullptr && param_size == sizeof(value)) {
    std::memcpy(&value, param, sizeof(value));
  }
  if (request == oprmreqSPEAKER_MUTE_ON || request == oprmreqSPEAKER_MUTE_OFF) {
    settings_.is_mute = request == oprmreqSPEAKER_MUTE_ON;
  } else if (request == oprmreqSPEAKER_SET_VOLUME && param_size == sizeof(value) && isVolume(value)) {
    settings_.volume = value;
  } else if (request == oprmreqSPEAKER_SET_SOUND_TYPE && param_size == sizeof(value) &&
             (value == ospksndMONO8K8B || value == ospksndMONO16K16B)) {
    settings_.type = value;
  } else if (request == oprmreqSPEAKER_GET_SOUND_TYPE && param_size == sizeof(settings_.type)) {
    // The example in the guide passes the place as param (page 68).
    std::memcpy(param, &settings_.type, sizeof(settings_.type));
  } else {
    return oINVALID_ARG;
  }
  return oSUCCESS;
}

/// The factor of the volume, which is 1 for the loudest.
double SpeakerAndMicrophones::gain() const {
  if (settings_.is_mute || settings_.volume == ospkvolinfdB) {
    return 0;
  }
  const double decibels = settings_.volume == ospkvol10dB ? 0 : settings_.volume == ospkvol18dB ? -8 : -15;
  return std::pow(10, decibels / 20);
}

openr_host::MicrophoneFrame SpeakerAndMicrophones::passFrame(longword frame, const openr_host::SpeakerFrame* played) {
  openr_host::SpeakerFrame output{};
  if (played != nullptr) {
    std::transform(played->begin(), played->end(), output.begin(),
                   [gain = gain()](sword sample) { return sampleOf(gain * sample); });
    if (writer_) {
      writer_->write(output);
    }
  }
  if (!heard_.empty() && !heard_since_) {
    heard_since_ = frame;
  }
  openr_host::MicrophoneFrame heard{};
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const std::size_t position = (frame - heard_since_.value_or(frame)) * heard.size() + i;
    const OSoundSampleStereo16 sample = position < heard_.size() ? heard_[position] : OSoundSampleStereo16{0, 0};
    const double itself = hears_itself_ * output[i];
    heard[i] = {sampleOf(sample.L + itself), sampleOf(sample.R + itself)};
  }
  return heard;
}

void SpeakerAndMicrophones::hear(std::vector<OSoundSampleStereo16> samples) {
  heard_ = std::move(samples);
  heard_since_.reset();
}

}  // namespace simulated_ers7
