#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_ROBOT_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_ROBOT_H

#include "rcserver/FrameClock.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/body/Microphone.h"
#include "rcserver/body/SensorDriver.h"
#include "rcserver/body/Speaker.h"
#include "rcserver/camera/CameraControl.h"
#include "rcserver/camera/PictureDatagrams.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/requests/FileJobs.h"

/// An order about the robot's power. PowerDown carries it out after the client has been informed and has gone.
enum PowerOrder {
  POWER_STAYS_ON,
  POWER_SHUT_DOWN,
  POWER_REBOOT,
  POWER_LIE_DOWN  ///< lie down, then shut down
};

struct Robot {
  const char* design;  ///< name of the design in OPEN-R
  JointControl& joints;
  MotorSwitch& motors;
  const SensorDriver& sensors;
  LightDriver& lights;
  CameraControl& camera;
  Microphone& microphone;
  Speaker& speaker;
  DatagramSwitch& datagrams;
  PowerOrder& power_order;
  FileJobs& files;
  const FrameClock& clock;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_ROBOT_H
