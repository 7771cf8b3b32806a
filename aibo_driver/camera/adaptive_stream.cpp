#include "camera/adaptive_stream.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "camera/camera_options.h"

namespace aibo_driver::camera {
namespace {

double seconds(AdaptiveStream::Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// The relative size of a picture of the simulated room; a picture at quality 85 has size 1. The size need not be
/// exact: if a step is not low enough, another one follows.
double sizeAt(int quality) {
  constexpr std::pair<int, double> kSizes[] = {{1, 0.2}, {50, 0.5}, {65, 0.63}, {75, 0.76}, {85, 1}, {95, 2}, {100, 4}};
  const auto above = std::find_if(std::next(std::begin(kSizes)), std::prev(std::end(kSizes)),
                                  [quality](const auto& size) { return quality <= size.first; });
  const auto& [low_quality, low_size] = *std::prev(above);
  return low_size + (above->second - low_size) * (quality - low_quality) / (above->first - low_quality);
}

double loadOf(const AdaptiveStream::Step& step) {
  return sizeAt(step.jpeg_quality) / step.every_nth_image;
}

/// When the link is full, we ask for this part of what it carries. The rest lets the data in the robot's buffers get
/// through.
constexpr double kPartOfFullLink = 0.95;

// In less time than this, the share of late pictures says little.
constexpr std::chrono::milliseconds kHalfASecond{500};

/// The link is full if less than this part of the pictures that we ask for arrives.
constexpr double kFull = 0.85;

/// One change keeps at least this part of the load, because a link that paused for a moment has carried little.
constexpr double kLeastLeft = 0.5;

}  // namespace

AdaptiveStream::AdaptiveStream(const Step& best, Duration max_age) : max_age_(max_age) {
  constexpr int kQualityStep = 10;
  const auto add = [this](const Step& step) { steps_.push_back({step, loadOf(step), kFirstWait}); };
  add(best);
  while (steps_.back().step.jpeg_quality > kLowestQuality) {
    const int lower = std::max(kLowestQuality, steps_.back().step.jpeg_quality - kQualityStep);
    add({lower, best.every_nth_image});
  }
  while (steps_.back().step.every_nth_image < kRarestImage) {
    const int rarer = steps_.back().step.every_nth_image;
    add({steps_.back().step.jpeg_quality, std::min(kRarestImage, rarer + (rarer + 1) / 2)});
  }
}

std::optional<AdaptiveStream::Step> AdaptiveStream::pictureArrived(SteadyTime now, Duration age) {
  if (current_ != 0 && now - *changed_at_ < kSettling) {
    return std::nullopt;
  }
  arrivals_.push_back({now, age});
  while (now - arrivals_.front().time > kCalmTime || arrivals_.size() > kMostArrivals) {
    arrivals_.pop_front();
  }
  if (mustLower(now)) {
    if (raised_at_ && now - *raised_at_ < kTrial) {
      Duration& wait = steps_[current_].wait;
      wait = std::min<Duration>(2 * wait, kLongestWait);
    }
    change(lowerStep(now), now);
    raised_at_.reset();
    return inForce();
  }
  if (mayRaise(now)) {
    change(current_ - 1, now);
    raised_at_ = now;
    return inForce();
  }
  return std::nullopt;
}

bool AdaptiveStream::isLate(const Arrival& arrival) const {
  return seconds(arrival.age) > kLate * seconds(max_age_);
}

AdaptiveStream::Arrivals::const_iterator AdaptiveStream::lastSecond(SteadyTime now) const {
  return std::find_if(arrivals_.begin(), arrivals_.end(),
                      [now](const Arrival& arrival) { return now - arrival.time <= std::chrono::seconds(1); });
}

bool AdaptiveStream::mustLower(SteadyTime now) const {
  if (current_ + 1 == steps_.size()) {
    return false;
  }
  const auto late = [this](const Arrival& arrival) { return isLate(arrival); };
  const auto run = std::find_if_not(arrivals_.rbegin(), arrivals_.rend(), late).base();
  if (std::distance(run, arrivals_.end()) >= kFewestLate && now - run->time >= kPatience) {
    return true;
  }
  const auto recent = lastSecond(now);
  const auto late_ones = std::count_if(recent, arrivals_.end(), late);
  return late_ones >= kFewestLate && 3 * late_ones >= std::distance(recent, arrivals_.end()) &&
         now - recent->time >= kHalfASecond;
}

bool AdaptiveStream::mayRaise(SteadyTime now) const {
  return current_ > 0 && now - *changed_at_ >= std::max<Duration>(steps_[current_ - 1].wait, kCalmTime) &&
         std::all_of(arrivals_.begin(), arrivals_.end(),
                     [this](const Arrival& arrival) { return seconds(arrival.age) <= kCalm * seconds(max_age_); });
}

std::size_t AdaptiveStream::lowerStep(SteadyTime now) const {
  const Rung& present = steps_[current_];
  const auto recent = lastSecond(now);
  const auto intervals = static_cast<double>(std::distance(recent, arrivals_.end()) - 1);
  const double share = intervals / seconds(now - recent->time) / frameRateOf(present.step.every_nth_image);
  std::size_t to = current_ + 1;
  if (share < kFull) {
    const double carried = std::max(kLeastLeft, kPartOfFullLink * share) * present.load;
    while (to + 1 < steps_.size() && steps_[to].load > carried) {
      ++to;
    }
  }
  return to;
}

void AdaptiveStream::change(std::size_t to, SteadyTime now) {
  current_ = to;
  changed_at_ = now;
  arrivals_.clear();
}

}  // namespace aibo_driver::camera
