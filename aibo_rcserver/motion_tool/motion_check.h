/// @file motion_check.h
/// Whether a robot can do a motion as it is written.
#ifndef AIBO_RCSERVER_MOTION_TOOL_MOTION_CHECK_H
#define AIBO_RCSERVER_MOTION_TOOL_MOTION_CHECK_H

#include <string>
#include <vector>

#include "mtn/motion.h"
#include "robot_model/robot_model.h"

namespace motion_tool {

/// What the robot would not do as it is written: joints that it does not have, positions out of their limits or in the
/// way of each other, and joints that would have to be faster than they can. Joints that are not in the motion are
/// taken to stand out of the way.
/// @return one line each; empty if all is well
std::vector<std::string> findObstacles(const mtn::Motion& motion, const robot_model::RobotModel& robot);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_MOTION_CHECK_H
