/// @file Version2Motions.h
/// Motions, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_MOTIONS_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_MOTIONS_H

#include "rcserver/joints/JointControl.h"
#include "rcserver/motions/MotionCommands.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `U`, `D`, `P` and `N`, and reports motions that have failed. Pure logic: no OPEN-R.
///
/// The first four functions answer their request now, or in FileDone() if it needs the memory stick. They return false
/// and do nothing if it has to wait because the memory stick is busy: then they are to be called again. `payload` is as
/// many bytes as the request's header says.
class Version2Motions {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Motions(MotionCommands& motions, JointControl& joints, Version2Replies& replies)
      : motions_(motions), joints_(joints), replies_(replies), pending_() {}

  bool Upload(const Request& request, const unsigned char* payload);
  bool Delete(const Request& request, const unsigned char* payload);
  bool Play(const Request& request, const unsigned char* payload);
  bool List(const Request& request);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result that MotionCommands awaits
  void FileDone(const FileResult& result);

  /// Pushes an error for each motion that was stopped because one of its joints does not follow.
  void PushFailures();

 private:
  void Answer(const Request& request, MotionCommands::Outcome outcome);

  MotionCommands& motions_;
  JointControl& joints_;
  Version2Replies& replies_;
  Request pending_;  ///< that waits for the memory stick
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_MOTIONS_H
