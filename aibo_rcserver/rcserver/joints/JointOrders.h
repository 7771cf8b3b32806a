#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_ORDERS_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_ORDERS_H

#include "rcserver/joints/JointPlanner.h"
#include "rcserver/joints/OrderBook.h"
#include "robot_model/robot_model.h"

/// Decides when the joints of a command have arrived. A joint is under way in at most one command. The joint leaves the
/// command when it has arrived, when something else takes it, or when it fails. A command ends when none of its joints
/// is under way: refused if one has failed, otherwise for the reason for which the last joint left.
///
/// Joints are numbered by their index in the robot's table, and time is in OPEN-R frames of 8 ms.
class JointOrders {
 public:
  /// Frames from the end of the planned way to the first measurement that counts, because commands wait for up to 8
  /// frames, and servos lag. The value is our choice.
  static const unsigned FRAMES_TO_FOLLOW = 12;

  JointOrders(const JointPlanner& planner, const robot_model::RobotModel& robot, OrderBook& book);

  /// Begins a command. Its joints must have left earlier commands. A command without joints is done at once.
  /// @param joints the joints, whose targets are the planner's
  /// @param number number of the request, not 0
  void Begin(const int* joints, int count, unsigned short number);

  /// Makes the joint leave its command, if it is in one.
  void Leave(int joint, const EndReason& reason);

  /// Call this when all joints have been measured.
  /// @param positions by the robot's table, in microradian
  void Measured(const int* positions, unsigned frame);

 private:
  // A joint that may be under way in a command.
  struct OrderedJoint {
    int order;  ///< the order of its command; NO_ORDER if it is not under way
    int target;
    bool is_over;    ///< true: the joint should have arrived, as planned
    unsigned since;  ///< frame in which is_over became true
  };

  bool HasJoint(int order) const;
  void Judge(int joint, int distance, unsigned frame);

  const JointPlanner& planner_;
  const robot_model::RobotModel& robot_;
  OrderBook& book_;
  OrderedJoint joints_[robot_model::MAX_JOINTS];
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_JOINT_ORDERS_H
