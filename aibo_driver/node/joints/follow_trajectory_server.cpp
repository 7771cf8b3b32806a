#include "node/joints/follow_trajectory_server.h"

#include <actionlib/server/action_server.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <ros/console.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "movement/joint_plan.h"
#include "node/joints/trajectory_messages.h"
#include "node/orders.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;
using aibo_client::Exception;

namespace {

using control_msgs::FollowJointTrajectoryAction;
using control_msgs::FollowJointTrajectoryFeedback;
using control_msgs::FollowJointTrajectoryGoal;
using control_msgs::FollowJointTrajectoryResult;
using Server = actionlib::ActionServer<FollowJointTrajectoryAction>;
using Result = FollowJointTrajectoryResult;
using Tolerances = std::map<std::string, control_msgs::JointTolerance>;

constexpr std::chrono::milliseconds kFeedbackPeriod{50};

/// Thrown if a goal cannot be accepted.
struct GoalRefusal {
  std::int32_t code;
  std::string reason;
};

Tolerances tolerancesOf(const std::vector<control_msgs::JointTolerance>& list,
                        const trajectory_msgs::JointTrajectory& trajectory) {
  Tolerances tolerances;
  for (const control_msgs::JointTolerance& tolerance : list) {
    const auto& names = trajectory.joint_names;
    if (std::find(names.begin(), names.end(), tolerance.name) == names.end()) {
      throw GoalRefusal{Result::INVALID_GOAL,
                        "it has a tolerance for " + text::plainLine(tolerance.name) + ", which it does not move"};
    }
    tolerances[tolerance.name] = tolerance;
  }
  return tolerances;
}

// A tolerance of 0 means the usual tolerance. A tolerance below 0 means that there is none.
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
  if (grace > 0) {
    arrival.grace = std::chrono::milliseconds(std::llround(1000 * grace));
  }
  return arrival;
}

bool isBeyond(double error, double tolerance) {
  return tolerance > 0 && !(std::abs(error) <= tolerance);
}

/// Describes the first joint that is not within its tolerance. The text is empty if all joints are.
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

class ActionServer : public FollowTrajectoryServer {
 public:
  ActionServer(const ros::NodeHandle& handle, const movement::JointTable& table,
               const movement::MeasuredJoints& measured, movement::Mover& mover)
      : table_(table), measured_(measured), mover_(mover) {
    ros::NodeHandle actions(handle);
    constexpr bool kOneShot = false;
    constexpr bool kAutostart = false;
    timer_ = actions.createSteadyTimer(
        ros::WallDuration(std::chrono::duration<double>(kFeedbackPeriod).count()),
        [this](const ros::SteadyTimerEvent&) { watch(); }, kOneShot, kAutostart);
    server_ = std::make_unique<Server>(
        actions, "follow_joint_trajectory", [this](const Server::GoalHandle& goal) { accept(goal); },
        [this](const Server::GoalHandle& goal) { cancel(goal); }, kAutostart);
    server_->start();
  }

 private:
  struct Following {
    Server::GoalHandle goal;
    movement::Mover::Begun movement;
    Tolerances path;
  };

  void accept(Server::GoalHandle goal);
  void begin(const Server::GoalHandle& goal);
  void cancel(Server::GoalHandle goal);
  void watch();
  bool isOver(Following* following);
  static void finish(Server::GoalHandle goal, const movement::EndedMovement& end);
  void checkJoints(const trajectory_msgs::JointTrajectory& trajectory) const;
  FollowJointTrajectoryFeedback stateOf(const Following& following) const;

  const movement::JointTable& table_;
  const movement::MeasuredJoints& measured_;
  movement::Mover& mover_;
  std::unique_ptr<Server> server_;
  std::vector<Following> following_;
  ros::SteadyTimer timer_;
};

Result resultOf(std::int32_t code, const std::string& text) {
  Result result;
  result.error_code = code;
  result.error_string = text;
  return result;
}

void ActionServer::accept(Server::GoalHandle goal) {
  GoalRefusal refusal{Result::INVALID_GOAL, ""};
  try {
    begin(goal);
    return;
  } catch (const GoalRefusal& error) {
    refusal = error;
  } catch (const Exception& error) {
    refusal.reason = error.what();
  }
  goal.setRejected(resultOf(refusal.code, refusal.reason), refusal.reason);
}

void ActionServer::begin(const Server::GoalHandle& goal) {
  Following following;
  following.goal = goal;
  const FollowJointTrajectoryGoal& request = *goal.getGoal();
  checkJoints(request.trajectory);
  following.path = tolerancesOf(request.path_tolerance, request.trajectory);
  const movement::Arrival arrival = arrivalOf(request);
  std::chrono::nanoseconds wait{0};
  try {
    wait = waitBeforeStart(request.trajectory.header.stamp, ros::Time::now());
  } catch (const aibo_client::InvalidArgumentException& error) {
    throw GoalRefusal{Result::OLD_HEADER_TIMESTAMP, error.what()};
  }
  following.movement = mover_.follow(orderOfGoal(goal.getGoalID().id), toRequest(request.trajectory), wait, arrival);
  const movement::EndedMovement* const end = following.movement.ended();
  if (end != nullptr && end->how == EndedHow::kRefused) {
    throw GoalRefusal{Result::INVALID_GOAL, end->reason};
  }
  following.goal.setAccepted();
  following_.push_back(following);
  timer_.start();
}

void ActionServer::checkJoints(const trajectory_msgs::JointTrajectory& trajectory) const {
  for (const std::string& name : trajectory.joint_names) {
    if (!table_.findByName(name)) {
      throw GoalRefusal{Result::INVALID_JOINTS,
                        "the " + table_.design() + " has no joint '" + text::plainLine(name) + "'"};
    }
  }
}

void ActionServer::cancel(Server::GoalHandle goal) {
  const auto is_it = [&goal](const Following& following) { return following.goal == goal; };
  const auto found = std::find_if(following_.begin(), following_.end(), is_it);
  if (found == following_.end()) {
    return;
  }
  const std::string reason = "the goal was cancelled";
  try {
    mover_.cancel(found->movement.id, reason);
  } catch (const Exception& error) {
    ROS_WARN_STREAM_NAMED("joints", "The joints of a goal that was cancelled were not held: " << error.what());
  }
  following_.erase(found);
  goal.setCanceled(resultOf(Result::SUCCESSFUL, reason), reason);
}

void ActionServer::watch() {
  const auto is_over = [this](Following& following) { return isOver(&following); };
  following_.erase(std::remove_if(following_.begin(), following_.end(), is_over), following_.end());
  if (following_.empty()) {
    timer_.stop();
  }
}

bool ActionServer::isOver(Following* following) {
  const std::size_t joints = mover_.jointsOf(following->movement.id).size();
  if (const movement::EndedMovement* const end = following->movement.ended()) {
    finish(following->goal, *end);
    return true;
  }
  if (joints < following->goal.getGoal()->trajectory.joint_names.size()) {
    const std::string reason = "a newer trajectory moves some of its joints";
    following->goal.setCanceled(resultOf(Result::SUCCESSFUL, reason), reason);
    return true;
  }
  const FollowJointTrajectoryFeedback state = stateOf(*following);
  if (state.joint_names.empty()) {
    return false;
  }
  following->goal.publishFeedback(state);
  const std::string problem = violation(following->path, state);
  if (problem.empty()) {
    return false;
  }
  try {
    mover_.cancel(following->movement.id, problem);
  } catch (const Exception& error) {
    ROS_WARN_STREAM_NAMED("joints", "The joints of a goal that failed were not held: " << error.what());
  }
  following->goal.setAborted(resultOf(Result::PATH_TOLERANCE_VIOLATED, problem), problem);
  return true;
}

void ActionServer::finish(Server::GoalHandle goal, const movement::EndedMovement& end) {
  if (end.how == EndedHow::kDone) {
    goal.setSucceeded(resultOf(Result::SUCCESSFUL, ""));
  } else if (end.how == EndedHow::kReplaced) {
    goal.setCanceled(resultOf(Result::SUCCESSFUL, end.reason), end.reason);
  } else {
    const bool was_followed = end.how == EndedHow::kNotReached || end.how == EndedHow::kUnknown;
    const std::int32_t code = was_followed ? Result::GOAL_TOLERANCE_VIOLATED : Result::INVALID_GOAL;
    goal.setAborted(resultOf(code, end.reason), end.reason);
  }
}

// Where the joints should be and where they are. It is empty before the beginning and after the end. Each measured
// position is compared with where the joint should have been when it was measured.
FollowJointTrajectoryFeedback ActionServer::stateOf(const Following& following) const {
  FollowJointTrajectoryFeedback state;
  const trajectory_msgs::JointTrajectory& trajectory = following.goal.getGoal()->trajectory;
  for (std::size_t i = 0; i < trajectory.joint_names.size(); ++i) {
    const std::size_t joint = *table_.findByName(trajectory.joint_names[i]);
    const std::optional<movement::MeasuredJoint> measured = measured_.find(joint);
    if (!measured) {
      continue;
    }
    const auto wanted = mover_.wantedBy(following.movement.id, measured->arrival);
    if (i < wanted.size()) {
      state.joint_names.push_back(trajectory.joint_names[i]);
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

std::unique_ptr<FollowTrajectoryServer> startFollowTrajectoryServer(const ros::NodeHandle& handle,
                                                                    const movement::JointTable& table,
                                                                    const movement::MeasuredJoints& measured,
                                                                    movement::Mover& mover) {
  return std::make_unique<ActionServer>(handle, table, measured, mover);
}

}  // namespace aibo_driver::node
