#include "node/walk/goal_walks.h"

#include <ros/time.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "aibo_client/exceptions.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::InvalidArgumentException;

namespace {

constexpr double kOldestStamp = 0.5;      // s
constexpr double kUnitTolerance = 0.1;    // of the length of an orientation
constexpr double kCloser = 0.01;          // m
constexpr double kMetresForRadian = 0.2;  // the distance that counts as much as a radian

bool isFinite(const geometry_msgs::Pose& pose) {
  return std::isfinite(pose.position.x) && std::isfinite(pose.position.y) && std::isfinite(pose.position.z) &&
         std::isfinite(pose.orientation.x) && std::isfinite(pose.orientation.y) && std::isfinite(pose.orientation.z) &&
         std::isfinite(pose.orientation.w);
}

// The yaw of a quaternion, whose length need not be quite 1.
double yawOf(const geometry_msgs::Quaternion& turn) {
  return std::atan2(2 * (turn.w * turn.z + turn.x * turn.y),
                    turn.w * turn.w + turn.x * turn.x - turn.y * turn.y - turn.z * turn.z);
}

walk::PlanePose poseIn(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& turn = pose.orientation;
  if (!isFinite(pose)) {
    throw InvalidArgumentException("the goal has a value that is NaN or infinite");
  }
  const double length = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w);
  if (std::abs(length - 1) > kUnitTolerance) {
    throw InvalidArgumentException("the orientation of the goal is not a unit quaternion; w: 1.0 is straight ahead");
  }
  return {pose.position.x, pose.position.y, yawOf(turn)};
}

std::string format(const char* form, double a, double b = 0, double c = 0) {
  char text[160];
  std::snprintf(text, sizeof(text), form, a, b, c);
  return text;
}

}  // namespace

GoalWalks::GoalWalks(const DriverParameters& parameters, const aibo_client::RcServerClient& client,
                     movement::Mover& mover, Odometer odometer, movement::Mover::Clock clock)
    : parameters_(parameters),
      client_(client),
      mover_(mover),
      odometer_(std::move(odometer)),
      clock_(std::move(clock)) {}

GoalWalks::Walk GoalWalks::begin(const geometry_msgs::PoseStamped& goal, const movement::Order& order) {
  try {
    const walk::PlanePose pose = goalIn(goal);
    const std::string name = format("to x %.2f m, y %.2f m, yaw %.2f rad", pose.x, pose.y, pose.yaw);
    return {*this, mover_.walkToGoal(order, name), pose};
  } catch (const InvalidArgumentException& error) {
    return {*this, mover_.refuse(order, movement::Movement::Kind::kWalk, {}, error.what()), {}};
  }
}

// The goal in the frame odom.
walk::PlanePose GoalWalks::goalIn(const geometry_msgs::PoseStamped& goal) const {
  walk::PlanePose pose = poseIn(goal.pose);
  const double age = goal.header.stamp.isZero() ? 0 : ros::Time::now().toSec() - goal.header.stamp.toSec();
  if (age > kOldestStamp) {
    throw InvalidArgumentException(format("too old: its stamp was %.1f s ago, and 0.5 s are allowed", age));
  }
  const std::optional<walk::PlanePose> here = odometer_();
  if (!here) {
    throw InvalidArgumentException("there is no odometry: is the robot connected, and telemetry_rate above 0?");
  }
  const std::string& given = goal.header.frame_id;
  const std::string frame = given.substr(given.find_first_not_of('/') == 1 ? 1 : 0);
  if (frame == parameters_.frame("base_link") || frame == parameters_.frame("base_footprint")) {
    pose = walk::inFrameOf(*here, pose);
  } else if (frame != parameters_.frame("odom")) {
    throw InvalidArgumentException("the frame of the goal is '" + text::plainLine(given) + "'; it must be " +
                                   parameters_.frame("odom") + ", " + parameters_.frame("base_link") + " or " +
                                   parameters_.frame("base_footprint"));
  }
  const double distance = walk::GoalController(pose).distanceFrom(*here);
  if (distance > kFarthest) {
    throw InvalidArgumentException(format("the goal is %.4g m away, and %.0f m are allowed", distance, kFarthest));
  }
  return pose;
}

const movement::EndedMovement* GoalWalks::Walk::advance() {
  if (begun_.ended() != nullptr || is_stopping_) {
    return begun_.ended();
  }
  const std::optional<walk::PlanePose> here = walks_->odometer_();
  if (!here) {
    is_stopping_ = true;
    stop("the robot has not said where it is for 0.5 s");
    return begun_.ended();
  }
  distance_left_ = controller_.distanceFrom(*here);
  turn_left_ = controller_.turnFrom(*here);
  if (comesNoCloser()) {
    is_stopping_ = true;
    stop(format("it has come no closer to the goal for %.0f s", std::chrono::duration<double>(kPatience).count()));
    return begun_.ended();
  }
  const aibo_client::WalkVelocity wanted = controller_.velocityAt(*here);
  const aibo_client::WalkLimits limits = walks_->client_.status().robot.walk_limits;
  const aibo_client::WalkVelocity allowed = walk::velocityToSend(wanted, walks_->parameters_.walk, limits);
  is_stopping_ = allowed.isZero();
  if (is_stopping_ && !wanted.isZero()) {
    stop("it would have to walk or turn in a way for which the limit is 0");
    return begun_.ended();
  }
  walks_->mover_.steerToGoal(begun_.id, allowed);
  return begun_.ended();
}

bool GoalWalks::Walk::comesNoCloser() {
  const double left = distance_left_ + kMetresForRadian * std::abs(turn_left_);
  const movement::SteadyTime now = walks_->clock_();
  if (!closer_at_ || left < least_left_ - kCloser) {
    closer_at_ = now;
    least_left_ = left;
  }
  return now - *closer_at_ > kPatience;
}

}  // namespace aibo_driver::node
