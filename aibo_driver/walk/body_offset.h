/// @file body_offset.h
/// How the legs of an ERS-7 that stands raise, lower and tilt its body.
#ifndef AIBO_DRIVER_WALK_BODY_OFFSET_H
#define AIBO_DRIVER_WALK_BODY_OFFSET_H

#include <array>
#include <string>

#include "movement/joint_table.h"
#include "walk/stance.h"

namespace aibo_driver::walk {

/// Where the body is, compared with the posture stand.
struct BodyOffset {
  double height = 0;  ///< m, positive is higher
  double roll = 0;    ///< rad, positive lowers the right side (REP 103)
  double pitch = 0;   ///< rad, positive lowers the nose
};

/// The legs of a robot whose body has an offset.
struct OffsetLegs {
  std::array<LegAngles, kLegs> angles;
  std::string limit;  ///< what does not allow the whole offset, such as "left_hind_knee is at its limit"; usually empty
};

/// Finds the angles with which the feet stay where they are on the floor in the posture stand. If the whole offset is
/// not possible, the same part of height, roll and pitch is left out. Possible is what the joints' limits allow and
/// what the robot itself still calls standing, so that it can walk and take postures from there.
/// @param offset finite
/// @param table of an ERS-7
OffsetLegs findLegs(const BodyOffset& offset, const movement::JointTable& table);

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_BODY_OFFSET_H
