/// @file EmptyRobot.h
/// What a robot counts as whose body cannot be had.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_EMPTY_ROBOT_H
#define AIBO_RCSERVER_RCSERVER_BODY_EMPTY_ROBOT_H

#include "robot_model/robot_model.h"

/// Has no joints, sensors, LEDs and ears.
const robot_model::RobotModel EMPTY_ROBOT = {"", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_EMPTY_ROBOT_H
