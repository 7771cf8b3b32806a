/// @file Robot.h
/// All of the robot that a client's commands work on.
#ifndef AIBO_RCSERVER_RCSERVER_ROBOT_H
#define AIBO_RCSERVER_RCSERVER_ROBOT_H

#include "rcserver/body/Lights.h"
#include "rcserver/body/PowerOrder.h"
#include "rcserver/body/Sensors.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/joints/MotorSwitch.h"
#include "rcserver/motions/FileJobs.h"

/// Everything here outlives the session.
struct Robot {
  const char* design;  ///< as OPEN-R names it
  JointControl& joints;
  MotorSwitch& motors;
  const Sensors& sensors;
  Lights& lights;
  PowerOrder& power_order;
  FileJobs& files;
};

#endif  // AIBO_RCSERVER_RCSERVER_ROBOT_H
