/// @file nominal_calibration.h
/// A calibration for a camera that nobody has calibrated, and the same calibration for other sizes of pictures.
#ifndef AIBO_DRIVER_NODE_CAMERA_NOMINAL_CALIBRATION_H
#define AIBO_DRIVER_NODE_CAMERA_NOMINAL_CALIBRATION_H

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <optional>
#include <string>

namespace aibo_driver::node {

/// The calibration of an ideal camera that has the field of view given by Sony. It has no distortion, and its optical
/// axis is in the middle of the picture.
///
/// ERS-7: 56.9 x 45.2 degrees (Model Information ERS-7), as the simulated camera. ERS-210: 57.6 x 47.8 degrees (Model
/// Information ERS-210). docs/calibration.md compares them with the calibration of a real robot.
///
/// Any thread may call this function.
/// @param design the robot's design, "ERS-7" or "ERS-210"
/// @param width, height the size of the pictures, above 0; every size shows the whole field of view
sensor_msgs::CameraInfo nominalCalibration(const std::string& design, std::uint32_t width, std::uint32_t height);

/// The same calibration for pictures of another size but the same field of view. Any thread may call this function.
/// @param width, height the size of the pictures, above 0
/// @return empty unless both sides are multiplied, or both are divided, by the same whole number
std::optional<sensor_msgs::CameraInfo> scaleCalibration(const sensor_msgs::CameraInfo& info, std::uint32_t width,
                                                        std::uint32_t height);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_NOMINAL_CALIBRATION_H
