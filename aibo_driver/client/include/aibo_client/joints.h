/// @file joints.h
/// Targets and limits of joints. A joint is named by its RCServer identifier (names.h). Angles are in radians. They are
/// positive in the direction that Sony's Model Information calls positive.
#ifndef AIBO_CLIENT_JOINTS_H
#define AIBO_CLIENT_JOINTS_H

namespace aibo_client {

/// The position to which a joint is sent, or that the robot accepted for it.
struct JointTarget {
  int id = 0;           ///< 1..255
  double position = 0;  ///< rad, -2 pi..2 pi
  double speed = 0;     ///< rad/s: the limit of the joint's speed from now on; 0 keeps the present limit
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

}  // namespace aibo_client

#endif  // AIBO_CLIENT_JOINTS_H
