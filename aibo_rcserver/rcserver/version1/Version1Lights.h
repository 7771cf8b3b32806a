/// @file Version1Lights.h
/// LEDs and ears, for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_LIGHTS_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_LIGHTS_H

#include "protocol/request_reader.h"
#include "rcserver/body/Lights.h"
#include "rcserver/version1/Version1Replies.h"

/// Carries out `L`, `Y` and `K`. Pure logic: no OPEN-R.
class Version1Lights {
 public:
  /// All must outlive this.
  Version1Lights(Lights& lights, Version1Replies& replies) : lights_(lights), replies_(replies) {}

  /// @param request with a value
  /// @return false: to be refused
  bool Execute(const protocol::Request& request);

 private:
  bool SetLed(int identifier, unsigned char intensity);
  bool SetAllLeds(unsigned char intensity);
  bool SetFace(int identifier, unsigned char intensity);
  bool SetEars(int identifier, bool draw);

  Lights& lights_;
  Version1Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_LIGHTS_H
