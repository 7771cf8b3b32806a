#include "node/camera/stream_meter.h"

#include <algorithm>
#include <utility>

namespace aibo_driver::node {
namespace {

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

StreamMeter::StreamMeter(std::function<SteadyTime()> now) : now_(std::move(now)), last_reading_(now_()) {}

void StreamMeter::add(std::size_t bytes, SteadyTime first_byte_time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double latency = seconds(now_() - first_byte_time);
  ++current_.pictures;
  current_.bytes += bytes;
  current_.max_latency = std::max(current_.max_latency, latency);
  latency_sum_ += latency;
}

StreamMeter::Reading StreamMeter::read(double asked_rate) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const SteadyTime now = now_();
  Reading reading = current_;
  reading.seconds = seconds(now - last_reading_);
  reading.mean_latency = reading.pictures > 0 ? latency_sum_ / static_cast<double>(reading.pictures) : 0.0;
  const double due = std::min(asked_rate, std::exchange(last_asked_rate_, asked_rate));
  slow_for_ = reading.picturesPerSecond() < due / 2 ? slow_for_ + reading.seconds : 0.0;
  reading.slow_for = slow_for_;
  current_ = Reading();
  latency_sum_ = 0.0;
  last_reading_ = now;
  return reading;
}

}  // namespace aibo_driver::node
