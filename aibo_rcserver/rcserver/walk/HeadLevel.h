#ifndef AIBO_RCSERVER_RCSERVER_WALK_HEAD_LEVEL_H
#define AIBO_RCSERVER_RCSERVER_WALK_HEAD_LEVEL_H

#include <algorithm>

#include "rcserver/joints/JointPlanner.h"
#include "robot_model/robot_model.h"

/// Levels the head. A head that hangs down would hit the floor, or keep the robot from rolling over. Joints that
/// something else moves are left alone.
class HeadLevel {
 public:
  HeadLevel(JointPlanner& planner, const robot_model::RobotModel& robot) : planner_(planner) {
    static const char* const NAMES[COUNT] = {"neck_tilt", "head_pan", "head_tilt"};
    for (int i = 0; i < COUNT; ++i) {
      joints_[i] = findJointByName(robot, NAMES[i]);
    }
    Begin(false);
  }

  /// @param levels true: the head is to be levelled from now on
  void Begin(bool levels) { std::fill(levels_, levels_ + COUNT, levels); }

  /// True if this is one of the joints that are levelled.
  bool Has(int joint) const { return std::find(joints_, joints_ + COUNT, joint) != joints_ + COUNT; }

  /// True if this joint is to be levelled.
  bool Levels(int joint) const {
    const int i = static_cast<int>(std::find(joints_, joints_ + COUNT, joint) - joints_);
    return i < COUNT && levels_[i];
  }

  /// Call this when something else moves the joint.
  void LeaveAlone(int joint) {
    for (int i = 0; i < COUNT; ++i) {
      levels_[i] = levels_[i] && joints_[i] != joint;
    }
  }

  /// Levels the head.
  /// @param milliseconds the time to take
  void Go(int milliseconds) {
    for (int i = 0; i < COUNT; ++i) {
      if (levels_[i]) {
        planner_.Aim(joints_[i], i == 0 ? -174533 : 0);  // the neck 10 degrees forward
      }
    }
    planner_.Go(milliseconds);
  }

 private:
  static const int COUNT = 3;

  JointPlanner& planner_;
  int joints_[COUNT];  ///< indices in the robot's table
  bool levels_[COUNT];
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_HEAD_LEVEL_H
