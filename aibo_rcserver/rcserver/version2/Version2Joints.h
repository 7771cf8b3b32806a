/// @file Version2Joints.h
/// The joints, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_JOINTS_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_JOINTS_H

#include "rcserver/joints/JointControl.h"
#include "rcserver/joints/MotorSwitch.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `J`, `V` and `O`, and reports joints that do not follow. Pure logic: no OPEN-R. Each function answers
/// its request; `payload` is as many bytes as the request's header says.
class Version2Joints {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Joints(JointControl& joints, MotorSwitch& motors, Version2Replies& replies)
      : joints_(joints), motors_(motors), replies_(replies) {}

  void Move(const Request& request, const unsigned char* payload);
  void LimitSpeeds(const Request& request, const unsigned char* payload);
  void SwitchMotors(const Request& request, const unsigned char* payload);

  /// Pushes an error for each joint that has been found not to follow.
  void PushFaults();

 private:
  static const char* WordsFor(JointWatch::Verdict fault);
  void RefuseUnknownJoint(const Request& request, unsigned char identifier);

  JointControl& joints_;
  MotorSwitch& motors_;
  Version2Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_JOINTS_H
