#include "node/robot_stamper.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace aibo_driver::node {
namespace {

// Two clocks can be read in less time than this, unless the thread is interrupted in between.
constexpr std::chrono::microseconds kReadingTime{20};
constexpr int kReadings = 5;

// ros::Time throws if it would become negative or if its seconds would not fit into 32 bits.
ros::Time fromNanoseconds(std::int64_t nanoseconds) {
  constexpr std::int64_t kLast = std::int64_t{std::numeric_limits<std::uint32_t>::max()} * 1000000000;
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::clamp<std::int64_t>(nanoseconds, 0, kLast)));
  return time;
}

}  // namespace

RobotStamper::RobotStamper(robot_time::RobotClock* robot_clock, std::chrono::nanoseconds time_offset,
                           std::function<ros::Time()> ros_now, std::function<SteadyTime()> steady_now)
    : robot_clock_(robot_clock),
      time_offset_(time_offset),
      ros_now_(std::move(ros_now)),
      steady_now_(std::move(steady_now)) {}

RobotStamper::Moment RobotStamper::find(std::uint64_t connection_number, std::optional<std::uint32_t> frame_number,
                                        SteadyTime arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t remembered = std::min(count_, kRemembered);
  for (std::size_t i = 0; i < remembered; ++i) {
    if (latest_[i].arrival == arrival && latest_[i].frame_number == frame_number) {
      return latest_[i].moment;
    }
  }
  Moment moment;
  if (robot_clock_ != nullptr && frame_number) {
    // A frame number that runs too fast must not move the stamp into the future.
    moment.taken = std::min(robot_clock_->timeOf(connection_number, *frame_number, arrival), arrival);
  }
  moment.stamp = toRosTime(moment.taken.value_or(arrival));
  if (count_ > 0) {
    const ros::Time last = latest_[(count_ - 1) % kRemembered].moment.stamp;
    const auto step_back = static_cast<std::int64_t>(last.toNSec() - moment.stamp.toNSec());
    if (step_back >= 0 && step_back <= kClockStep.count()) {
      moment.stamp = last + ros::Duration(0, 1);
    }
  }
  latest_[count_ % kRemembered] = {arrival, frame_number, moment};
  ++count_;
  return moment;
}

ros::Time RobotStamper::toRosTime(SteadyTime time) const {
  std::chrono::nanoseconds shortest = std::chrono::nanoseconds::max();
  std::chrono::nanoseconds age{0};
  ros::Time now;
  for (int i = 0; i < kReadings && shortest > kReadingTime; ++i) {
    const SteadyTime before = steady_now_();
    const ros::Time ros_now = ros_now_();
    const std::chrono::nanoseconds reading_time = steady_now_() - before;
    if (reading_time < shortest) {
      shortest = reading_time;
      age = before + reading_time / 2 - time;
      now = ros_now;
    }
  }
  return fromNanoseconds(static_cast<std::int64_t>(now.toNSec()) - age.count() + time_offset_.count());
}

}  // namespace aibo_driver::node
