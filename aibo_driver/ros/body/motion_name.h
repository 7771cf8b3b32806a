/// @file motion_name.h
#ifndef AIBO_DRIVER_ROS_BODY_MOTION_NAME_H
#define AIBO_DRIVER_ROS_BODY_MOTION_NAME_H

#include <string>

namespace aibo_driver::node {

/// The file's name on the robot for what a user calls a motion: "nod", "NOD.MTN" and "nod.mtn" are NOD.MTN. Whether it
/// is one that the robot allows is for the client to check. The empty name stays empty.
std::string motionFileName(const std::string& name);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_MOTION_NAME_H
