/// @file Version2Lights.h
/// LEDs and ears, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_LIGHTS_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_LIGHTS_H

#include "rcserver/body/Lights.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `L` and `K`. Pure logic: no OPEN-R. Each function answers its request; `payload` is as many bytes as the
/// request's header says.
class Version2Lights {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Lights(Lights& lights, Version2Replies& replies) : lights_(lights), replies_(replies) {}

  void SetLeds(const Request& request, const unsigned char* payload);
  void SetEars(const Request& request, const unsigned char* payload);

 private:
  bool SetEar(int identifier, bool draw);

  Lights& lights_;
  Version2Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_LIGHTS_H
