/// @file Version1Joints.h
/// The joints, for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_JOINTS_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_JOINTS_H

#include "protocol/request_reader.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/joints/MotorSwitch.h"
#include "rcserver/version1/Version1Replies.h"

/// Carries out `J`, `V` and `A`. Pure logic: no OPEN-R.
class Version1Joints {
 public:
  /// All must outlive this.
  Version1Joints(JointControl& joints, const MotorSwitch& motors, Version1Replies& replies)
      : joints_(joints), motors_(motors), replies_(replies) {}

  /// @return false: to be refused
  bool Execute(const protocol::Request& request);

 private:
  bool ReadPosition(int joint);
  bool SetPosition(int joint, short angle);
  bool SetAllPositions(short angle);
  bool HasFault(int joint);
  bool HasAnyFault();
  void ReadSpeedLimit(int joint);
  void SetSpeedLimit(int joint, short limit);
  void ReadAccelerationLimit(int joint);
  void SetAccelerationLimit(int joint, short limit);

  JointControl& joints_;
  const MotorSwitch& motors_;
  Version1Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_JOINTS_H
