#include "rcserver/body/Microphone.h"

#include <string.h>

using namespace protocol::version2;

namespace {

const int CHANNELS = 2;
const unsigned FULL_RATE = 16000;

// A half-band low-pass filter against aliasing at 8 kHz. It attenuates by 20 dB from 4.6 kHz and by 43 dB from 5 kHz,
// and passes frequencies below 3 kHz. The coefficients belong to the samples 1, 3, 5... before and after the middle
// one, whose own coefficient is a half. All others are 0. The window is Kaiser's with beta = 5. The sum is 32768.
const int FACTORS[] = {10281, -3018, 1393, -652, 267, -79};
const int MIDDLE_FACTOR = 16384;
const int FACTOR_SHIFT = 15;
const int NUMBER_OF_FACTORS = static_cast<int>(sizeof(FACTORS) / sizeof(FACTORS[0]));

int Clamp(int sample) {
  return sample < -32768 ? -32768 : sample > 32767 ? 32767 : sample;
}

}  // namespace

const size_t Microphone::MAX_SAMPLES;
const int Microphone::RING_SIZE;

Microphone::Microphone() : gate_(NULL), settings_(), next_(0), left_out_(false) {}

void Microphone::Start(OObserver* gate) {
  gate_ = gate;
  gate_->DeassertReady();
}

void Microphone::Set(const MicrophoneSettings& settings) {
  const bool on = (settings.mode & MICROPHONE_ON) != 0;
  if (on != IsOn()) {
    if (on) {
      gate_->AssertReady();
    } else {
      gate_->DeassertReady();
    }
  }
  settings_ = settings;
  memset(last_, 0, sizeof(last_));
  left_out_ = false;
}

void Microphone::ClientGone() {
  Set(MicrophoneSettings());
}

void Microphone::AskForMore() {
  if (IsOn()) {
    gate_->AssertReady();
  }
}

HeardSound Microphone::Convert(OSoundVectorData* vector, unsigned char* out) {
  const OSoundInfo& info = *vector->GetInfo(0);
  const bool halves = settings_.samples_per_second != FULL_RATE;
  const size_t most = info.dataSize / sizeof(OSoundSampleStereo16);
  const size_t size = most < MAX_SAMPLES ? most : MAX_SAMPLES;
  HeardSound heard = {static_cast<unsigned>(info.frameNumber), 0, settings_.channels, out, 0};
  for (size_t i = 0; i < size; ++i) {
    OSoundSampleStereo16 both;
    memcpy(&both, vector->GetData(0) + i * sizeof(both), sizeof(both));
    int samples[CHANNELS] = {both.L, both.R};
    if (settings_.channels == 1) {
      samples[0] = (both.L + both.R) / 2;
    }
    next_ = (next_ + 1) % RING_SIZE;
    for (int channel = 0; halves && channel < settings_.channels; ++channel) {
      last_[channel][next_] = samples[channel];
    }
    left_out_ = halves && !left_out_;
    if (left_out_) {
      continue;
    }
    for (int channel = 0; channel < settings_.channels; ++channel) {
      const int sample = halves ? Filtered(channel) : samples[channel];
      protocol::encodeBigEndian16(static_cast<unsigned>(sample), out + heard.samples_size);
      heard.samples_size += BYTES_PER_SAMPLE;
    }
    ++heard.count;
  }
  return heard;
}

// The filtered value of the sample in the middle of the last 23.
int Microphone::Filtered(int channel) const {
  const int* const last = last_[channel];
  const int middle = next_ + RING_SIZE - (2 * NUMBER_OF_FACTORS - 1);
  int sum = MIDDLE_FACTOR * last[middle % RING_SIZE];
  for (int i = 0; i < NUMBER_OF_FACTORS; ++i) {
    const int distance = 2 * i + 1;
    sum += FACTORS[i] * (last[(middle - distance) % RING_SIZE] + last[(middle + distance) % RING_SIZE]);
  }
  return Clamp((sum + (1 << (FACTOR_SHIFT - 1))) >> FACTOR_SHIFT);
}
