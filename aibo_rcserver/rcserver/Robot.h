/// @file Robot.h
/// All of the robot that a client's commands work on.
#ifndef RCSERVER_ROBOT_H
#define RCSERVER_ROBOT_H

#include "rcserver/JointControl.h"
#include "rcserver/Lights.h"
#include "rcserver/MotionFiles.h"
#include "rcserver/Motors.h"
#include "rcserver/PowerOrder.h"
#include "rcserver/Sensors.h"

/// Everything here outlives the session.
struct Robot {
  const char* design;  ///< as OPEN-R names it
  JointControl& joints;
  Motors& motors;
  const Sensors& sensors;
  Lights& lights;
  PowerOrder& power_order;
  const MotionFiles& motion_files;
};

#endif  // RCSERVER_ROBOT_H
