/// @file Version2.h
/// What the server does for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_H

#include "protocol/hello.h"
#include "rcserver/Outbox.h"
#include "rcserver/Robot.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/motions/MotionCommands.h"
#include "rcserver/settings/Settings.h"
#include "rcserver/version2/Version2Camera.h"
#include "rcserver/version2/Version2Joints.h"
#include "rcserver/version2/Version2Lights.h"
#include "rcserver/version2/Version2Motions.h"
#include "rcserver/version2/Version2Power.h"
#include "rcserver/version2/Version2Replies.h"
#include "rcserver/version2/Version2Telemetry.h"

/// Carries out the requests of version 2, answers them and pushes telemetry (docs/protocol.md): hello itself, the
/// others by the class of their concern. Pure logic: no OPEN-R.
class Version2 {
 public:
  /// All must outlive this.
  Version2(const Robot& robot, const Settings& settings, MotionCommands& motions, ImageObserver& camera,
           Outbox& outbox);

  /// A new client.
  void Begin();

  /// Adds one message to the outbox, unless the request is for a picture, which is the answer, or needs the memory
  /// stick: then FileDone() adds it.
  /// @param now OPEN-R frame
  /// @return false if nothing was done because the request has to wait for the memory stick
  bool Handle(const protocol::version2::FrameHeader& request, const unsigned char* payload, unsigned now);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result that MotionCommands awaits
  void FileDone(const FileResult& result) { motions_.FileDone(result); }

  /// Answers a request by an error.
  /// @param text a reason in words
  void Refuse(const protocol::version2::FrameHeader& request, unsigned short code, const char* text);

  /// Pushes an error that nobody has asked for, if there is room.
  void PushError(unsigned short code, const char* text) {
    if (replies_.HasRoom()) {
      replies_.PushError(code, text);
    }
  }

  /// All joints have been measured.
  /// @param frame in which
  void Measured(unsigned frame);

 private:
  Version2(const Version2&);
  Version2& operator=(const Version2&);

  typedef Version2Replies::Request Request;
  void Greet(const Request& request, unsigned now);
  void RefuseUnknownKind(const Request& request);

  const Robot& robot_;
  char capabilities_[protocol::version2::MAX_HELLO_TEXT_SIZE + 1];
  Version2Replies replies_;
  Version2Camera camera_;
  Version2Joints joints_;
  Version2Lights lights_;
  Version2Motions motions_;
  Version2Power power_;
  Version2Telemetry telemetry_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_H
