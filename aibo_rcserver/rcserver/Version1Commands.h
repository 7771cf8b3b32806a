/// @file Version1Commands.h
/// What the server does for a client of version 1.
#ifndef RCSERVER_VERSION1_COMMANDS_H
#define RCSERVER_VERSION1_COMMANDS_H

#include "protocol/request_reader.h"
#include "protocol/version1.h"
#include "rcserver/ImageObserver.h"
#include "rcserver/JointControl.h"
#include "rcserver/Motors.h"
#include "rcserver/Outbox.h"

/// Carries out the requests of version 1 and answers them (docs/protocol.md). Pure logic: no OPEN-R.
class Version1Commands {
 public:
  /// All must outlive this.
  Version1Commands(JointControl& joints, const Motors& motors, ImageObserver& camera, Outbox& outbox);

  /// A new client: the sensor block holds everything.
  void Begin();

  /// Adds at most one message to the outbox.
  void Handle(const protocol::Request& request);

  void Refuse();

 private:
  Version1Commands(const Version1Commands&);
  Version1Commands& operator=(const Version1Commands&);

  bool Execute(const protocol::Request& request);
  bool ReadPosition(int joint);
  bool SetPosition(int joint, short angle);
  bool SetAllPositions(short angle);
  bool HasFault(int joint);
  bool HasAnyFault();
  bool ReadSensor(int joint);
  bool IncludeSensor(int joint, short included);
  bool ReadSensorBlock();
  bool ReadSpeedLimit(int joint);
  bool SetSpeedLimit(int joint, short limit);
  bool ReadAccelerationLimit(int joint);
  bool SetAccelerationLimit(int joint, short limit);
  bool Reply(char letter, int identifier, short value);

  JointControl& joints_;
  const Motors& motors_;
  ImageObserver& camera_;
  Outbox& outbox_;
  bool is_in_block_[robot_model::MAX_JOINTS];
};

#endif  // RCSERVER_VERSION1_COMMANDS_H
