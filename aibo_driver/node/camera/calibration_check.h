/// @file calibration_check.h
/// Finds out why numbers cannot be the calibration of a robot's camera. docs/calibration.md has a table of what is
/// allowed, and why. Any thread may call the functions.
#ifndef AIBO_DRIVER_NODE_CAMERA_CALIBRATION_CHECK_H
#define AIBO_DRIVER_NODE_CAMERA_CALIBRATION_CHECK_H

#include <sensor_msgs/CameraInfo.h>

#include <string>

namespace aibo_driver::node {

/// True if all of K is 0. By CameraInfo.msg, the camera then has no calibration.
bool isEmpty(const sensor_msgs::CameraInfo& info);

/// Finds out why a calibration makes no sense.
/// @return the problem and what to do, for a message to the user, without a full stop; empty if there is none
std::string problemOf(const sensor_msgs::CameraInfo& info);

/// Finds out why camera_calibration_parsers would read the matrices of a file wrongly. It reads as many numbers as
/// `rows` and `cols` say, even past their end, and ignores the others. With decimal commas, a file has twice as many.
/// @param file a YAML file that exists
/// @return the problem and what to do, for a message to the user, without a full stop; empty if there is none
std::string problemOfFile(const std::string& file);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_CALIBRATION_CHECK_H
