#include "rcserver/body/LightDriver.h"

#include <string.h>

using namespace robot_model;

namespace {

const LightDriver::LedState OFF = {0, false};
const unsigned char FULL = 255;

// An LED needs one command, which lasts as long as the joint commands in the same vector.
OCommandValue CommandOf(const LightDriver::LedState& state, LedKind kind) {
  OCommandValue command;
  if (kind == LED2) {
    OLEDCommandValue2 value = {state.intensity > 0 ? oledON : oledOFF, CommandVectors::FRAMES, 0};
    memcpy(&command, &value, sizeof(command));
  } else {
    OLEDCommandValue3 value = {state.intensity, state.is_mode_b ? oled3_MODE_B : oled3_MODE_A, CommandVectors::FRAMES,
                               0};
    memcpy(&command, &value, sizeof(command));
  }
  return command;
}

// Ears are commanded frame by frame. JOINT_COMMAND3 has the state at the same offset, but has no period.
OCommandValue CommandOf(bool is_drawn, EarKind kind) {
  OCommandValue command;
  const word period = kind == EAR_JOINT4 ? 1 : 0;
  OJointCommandValue4 value = {is_drawn ? ojoint4_STATE1 : ojoint4_STATE0, period, 0};
  memcpy(&command, &value, sizeof(command));
  return command;
}

}  // namespace

const int LightDriver::EAR_FRAMES;

LightDriver::LightDriver(const RobotModel& robot) : robot_(robot) {
  for (int i = 0; i < MAX_LEDS; ++i) {
    leds_[i] = OFF;
    commanded_[i] = OFF;
  }
  for (int i = 0; i < MAX_EARS; ++i) {
    frames_busy_[i] = 0;
  }
}

void LightDriver::Open() {
  for (int i = 0; i < robot_.number_of_leds; ++i) {
    led_primitives_.Open(i, robot_.leds[i].name, robot_.leds[i].locator);
  }
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    ear_primitives_.Open(i, robot_.ears[i].name, robot_.ears[i].locator);
  }
}

LightDriver::LedState LightDriver::SetLed(int led, const LedState& wanted) {
  leds_[led] = wanted;
  if (robot_.leds[led].kind == LED2) {
    leds_[led].intensity = wanted.intensity > 0 ? FULL : OFF.intensity;
    leds_[led].is_mode_b = false;
  }
  return leds_[led];
}

bool LightDriver::SetEar(int ear, bool draw) {
  if (draw && !IsBusy(ear)) {
    frames_busy_[ear] = 2 * EAR_FRAMES;
  } else if (!draw && IsDrawn(ear)) {
    frames_busy_[ear] = EAR_FRAMES;
  }
  return IsDrawn(ear);
}

void LightDriver::ClientGone() {
  for (int i = 0; i < robot_.number_of_leds; ++i) {
    leds_[i] = OFF;
  }
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    SetEar(i, false);
  }
}

bool LightDriver::HasCommand() const {
  for (int i = 0; i < robot_.number_of_leds; ++i) {
    if (HasChanged(i)) {
      return true;
    }
  }
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    if (ear_primitives_.IsOpen(i) && IsBusy(i)) {
      return true;
    }
  }
  return false;
}

void LightDriver::Fill(RCRegion* vector) {
  for (int i = 0; i < robot_.number_of_leds; ++i) {
    if (HasChanged(i)) {
      CommandLed(vector, i);
    }
  }
  CommandEars(vector);
}

void LightDriver::NextFrame() {
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    if (frames_busy_[i] > 0) {
      --frames_busy_[i];
    }
  }
}

bool LightDriver::HasChanged(int led) const {
  return led_primitives_.IsOpen(led) && !(leds_[led] == commanded_[led]);
}

void LightDriver::CommandLed(RCRegion* vector, int led) {
  const LedKind kind = robot_.leds[led].kind;
  commanded_[led] = leds_[led];
  const ODataType type = kind == LED2 ? odataLED_COMMAND2 : odataLED_COMMAND3;
  OCommandData* data = CommandVectors::Add(vector, type, led_primitives_.Id(led), 1);
  data->value[0] = CommandOf(commanded_[led], kind);
}

// Commands all ears, even those at rest, so that an ear is released even if a command is lost.
void LightDriver::CommandEars(RCRegion* vector) {
  OCommandData* data[MAX_EARS] = {};
  for (int i = 0; i < robot_.number_of_ears; ++i) {
    if (ear_primitives_.IsOpen(i) && IsBusy(i)) {
      const ODataType type = robot_.ears[i].kind == EAR_JOINT4 ? odataJOINT_COMMAND4 : odataJOINT_COMMAND3;
      data[i] = CommandVectors::Add(vector, type, ear_primitives_.Id(i), CommandVectors::FRAMES);
    }
  }
  for (int frame = 0; frame < CommandVectors::FRAMES; ++frame) {
    for (int i = 0; i < robot_.number_of_ears; ++i) {
      if (data[i] != NULL) {
        data[i]->value[frame] = CommandOf(IsDrawn(i), robot_.ears[i].kind);
      }
    }
    NextFrame();
  }
}
