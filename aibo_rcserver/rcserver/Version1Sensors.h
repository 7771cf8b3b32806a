/// @file Version1Sensors.h
/// What the robot measures, for a client of version 1.
#ifndef RCSERVER_VERSION1_SENSORS_H
#define RCSERVER_VERSION1_SENSORS_H

#include "protocol/request_reader.h"
#include "rcserver/JointControl.h"
#include "rcserver/Version1Replies.h"

/// Carries out `S`. Pure logic: no OPEN-R.
class Version1Sensors {
 public:
  /// All must outlive this.
  Version1Sensors(const JointControl& joints, Version1Replies& replies);

  /// A new client: the block holds everything.
  void Begin();

  /// @return false: to be refused
  bool Execute(const protocol::Request& request);

 private:
  void Read(int joint);
  bool Include(int joint, short included);
  void ReadBlock();

  const JointControl& joints_;
  Version1Replies& replies_;
  bool is_in_block_[robot_model::MAX_JOINTS];
};

#endif  // RCSERVER_VERSION1_SENSORS_H
