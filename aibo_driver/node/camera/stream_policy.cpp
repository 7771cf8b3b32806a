#include "node/camera/stream_policy.h"

#include <utility>

namespace aibo_driver::node {

void StreamPolicy::start(std::function<bool()> has_subscriber, std::function<void(bool)> set_streaming) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_subscriber_ = std::move(has_subscriber);
  set_streaming_ = std::move(set_streaming);
  decide();
}

void StreamPolicy::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_subscriber_ = nullptr;
  set_streaming_ = nullptr;
}

void StreamPolicy::setWanted(bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = wanted;
  decide();
}

bool StreamPolicy::toggleWanted() {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = !wanted_;
  decide();
  return wanted_;
}

void StreamPolicy::subscribersChanged() {
  const std::lock_guard<std::mutex> lock(mutex_);
  decide();
}

bool StreamPolicy::wanted() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_;
}

bool StreamPolicy::waitsForSubscriber() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_ && !demanded();
}

bool StreamPolicy::demanded() const {
  return !on_demand_ || (has_subscriber_ && has_subscriber_());
}

void StreamPolicy::decide() {
  if (set_streaming_) {
    set_streaming_(wanted_ && demanded());
  }
}

}  // namespace aibo_driver::node
