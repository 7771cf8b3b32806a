/// @file parts.h
/// Commands to joints and LEDs. A part is named by its RCServer identifier (names.h). Angles are in radians. They are
/// positive in the direction that Sony's Model Information calls positive. The ranges of positions and speeds are our
/// choice.
#ifndef AIBO_CLIENT_PARTS_H
#define AIBO_CLIENT_PARTS_H

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

/// The two display modes of the LEDs on an ERS-7's face and back (Model Information ERS-7, section on LEDs). LEDs that
/// are only on or off ignore the mode.
enum class LedMode { kA, kB };

/// Sets one LED.
struct LedCommand {
  int id = 0;         ///< 1..255
  int intensity = 0;  ///< 0..255; 0 is off; an LED that is only on or off is on from 1
  LedMode mode = LedMode::kA;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_PARTS_H
