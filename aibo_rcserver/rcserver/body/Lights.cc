#include "rcserver/body/Lights.h"

using robot_model::LED2;
using robot_model::MAX_EARS;
using robot_model::MAX_LEDS;

namespace {

const Lights::LedState OFF = {0, false};
const unsigned char FULL = 255;

}  // namespace

const int Lights::EAR_FRAMES;

Lights::Lights(const robot_model::RobotModel& robot) : robot_(robot) {
  for (int i = 0; i < MAX_LEDS; ++i) {
    leds_[i] = OFF;
  }
  for (int i = 0; i < MAX_EARS; ++i) {
    frames_drawn_[i] = 0;
    frames_to_rest_[i] = 0;
  }
}

Lights::LedState Lights::SetLed(int led, const LedState& wanted) {
  leds_[led] = wanted;
  if (robot_.leds[led].kind == LED2) {
    leds_[led].intensity = wanted.intensity > 0 ? FULL : OFF.intensity;
    leds_[led].is_mode_b = false;
  }
  return leds_[led];
}

bool Lights::SetEar(int ear, bool draw) {
  if (draw && !IsBusy(ear)) {
    frames_drawn_[ear] = EAR_FRAMES;
  } else if (!draw && IsDrawn(ear)) {
    frames_drawn_[ear] = 0;
    frames_to_rest_[ear] = EAR_FRAMES;
  }
  return IsDrawn(ear);
}

void Lights::NextFrame() {
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    if (frames_to_rest_[i] > 0) {
      --frames_to_rest_[i];
    } else if (frames_drawn_[i] > 0 && --frames_drawn_[i] == 0) {
      frames_to_rest_[i] = EAR_FRAMES;
    }
  }
}

void Lights::ClientGone() {
  for (int i = 0; i < robot_.number_of_leds; ++i) {
    leds_[i] = OFF;
  }
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    SetEar(i, false);
  }
}
