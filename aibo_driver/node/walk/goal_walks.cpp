#include "node/walk/goal_walks.h"

#include <ros/time.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "aibo_client/exceptions.h"
#include "node/orders.h"
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

void GoalWalks::subscribe(const ros::NodeHandle& handle) {
  timer_ = makeTimer(handle, kPeriod, [this] { advance(); });
  constexpr std::uint32_t kNewest = 1;
  subscriber_ = subscribeToOrders<geometry_msgs::PoseStamped>(
      handle, "goal", kNewest, [this](const auto& goal, const auto& order) { begin(goal, order); });
}

GoalWalks::Begun GoalWalks::begin(const geometry_msgs::PoseStamped& goal, const movement::Order& order) {
  try {
    const walk::PlanePose pose = goalIn(goal);
    const std::string name = format("to x %.2f m, y %.2f m, yaw %.2f rad", pose.x, pose.y, pose.yaw);
    const movement::Mover::Answer begun = mover_.walkToGoal(order, name);
    const auto left = std::make_shared<Left>();
    if (begun.ended() == nullptr) {
      walk_ = Walk{begun, walk::GoalController(pose), std::numeric_limits<double>::infinity(), clock_(), left};
      timer_.start();
    }
    return {begun, left};
  } catch (const InvalidArgumentException& error) {
    return {mover_.refuse(order, movement::Movement::Kind::kWalk, {}, error.what()), nullptr};
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

void GoalWalks::advance() {
  if (walk_ && walk_->begun.ended() == nullptr) {
    const std::string problem = steer();
    if (!problem.empty()) {
      mover_.cancel(walk_->begun.id, problem);
      walk_.reset();
    }
  } else {
    walk_.reset();
  }
  if (!walk_) {
    timer_.stop();
  }
}

// @return why the walk cannot go on; empty if it goes on, or ends because the robot is there
std::string GoalWalks::steer() {
  const std::optional<walk::PlanePose> here = odometer_();
  if (!here) {
    return "the robot has not said where it is for 0.5 s";
  }
  *walk_->left = {walk_->controller.distanceFrom(*here), walk_->controller.turnFrom(*here)};
  const double left = walk_->left->distance + kMetresForRadian * std::abs(walk_->left->turn);
  if (left < walk_->least_left - kCloser) {
    walk_->closer_at = clock_();
    walk_->least_left = left;
  }
  if (clock_() - walk_->closer_at > kPatience) {
    return format("it has come no closer to the goal for %.0f s", std::chrono::duration<double>(kPatience).count());
  }
  const aibo_client::WalkVelocity wanted = walk_->controller.velocityAt(*here);
  const aibo_client::WalkLimits limits = client_.status().robot.walk_limits;
  const aibo_client::WalkVelocity allowed = walk::velocityToSend(wanted, parameters_.walk, limits);
  if (allowed.isZero() && !wanted.isZero()) {
    return "it would have to walk or turn in a way for which the limit is 0";
  }
  mover_.steerToGoal(walk_->begun.id, allowed);
  if (allowed.isZero()) {
    walk_.reset();
  }
  return "";
}

}  // namespace aibo_driver::node
