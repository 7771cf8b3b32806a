/// @file Version1Commands.h
/// What the server does for a client of version 1.
#ifndef RCSERVER_VERSION1_COMMANDS_H
#define RCSERVER_VERSION1_COMMANDS_H

#include "protocol/request_reader.h"
#include "rcserver/ImageObserver.h"
#include "rcserver/Outbox.h"
#include "rcserver/Robot.h"
#include "rcserver/Settings.h"
#include "rcserver/Version1Joints.h"
#include "rcserver/Version1Replies.h"
#include "rcserver/Version1Sensors.h"

/// Carries out the requests of version 1 and answers them (docs/protocol.md): those for the camera itself, the others
/// by the class of their concern. Pure logic: no OPEN-R.
class Version1Commands {
 public:
  /// All must outlive this.
  Version1Commands(const Robot& robot, const Settings& settings, ImageObserver& camera, Outbox& outbox);

  /// A new client.
  void Begin();

  /// Adds at most one message to the outbox.
  void Handle(const protocol::Request& request);

 private:
  Version1Commands(const Version1Commands&);
  Version1Commands& operator=(const Version1Commands&);

  bool Execute(const protocol::Request& request);

  ImageObserver& camera_;
  Version1Replies replies_;
  Version1Joints joints_;
  Version1Sensors sensors_;
};

#endif  // RCSERVER_VERSION1_COMMANDS_H
