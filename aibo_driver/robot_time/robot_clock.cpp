#include "robot_time/robot_clock.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::robot_time {
namespace {

constexpr double kFramePeriod = 0.008;  // s

// The time in which most of a correction happens, so that a correction of 10 ms changes the interval of two pictures by
// less than 0.2 ms. It must exceed kImplausible, the greatest correction.
constexpr double kSmoothing = 2.0;  // s

// A message that is off by more is not just delayed: a robot that streams sends nothing that old.
constexpr double kImplausible = 1.0;  // s

// Messages of one connection come in the order in which they were sent. But a picture has an older frame, because
// encoding takes time.
constexpr std::int32_t kFramesOfDisorder = 125;

// How long the radio may delay messages. A robot's frame numbers never stop, but those of a simulation may.
constexpr std::chrono::seconds kPatience{5};

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

RobotClock::SteadyTime RobotClock::timeOf(std::uint64_t connection_number, std::uint32_t frame_number,
                                          SteadyTime arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (connection_number < connection_number_) {
    return arrival;  // the frame's timeline may have ended
  }
  const auto frames_passed = static_cast<std::int32_t>(frame_number - newest_frame_);
  double passed = kFramePeriod * frames_passed;
  double sent = newest_ + passed;
  double lateness = seconds(arrival - begin_) - sent;
  if (beginsTimeline(connection_number, frames_passed, lateness - floor_.at(sent), arrival)) {
    begin(frame_number, arrival);
    passed = sent = lateness = 0;
  }
  connection_number_ = connection_number;
  floor_.add(sent, lateness);
  count(lateness - floor_.at(sent));
  if (passed > 0) {
    advance(frame_number, passed, lateness);
  }
  return begin_ + std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(sent + lateness_));
}

bool RobotClock::beginsTimeline(std::uint64_t connection_number, std::int32_t frames_passed, double delay,
                                SteadyTime arrival) {
  const bool reconnected = connection_number != connection_number_;
  if (current_.timelines == 0 || frames_passed < (reconnected ? 0 : -kFramesOfDisorder) || delay < -kImplausible) {
    return true;
  }
  if (delay <= kImplausible) {
    last_in_time_ = arrival;
    return false;
  }
  return reconnected || arrival - last_in_time_ > kPatience;
}

void RobotClock::begin(std::uint32_t frame_number, SteadyTime arrival) {
  begin_ = last_in_time_ = arrival;
  newest_frame_ = frame_number;
  newest_ = lateness_ = 0;
  floor_ = DelayFloor();
  ++current_.timelines;
}

void RobotClock::advance(std::uint32_t frame_number, double passed, double lateness) {
  newest_frame_ = frame_number;
  newest_ += passed;
  const double slowest = lateness_ - passed / 2;
  const double even = lateness_ + floor_.drift() * passed;
  const double smooth = even + (floor_.at(newest_) - even) * -std::expm1(-passed / kSmoothing);
  lateness_ = std::max(slowest, std::min(smooth, lateness));
}

void RobotClock::count(double delay) {
  ++current_.messages;
  delay_sum_ += delay;
  current_.longest_delay = std::max(current_.longest_delay, delay);
}

RobotClock::Reading RobotClock::read() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Reading reading = current_;
  reading.drift = floor_.drift();
  reading.mean_delay = reading.messages > 0 ? delay_sum_ / static_cast<double>(reading.messages) : 0;
  current_ = Reading();
  current_.timelines = reading.timelines;
  delay_sum_ = 0;
  return reading;
}

}  // namespace aibo_driver::robot_time
