#ifndef AIBO_RCSERVER_RCSERVER_WALK_LEG_JOINTS_H
#define AIBO_RCSERVER_RCSERVER_WALK_LEG_JOINTS_H

#include <stddef.h>

#include "rcserver/joints/JointPlanner.h"
#include "robot_model/legs.h"
#include "robot_model/robot_model.h"

/// Moves the legs with the planner. Angles of the four legs are in the order of robot_model::Leg. Without the legs of
/// an ERS-7, only AreThere() and Has() may be called.
class LegJoints {
 public:
  LegJoints(JointPlanner& planner, const robot_model::RobotModel& robot);

  /// False if the robot does not have the legs of an ERS-7.
  bool AreThere() const { return are_there_; }

  bool Has(int joint) const;

  /// The angles of the legs when the joints are at these positions.
  /// @param positions the joints' positions by the robot's table
  void Find(const int* positions, robot_model::LegAngles* legs) const;

  /// The planned angles of the legs.
  void Find(robot_model::LegAngles* legs) const;

  /// Aims the joints (JointPlanner::Aim()) that move.
  /// @param moves which of rotators, elevators and knees move; NULL: all
  /// @return the longest way of a joint, in microradian
  int Aim(const robot_model::LegAngles* legs, const bool* moves = NULL) const;

  /// True if, as planned, all joints of the legs are where they were aimed at.
  bool HaveArrived() const;

  void Hold() const;

  /// Sets the speed limits of all joints of the legs to the robot's own.
  void ResetSpeedLimits() const;

  /// A joint of a leg whose speed limit is lower than the robot's own, or NO_JOINT.
  int FindSlow() const;

 private:
  static const int COUNT = robot_model::NUMBER_OF_LEGS * robot_model::JOINTS_OF_A_LEG;

  JointPlanner& planner_;
  const robot_model::RobotModel& robot_;
  int joints_[COUNT];  ///< indices in the robot's table: rotator, elevator and knee of each leg
  bool are_there_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_LEG_JOINTS_H
