/// @file Version1.h
/// What the server does for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_H

#include "protocol/request_reader.h"
#include "rcserver/Outbox.h"
#include "rcserver/Robot.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/motions/MotionCommands.h"
#include "rcserver/settings/Settings.h"
#include "rcserver/version1/Version1Joints.h"
#include "rcserver/version1/Version1Lights.h"
#include "rcserver/version1/Version1Motions.h"
#include "rcserver/version1/Version1Power.h"
#include "rcserver/version1/Version1Replies.h"
#include "rcserver/version1/Version1Sensors.h"

/// Carries out the requests of version 1 and answers them (docs/protocol.md): those for the camera itself, the others
/// by the class of their concern. Pure logic: no OPEN-R.
class Version1 {
 public:
  /// @param upload_buffer mtn::MAX_FILE_SIZE bytes, while version 1 is spoken. All must outlive this.
  Version1(const Robot& robot, const Settings& settings, MotionCommands& motions, ImageObserver& camera, Outbox& outbox,
           unsigned char* upload_buffer);

  /// A new client.
  void Begin();

  /// Adds at most one message to the outbox. A request that needs the memory stick is answered by FileDone().
  /// @return false if nothing was done because the request has to wait for the memory stick
  bool Handle(const protocol::Request& request);

  /// Takes what has come of a file that a request has announced. To be called before each request is taken; adds at
  /// most one message to the outbox, in the place of the one that the request had.
  /// @return false if more of it is still to come
  bool TakeContent(protocol::RequestReader& reader) { return motions_.TakeContent(reader); }

  /// Answers the request that has been waiting for the memory stick.
  /// @param result that MotionCommands awaits
  void FileDone(const FileResult& result) { motions_.FileDone(result); }

 private:
  Version1(const Version1&);
  Version1& operator=(const Version1&);

  static bool IsForMotions(const protocol::Request& request);
  bool Execute(const protocol::Request& request);

  ImageObserver& camera_;
  Version1Replies replies_;
  Version1Joints joints_;
  Version1Lights lights_;
  Version1Motions motions_;
  Version1Power power_;
  Version1Sensors sensors_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_H
