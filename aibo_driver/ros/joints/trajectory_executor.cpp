#include "ros/joints/trajectory_executor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {
namespace {

constexpr std::uint32_t kQueueSize = 2;

// A joint slower than this counts as standing: a single step of its encoder within 32 ms looks like 0.03 rad/s.
constexpr double kStanding = 0.06;  // rad/s

// A message takes time to arrive, and the clocks of two machines differ a little.
constexpr double kLongestPast = 1.0;  // s

// A stamp further ahead comes from another clock, or is garbage.
constexpr double kLongestWait = 3600.0;  // s

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

joints::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message) {
  joints::TrajectoryRequest request;
  request.joints = message.joint_names;
  for (const trajectory_msgs::JointTrajectoryPoint& point : message.points) {
    request.points.push_back({point.time_from_start.toSec(), point.positions, point.velocities});
  }
  return request;
}

}  // namespace

std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now) {
  if (stamp.isZero()) {
    return std::chrono::nanoseconds(0);
  }
  // In seconds, because subtracting two ros::Time more than 68 years apart throws.
  const double wait = stamp.toSec() - now.toSec();
  if (wait < -kLongestPast || wait > kLongestWait) {
    throw InvalidArgumentException("Trajectory refused: header.stamp, when it should begin, is " +
                                   std::to_string(std::abs(wait)) + (wait < 0 ? " s ago" : " s ahead") +
                                   "; allowed is from 1 s ago to an hour ahead, or 0, which means at once.");
  }
  return std::chrono::nanoseconds(std::max<std::int64_t>(0, std::llround(wait * 1e9)));
}

TrajectoryExecutor::TrajectoryExecutor(const joints::JointTable& table, const joints::MeasuredJoints& measured,
                                       joints::JointLink& link, bool slow_down)
    : table_(table), measured_(measured), link_(link), slow_down_(slow_down) {}

void TrajectoryExecutor::subscribe(const ros::NodeHandle& handle) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = false;
  constexpr bool kAutostart = false;
  timer_ = topics.createSteadyTimer(
      ros::WallDuration(seconds(kPeriod)), [this](const ros::SteadyTimerEvent&) { goOn(); }, kOneShot, kAutostart);
  using Message = trajectory_msgs::JointTrajectory;
  const boost::function<void(const Message::ConstPtr&)> on_message = [this](const Message::ConstPtr& message) {
    receive(*message);
  };
  subscriber_ = topics.subscribe<Message>("joint_trajectory", kQueueSize, on_message, ros::VoidConstPtr(),
                                          ros::TransportHints().tcpNoDelay());
}

void TrajectoryExecutor::yieldTo(const joints::JointOrders& orders) {
  if (!running_) {
    return;
  }
  for (const std::size_t index : running_->trajectory.joints()) {
    if (orders.count(table_[index].id) > 0) {
      end(table_[index].name + " was commanded to go elsewhere");
      return;
    }
  }
}

void TrajectoryExecutor::end(const std::string& reason) {
  if (running_) {
    ROS_WARN_STREAM_NAMED("joints", "The trajectory ends early: " << reason << ".");
    running_.reset();
    timer_.stop();
  }
}

void TrajectoryExecutor::receive(const trajectory_msgs::JointTrajectory& message) {
  try {
    if (message.points.empty()) {
      hold();
    } else {
      start(message);
    }
  } catch (const InvalidArgumentException& error) {
    warnings_.warn(error.what());
  } catch (const StoppedException&) {
    return;  // the driver is ending
  } catch (const Exception& error) {
    warnings_.warn(std::string("Trajectory dropped: ") + error.what());
  }
}

void TrajectoryExecutor::start(const trajectory_msgs::JointTrajectory& message) {
  link_.requireDesign();
  const SteadyTime now = std::chrono::steady_clock::now();
  const std::chrono::nanoseconds wait = waitBeforeStart(message.header.stamp, ros::Time::now());
  joints::Trajectory trajectory(toRequest(message), table_, present(now), slow_down_);
  if (trajectory.stretch() > 1) {
    ROS_INFO_STREAM_NAMED("joints", "The trajectory is slowed down " << trajectory.stretch()
                                                                     << " times to keep the joints' speed limits.");
  }
  running_ = Running{std::move(trajectory), joints::TrajectoryClock(now + wait, kPeriod), link_.connection(), false};
  timer_.start();
  goOn();
}

void TrajectoryExecutor::hold() {
  const SteadyTime now = std::chrono::steady_clock::now();
  std::vector<std::size_t> joints;
  std::vector<double> positions;
  for (const joints::Trajectory::Start& joint : present(now)) {
    const bool in_trajectory = running_ && std::count(running_->trajectory.joints().begin(),
                                                      running_->trajectory.joints().end(), joint.joint) > 0;
    const std::optional<joints::MeasuredJoint> measured = measured_.find(joint.joint);
    if (in_trajectory || (measured && std::abs(measured->velocity) > kStanding)) {
      joints.push_back(joint.joint);
      positions.push_back(joint.position);
    }
  }
  running_.reset();
  timer_.stop();
  send(joints, positions, std::chrono::milliseconds(0));
}

void TrajectoryExecutor::goOn() {
  if (!running_) {
    return;
  }
  if (link_.connection() != running_->connection) {
    end("the connection to the robot was lost; it will not be resumed");
    return;
  }
  const joints::Trajectory& trajectory = running_->trajectory;
  const double time = running_->clock.attend(std::chrono::steady_clock::now());
  if (time < 0) {
    return;
  }
  const double left = trajectory.duration() - time;
  if (running_->end_sent && left <= 0) {
    running_.reset();
    timer_.stop();
    return;
  }
  if (running_->end_sent) {
    return;
  }
  const double ahead = std::clamp(left, 0.0, seconds(kLookahead));
  running_->end_sent = left <= ahead;
  try {
    send(trajectory.joints(), trajectory.sample(time + ahead), std::chrono::milliseconds(std::lround(1000 * ahead)));
  } catch (const StoppedException&) {
    running_.reset();
  } catch (const Exception& error) {
    end(error.what());
  }
}

std::vector<joints::Trajectory::Start> TrajectoryExecutor::present(SteadyTime now) const {
  std::vector<joints::Trajectory::Start> joints;
  if (running_) {
    const std::vector<double> positions = running_->trajectory.sample(running_->clock.at(now));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      joints.push_back({running_->trajectory.joints()[i], positions[i]});
    }
  }
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const bool known = std::any_of(joints.begin(), joints.end(),
                                   [i](const joints::Trajectory::Start& joint) { return joint.joint == i; });
    const std::optional<joints::MeasuredJoint> measured = measured_.find(i);
    if (!known && measured) {
      joints.push_back({i, measured->position});
    }
  }
  return joints;
}

void TrajectoryExecutor::send(const std::vector<std::size_t>& joints, const std::vector<double>& positions,
                              std::chrono::milliseconds duration) {
  joints::JointOrders orders;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const joints::JointProperties& joint = table_[joints[i]];
    orders[joint.id] = {std::clamp(positions[i], joint.lowest, joint.highest), table_.speedLimit(joints[i])};
  }
  link_.send(orders, duration);
}

}  // namespace aibo_driver::node
