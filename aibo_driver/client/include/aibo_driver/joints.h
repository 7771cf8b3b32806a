/// @file joints.h
/// What is said to the robot about its joints. A joint is named by its RCServer identifier (docs/protocol.md lists
/// them); angles are radian, positive as in Sony's Model Information.
#ifndef AIBO_DRIVER_JOINTS_H
#define AIBO_DRIVER_JOINTS_H

namespace aibo_driver {

/// Where a joint is to go, or was accepted to go.
struct JointTarget {
  int id = 0;           ///< 1..255
  double position = 0;  ///< rad, -2 pi..2 pi
};

/// How fast a joint may move.
struct JointSpeedLimit {
  int id = 0;        ///< 1..255
  double speed = 0;  ///< rad/s, above 0, at most 100
};

/// What a joint of this robot can do, as the robot says.
struct JointLimits {
  int id = 0;
  double lower = 0;  ///< rad
  double upper = 0;  ///< rad
  double speed = 0;  ///< rad/s
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_JOINTS_H
