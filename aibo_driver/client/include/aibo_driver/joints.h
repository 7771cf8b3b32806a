/// @file joints.h
/// Targets and limits of joints. A joint is given by its RCServer identifier (docs/protocol.md lists them); angles are
/// in radian, and positive in the direction that Sony's Model Information calls positive.
#ifndef AIBO_DRIVER_JOINTS_H
#define AIBO_DRIVER_JOINTS_H

namespace aibo_driver {

/// The position that a joint is sent to, or that the robot accepted for it.
struct JointTarget {
  int id = 0;           ///< 1..255
  double position = 0;  ///< rad, -2 pi..2 pi
};

/// The greatest speed of a joint.
struct JointSpeedLimit {
  int id = 0;        ///< 1..255
  double speed = 0;  ///< rad/s, above 0, at most 100
};

/// The range and the greatest speed of a joint, as the robot reports them.
struct JointLimits {
  int id = 0;
  double lower = 0;  ///< rad
  double upper = 0;  ///< rad
  double speed = 0;  ///< rad/s
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_JOINTS_H
