/// @file Version2Motions.h
/// Motions, for a client of version 2.
#ifndef RCSERVER_VERSION2_VERSION2_MOTIONS_H
#define RCSERVER_VERSION2_VERSION2_MOTIONS_H

#include "rcserver/commands/MotionCommands.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `U`, `D`, `P` and `N`, and tells of motions that have failed. Pure logic: no OPEN-R. Each function
/// answers its request; `payload` is as many bytes as the request's header says.
class Version2Motions {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Motions(MotionCommands& motions, JointControl& joints, Version2Replies& replies)
      : motions_(motions), joints_(joints), replies_(replies) {}

  void Upload(const Request& request, const unsigned char* payload);
  void Delete(const Request& request, const unsigned char* payload);
  void Play(const Request& request, const unsigned char* payload);
  void List(const Request& request);

  /// Pushes an error for each motion that was stopped because one of its joints does not follow.
  void PushFailures();

 private:
  void Answer(const Request& request, MotionCommands::Outcome outcome);

  MotionCommands& motions_;
  JointControl& joints_;
  Version2Replies& replies_;
};

#endif  // RCSERVER_VERSION2_VERSION2_MOTIONS_H
