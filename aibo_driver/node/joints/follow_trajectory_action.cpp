#include "node/actions.h"

#ifdef HAS_CONTROL_MSGS
#include <control_msgs/FollowJointTrajectoryAction.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "movement/joint_plan.h"
#include "node/goal_server.h"
#include "node/joints/joint_commander.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

namespace {

using aibo_client::EndedHow;

using control_msgs::FollowJointTrajectoryAction;
using control_msgs::FollowJointTrajectoryFeedback;
using control_msgs::FollowJointTrajectoryGoal;
using control_msgs::FollowJointTrajectoryResult;
using Result = FollowJointTrajectoryResult;
using End = GoalEnd<FollowJointTrajectoryAction>;
using Trajectory = Activity<FollowJointTrajectoryAction>;
using Tolerances = std::map<std::string, control_msgs::JointTolerance>;

constexpr std::chrono::milliseconds kPeriod{50};
constexpr const char* kCancelled = "the goal was cancelled";

/// Thrown if a goal cannot be accepted for a reason other than Result::INVALID_GOAL.
class GoalRefusal : public aibo_client::InvalidArgumentException {
 public:
  GoalRefusal(std::int32_t code, const std::string& reason) : InvalidArgumentException(reason), code_(code) {}
  std::int32_t code() const { return code_; }

 private:
  std::int32_t code_;
};

Tolerances tolerancesOf(const std::vector<control_msgs::JointTolerance>& list,
                        const trajectory_msgs::JointTrajectory& trajectory) {
  Tolerances tolerances;
  for (const control_msgs::JointTolerance& tolerance : list) {
    const auto& names = trajectory.joint_names;
    if (std::find(names.begin(), names.end(), tolerance.name) == names.end()) {
      throw aibo_client::InvalidArgumentException("it has a tolerance for " + text::plainLine(tolerance.name) +
                                                  ", which it does not move");
    }
    tolerances[tolerance.name] = tolerance;
  }
  return tolerances;
}

// When the goal's joints have arrived. A tolerance of 0 is the usual one; below 0, there is none.
movement::Arrival arrivalOf(const FollowJointTrajectoryGoal& goal) {
  movement::Arrival arrival;
  for (const auto& [joint, given] : tolerancesOf(goal.goal_tolerance, goal.trajectory)) {
    movement::Tolerance& tolerance = arrival.tolerances[joint];
    if (given.position != 0) {
      tolerance.position = given.position > 0 ? given.position : std::numeric_limits<double>::infinity();
    }
    if (given.velocity > 0) {
      tolerance.speed = given.velocity;
    }
  }
  const double grace = goal.goal_time_tolerance.toSec();
  arrival.is_measured = !arrival.tolerances.empty() || grace > 0;  // the robot does not know these tolerances
  if (grace > 0) {
    arrival.grace = std::chrono::milliseconds(std::llround(1000 * grace));
  }
  return arrival;
}

bool isBeyond(double error, double tolerance) {
  return tolerance > 0 && !(std::abs(error) <= tolerance);
}

/// Describes the first joint that is not within its tolerance; empty if all joints are.
std::string violation(const Tolerances& tolerances, const FollowJointTrajectoryFeedback& state) {
  for (std::size_t i = 0; i < state.joint_names.size(); ++i) {
    const auto found = tolerances.find(state.joint_names[i]);
    if (found == tolerances.end()) {
      continue;
    }
    const double position = state.error.positions[i];
    const double velocity = state.error.velocities[i];
    if (isBeyond(position, found->second.position)) {
      return state.joint_names[i] + " is " + std::to_string(std::abs(position)) + " rad from where it should be; " +
             std::to_string(found->second.position) + " rad are allowed";
    }
    if (isBeyond(velocity, found->second.velocity)) {
      return state.joint_names[i] + " is " + std::to_string(std::abs(velocity)) + " rad/s from its speed; " +
             std::to_string(found->second.velocity) + " rad/s are allowed";
    }
  }
  return "";
}

void checkJoints(const trajectory_msgs::JointTrajectory& trajectory, const movement::JointTable& table) {
  const std::string too_many = movement::describeTooMany(trajectory.joint_names.size());
  if (!too_many.empty()) {
    throw GoalRefusal(Result::INVALID_JOINTS, too_many);
  }
  for (const std::string& name : trajectory.joint_names) {
    if (!table.findByName(name)) {
      throw GoalRefusal(Result::INVALID_JOINTS,
                        "the " + table.design() + " has no joint '" + text::plainLine(name) + "'");
    }
  }
}

std::chrono::nanoseconds waitFor(const trajectory_msgs::JointTrajectory& trajectory) {
  try {
    return waitBeforeStart(trajectory.header.stamp, ros::Time::now());
  } catch (const aibo_client::InvalidArgumentException& error) {
    throw GoalRefusal(Result::OLD_HEADER_TIMESTAMP, error.what());
  }
}

Result resultOf(std::int32_t code, const std::string& text) {
  Result result;
  result.error_code = code;
  result.error_string = text;
  return result;
}

End aborted(std::int32_t code, const std::string& reason) {
  return {End::State::kAborted, resultOf(code, reason), reason};
}

End refuse(const std::exception& error) {
  const auto* const refusal = dynamic_cast<const GoalRefusal*>(&error);
  return aborted(refusal == nullptr ? Result::INVALID_GOAL : refusal->code(), error.what());
}

End endOf(const movement::EndedMovement& end) {
  if (end.how == EndedHow::kDone) {
    return {End::State::kSucceeded, resultOf(Result::SUCCESSFUL, ""), ""};
  }
  if (end.how == EndedHow::kReplaced || end.reason == kCancelled) {
    return {End::State::kCanceled, resultOf(Result::SUCCESSFUL, end.reason), end.reason};
  }
  const bool was_followed = end.how == EndedHow::kNotReached || end.how == EndedHow::kUnknown;
  return aborted(was_followed ? Result::GOAL_TOLERANCE_VIOLATED : Result::INVALID_GOAL, end.reason);
}

// Ends a trajectory that has left its path.
End fail(movement::Mover* mover, movement::MovementId trajectory, const std::string& problem) {
  try {
    mover->cancel(trajectory, problem);
  } catch (const aibo_client::Exception& error) {
    ROS_WARN_STREAM_NAMED("joints", "A goal has failed, and its joints could not be held: " << error.what());
  }
  return aborted(Result::PATH_TOLERANCE_VIOLATED, problem);
}

// Where the joints should be and where they are. The result is empty before the trajectory's beginning and after its
// end. Each measured position is compared with where the joint should have been when it was measured.
FollowJointTrajectoryFeedback feedbackOf(movement::MovementId trajectory, const std::vector<std::string>& joints,
                                         const movement::JointTable& table,
                                         const movement::MeasuredJoints& measured_joints,
                                         const movement::Mover& mover) {
  FollowJointTrajectoryFeedback state;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::size_t joint = *table.findByName(joints[i]);
    const std::optional<movement::MeasuredJoint> measured = measured_joints.find(joint);
    if (!measured) {
      continue;
    }
    const auto wanted = mover.wantedBy(trajectory, measured->arrival);
    if (i < wanted.size()) {
      state.joint_names.push_back(joints[i]);
      state.desired.positions.push_back(wanted[i].position);
      state.desired.velocities.push_back(wanted[i].velocity);
      state.actual.positions.push_back(measured->position);
      state.actual.velocities.push_back(measured->velocity);
      state.error.positions.push_back(wanted[i].position - measured->position);
      state.error.velocities.push_back(wanted[i].velocity - measured->velocity);
    }
  }
  state.header.stamp = ros::Time::now();
  return state;
}

}  // namespace

Action startFollowTrajectory(const ros::NodeHandle& handle, const movement::JointTable& table,
                             const movement::MeasuredJoints& measured, movement::Mover& mover) {
  ActionKind<FollowJointTrajectoryAction> kind;
  kind.name = "follow_joint_trajectory";
  kind.period = kPeriod;
  kind.begin = [&](const FollowJointTrajectoryGoal& goal, const movement::Order& order) -> Trajectory {
    checkJoints(goal.trajectory, table);
    const Tolerances path = tolerancesOf(goal.path_tolerance, goal.trajectory);
    const movement::Arrival arrival = arrivalOf(goal);
    const std::chrono::nanoseconds wait = waitFor(goal.trajectory);
    const movement::Mover::Answer begun = mover.follow(order, toRequest(goal.trajectory), wait, arrival);
    throwIfRefused(begun);
    const auto stop = [&mover, begun](const movement::Order&) { mover.cancel(begun.id, kCancelled); };
    const auto look = [&, begun, path,
                       joints = goal.trajectory.joint_names](const Trajectory::Publish& publish) -> std::optional<End> {
      if (const movement::EndedMovement* const ended = begun.ended()) {
        return endOf(*ended);
      }
      const FollowJointTrajectoryFeedback now = feedbackOf(begun.id, joints, table, measured, mover);
      if (now.joint_names.empty()) {
        return std::nullopt;
      }
      publish(now);
      const std::string problem = violation(path, now);
      return problem.empty() ? std::nullopt : std::make_optional(fail(&mover, begun.id, problem));
    };
    return {"", stop, look};
  };
  kind.refuse = refuse;
  return std::make_shared<GoalServer<FollowJointTrajectoryAction>>(handle, kind);
}

}  // namespace aibo_driver::node

#else  // a system without control_msgs, such as Debian 12

namespace aibo_driver::node {

Action startFollowTrajectory(const ros::NodeHandle&, const movement::JointTable&, const movement::MeasuredJoints&,
                             movement::Mover&) {
  return nullptr;
}

}  // namespace aibo_driver::node

#endif
