#include "rcserver/version2/Version2Lights.h"

#include <stdio.h>

using namespace protocol::version2;
using robot_model::NO_EAR;
using robot_model::NO_LED;

namespace {

// Identifiers of the two ears.
const int LEFT = 1;
const int RIGHT = 2;

}  // namespace

void Version2Lights::SetLeds(const Request& request, const unsigned char* payload) {
  LedValues values;
  if (const char* problem = decodeLedValues(payload, request.payload_size, &values)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  for (int i = 0; i < values.count; ++i) {
    if (lights_.FindLed(values.leds[i].id) == NO_LED) {
      char text[MAX_ERROR_TEXT_SIZE];
      sprintf(text, "there is no LED %d on this robot, so nothing of the request was done", values.leds[i].id);
      replies_.Refuse(request, CODE_REFUSED, text);
      return;
    }
  }
  for (int i = 0; i < values.count; ++i) {
    LedValue& value = values.leds[i];
    const Lights::LedState wanted = {value.intensity, value.mode == LED_MODE_B};
    const Lights::LedState accepted = lights_.SetLed(lights_.FindLed(value.id), wanted);
    value.intensity = accepted.intensity;
    value.mode = accepted.is_mode_b ? LED_MODE_B : LED_MODE_A;
  }
  replies_.Reply(request, encodeLedValues(values, replies_.Payload()));
}

void Version2Lights::SetEars(const Request& request, const unsigned char* payload) {
  EarPositions ears;
  if (const char* problem = decodeEarPositions(payload, request.payload_size, &ears)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  ears.left = SetEar(LEFT, ears.left);
  ears.right = SetEar(RIGHT, ears.right);
  replies_.Reply(request, encodeEarPositions(ears, replies_.Payload()));
}

bool Version2Lights::SetEar(int identifier, bool draw) {
  const int ear = lights_.FindEar(identifier);
  return ear != NO_EAR && lights_.SetEar(ear, draw);
}
