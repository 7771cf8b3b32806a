#include "rcserver/version1/Version1Lights.h"

using robot_model::NO_LED;

bool Version1Lights::Execute(const protocol::Request& request) {
  const int identifier = request.basic.identifier;
  const short value = protocol::decodeValue(request.payload);
  switch (request.basic.command) {
    case protocol::REQUEST_LED:
      return SetLed(identifier, protocol::ledIntensity(value));
    case protocol::REQUEST_FACE_LEDS:
      return SetFace(identifier, protocol::ledIntensity(value));
    case protocol::REQUEST_EARS:
      return (value == 0 || value == 1) && SetEars(identifier, value == 1);
    default:
      return false;
  }
}

// The mode stays as it is.
bool Version1Lights::SetLed(int identifier, unsigned char intensity) {
  if (identifier == protocol::ALL_IDENTIFIERS) {
    return SetAllLeds(intensity);
  }
  const int led = lights_.FindLed(identifier);
  if (led == NO_LED) {
    return false;
  }
  const Lights::LedState wanted = {intensity, lights_.Led(led).is_mode_b};
  replies_.Value('l', identifier, lights_.SetLed(led, wanted).intensity);
  return true;
}

bool Version1Lights::SetAllLeds(unsigned char intensity) {
  if (lights_.Robot().number_of_leds == 0) {
    return false;
  }
  for (int i = 0; i < lights_.Robot().number_of_leds; ++i) {
    const Lights::LedState wanted = {intensity, lights_.Led(i).is_mode_b};
    lights_.SetLed(i, wanted);
  }
  replies_.Value('l', protocol::ALL_IDENTIFIERS, intensity);
  return true;
}

bool Version1Lights::SetFace(int identifier, unsigned char intensity) {
  if (lights_.Robot().number_of_leds == 0) {
    return false;
  }
  const Lights::LedState wanted = {intensity, identifier != protocol::FACE_MODE_A};
  for (int i = 0; i < lights_.Robot().number_of_leds; ++i) {
    lights_.SetLed(i, wanted);
  }
  replies_.Value('y', identifier, intensity);
  return true;
}

// Tells for both ears whether both are drawn.
bool Version1Lights::SetEars(int identifier, bool draw) {
  bool is_any = false;
  bool are_drawn = true;
  for (int i = 0; i < lights_.Robot().number_of_ears; ++i) {
    if (identifier == protocol::ALL_IDENTIFIERS || lights_.Robot().ears[i].identifier == identifier) {
      is_any = true;
      are_drawn = lights_.SetEar(i, draw) && are_drawn;
    }
  }
  if (is_any) {
    replies_.Value('k', identifier, are_drawn ? 1 : 0);
  }
  return is_any;
}
