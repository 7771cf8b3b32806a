/// @file motion_states.h
#ifndef TEST_SUPPORT_ROS_MOTION_STATES_H
#define TEST_SUPPORT_ROS_MOTION_STATES_H

#include <aibo_driver/MotionState.h>

namespace test_support {

/// The movement that has ended last; its kind is NONE if nothing has ended yet.
inline aibo_driver::EndedMovement lastEnd(const aibo_driver::MotionState& state) {
  return state.ended.empty() ? aibo_driver::EndedMovement() : state.ended.back();
}

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_MOTION_STATES_H
