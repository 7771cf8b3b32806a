/// @file good_calibration.h
#ifndef TEST_SUPPORT_GOOD_CALIBRATION_H
#define TEST_SUPPORT_GOOD_CALIBRATION_H

#include <sensor_msgs/CameraInfo.h>

namespace test_support {

/// A plausible calibration of the ERS-7's camera.
inline sensor_msgs::CameraInfo goodCalibration() {
  sensor_msgs::CameraInfo info;
  info.width = 208;
  info.height = 160;
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.2, 0.0, 0.0, 0.0};
  info.K = {190.0, 0.0, 104.0, 0.0, 190.0, 80.0, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {189.0, 0.0, 104.5, 0.0, 0.0, 189.5, 80.5, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_GOOD_CALIBRATION_H
