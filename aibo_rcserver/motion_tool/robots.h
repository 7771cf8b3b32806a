/// @file robots.h
/// What motion files call the robots.
#ifndef AIBO_RCSERVER_MOTION_TOOL_ROBOTS_H
#define AIBO_RCSERVER_MOTION_TOOL_ROBOTS_H

#include <string>

#include "robot_model/robot_model.h"

namespace motion_tool {

/// What a motion file says for a robot such as "ERS-7"; any other name is passed on as it is.
std::string designOf(const std::string& robot);

/// The robot that a motion file with this design is for, such as "ERS-7"; any other design is passed on as it is.
std::string robotOf(const std::string& design);

/// The table of the robot that a motion file with this design is for; null if there is none.
const robot_model::RobotModel* modelOf(const std::string& design);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_ROBOTS_H
