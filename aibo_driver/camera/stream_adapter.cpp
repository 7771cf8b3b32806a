#include "camera/stream_adapter.h"

#include <utility>

#include "camera/camera_options.h"
#include "text/sentence.h"

namespace aibo_driver::camera {
namespace {

std::string rateOf(int every_nth_image) {
  return text::decimal(frameRateOf(every_nth_image), 1);
}

int inMilliseconds(double seconds) {
  return static_cast<int>(1000 * seconds);
}

}  // namespace

StreamAdapter::StreamAdapter(aibo_client::RcServerClient& client, aibo_client::LogSink log)
    : client_(client), log_(std::move(log)) {}

void StreamAdapter::setWish(const Wish& wish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (wish_ && *wish_ == wish) {
    return;
  }
  wish_ = wish;
  has_said_why_not_ = false;
  const AdaptiveStream::Step best{wish.jpeg_quality, wish.format.every_nth_image};
  stream_.reset();
  if (wish.adaptive) {
    const std::chrono::duration<double> max_age(wish.max_picture_age);
    stream_.emplace(best, std::chrono::duration_cast<AdaptiveStream::Duration>(max_age));
  }
  ask(best);
}

void StreamAdapter::picturePublished(SteadyTime now, std::optional<SteadyTime> taken) {
  if (taken) {
    const std::string change = adapt(now, *taken);
    if (!change.empty()) {
      changes_.warn(change);
    }
  } else if (mustSayWhyNot()) {
    log_(aibo_client::LogLevel::kWarn,
         "adaptive has no effect: the age of the pictures is not known. It needs a robot that speaks version 2, and "
         "use_robot_time.");
  }
}

// Returns a sentence about how the stream has changed; empty if it has not.
std::string StreamAdapter::adapt(SteadyTime now, SteadyTime taken) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto step = stream_ ? stream_->pictureArrived(now, now - taken) : std::nullopt;
  if (!step) {
    return "";
  }
  ask(*step);
  const double age = std::chrono::duration<double>(now - taken).count();
  return "Adaptive: the last picture is " + std::to_string(inMilliseconds(age)) + " ms old, and at most " +
         std::to_string(inMilliseconds(wish_->max_picture_age)) + " ms are allowed: the stream is " + describeStep() +
         ".";
}

// True once for each wish.
bool StreamAdapter::mustSayWhyNot() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stream_ && !std::exchange(has_said_why_not_, true);
}

int StreamAdapter::wishedQuality() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wish_ ? wish_->jpeg_quality : client_.jpegQuality();
}

std::string StreamAdapter::describe() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stream_ ? describeStep() : "off";
}

void StreamAdapter::ask(const AdaptiveStream::Step& step) {
  client_.setJpegQuality(step.jpeg_quality);
  client_.setStreamFormat({wish_->format.resolution, step.every_nth_image});
}

std::string StreamAdapter::describeStep() const {
  if (!stream_->isLowered()) {
    return "not lowered";
  }
  const AdaptiveStream::Step& step = stream_->inForce();
  return "lowered to quality " + std::to_string(step.jpeg_quality) + " of " + std::to_string(wish_->jpeg_quality) +
         " and " + rateOf(step.every_nth_image) + " of " + rateOf(wish_->format.every_nth_image) + " pictures/s";
}

}  // namespace aibo_driver::camera
