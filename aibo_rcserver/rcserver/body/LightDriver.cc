#include "rcserver/body/LightDriver.h"

#include <string.h>

#include "rcserver/body/CommandVectors.h"

using robot_model::Ear;
using robot_model::EAR_JOINT4;
using robot_model::LED2;
using robot_model::MAX_EARS;
using robot_model::RobotModel;

namespace {

// LEDs need one command, which lasts as long as the commands of joints that go with it.
OCommandValue CommandOf(const Lights::LedState& state, robot_model::LedKind kind) {
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

// Ears are commanded frame by frame. JOINT_COMMAND3 has the state at the same place, and no period.
OCommandValue CommandOf(bool is_drawn, robot_model::EarKind kind) {
  OCommandValue command;
  const word period = kind == EAR_JOINT4 ? 1 : 0;
  OJointCommandValue4 value = {is_drawn ? ojoint4_STATE1 : ojoint4_STATE0, period, 0};
  memcpy(&command, &value, sizeof(command));
  return command;
}

}  // namespace

LightDriver::LightDriver() : lights_(NULL) {
  memset(commanded_, 0, sizeof(commanded_));
}

LightDriver::~LightDriver() {
  delete lights_;
}

void LightDriver::Open(const RobotModel& robot) {
  lights_ = new Lights(robot);
  for (int i = 0; i < robot.number_of_leds; ++i) {
    leds_.Open(i, robot.leds[i].name, robot.leds[i].locator);
    commanded_[i] = lights_->Led(i);
  }
  for (int i = 0; i < robot.number_of_ears; ++i) {
    ears_.Open(i, robot.ears[i].name, robot.ears[i].locator);
  }
}

void LightDriver::Close() {
  leds_.Close();
  ears_.Close();
  delete lights_;
  lights_ = NULL;
}

bool LightDriver::HasCommand() const {
  for (int i = 0; i < lights_->Robot().number_of_leds; ++i) {
    if (IsToChange(i)) {
      return true;
    }
  }
  for (int i = 0; i < lights_->Robot().number_of_ears; ++i) {
    if (ears_.IsOpen(i) && lights_->IsBusy(i)) {
      return true;
    }
  }
  return false;
}

void LightDriver::Fill(RCRegion* vector) {
  for (int i = 0; i < lights_->Robot().number_of_leds; ++i) {
    if (IsToChange(i)) {
      CommandLed(vector, i);
    }
  }
  CommandEars(vector);
}

bool LightDriver::IsToChange(int led) const {
  return leds_.IsOpen(led) && !(lights_->Led(led) == commanded_[led]);
}

void LightDriver::CommandLed(RCRegion* vector, int led) {
  const robot_model::LedKind kind = lights_->Robot().leds[led].kind;
  commanded_[led] = lights_->Led(led);
  const ODataType type = kind == LED2 ? odataLED_COMMAND2 : odataLED_COMMAND3;
  OCommandData* data = CommandVectors::Add(vector, type, leds_.Id(led), 1);
  data->value[0] = CommandOf(commanded_[led], kind);
}

// Also while they rest, so that an ear is let go even if a command is lost.
void LightDriver::CommandEars(RCRegion* vector) {
  const RobotModel& robot = lights_->Robot();
  OCommandData* data[MAX_EARS] = {};
  for (int i = 0; i < robot.number_of_ears; ++i) {
    if (ears_.IsOpen(i) && lights_->IsBusy(i)) {
      const ODataType type = robot.ears[i].kind == EAR_JOINT4 ? odataJOINT_COMMAND4 : odataJOINT_COMMAND3;
      data[i] = CommandVectors::Add(vector, type, ears_.Id(i), CommandVectors::FRAMES);
    }
  }
  for (int frame = 0; frame < CommandVectors::FRAMES; ++frame) {
    for (int i = 0; i < robot.number_of_ears; ++i) {
      if (data[i] != NULL) {
        data[i]->value[frame] = CommandOf(lights_->IsDrawn(i), robot.ears[i].kind);
      }
    }
    lights_->NextFrame();
  }
}
