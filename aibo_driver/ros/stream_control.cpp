#include "stream_control.h"

#include <utility>

namespace aibo_driver {

StreamControl::StreamControl(bool wanted, bool on_demand, std::function<bool()> has_subscriber,
                             std::function<void(bool)> set_streaming)
    : on_demand_(on_demand),
      has_subscriber_(std::move(has_subscriber)),
      set_streaming_(std::move(set_streaming)),
      wanted_(wanted) {}

void StreamControl::start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_ = true;
  decide();
}

void StreamControl::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_ = false;
}

void StreamControl::setWanted(bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = wanted;
  decide();
}

bool StreamControl::toggleWanted() {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = !wanted_;
  decide();
  return wanted_;
}

void StreamControl::subscribersChanged() {
  const std::lock_guard<std::mutex> lock(mutex_);
  decide();
}

bool StreamControl::wanted() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_;
}

bool StreamControl::waitsForSubscriber() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_ && !demanded();
}

bool StreamControl::demanded() const {
  return !on_demand_ || has_subscriber_();
}

void StreamControl::decide() {
  if (started_) {
    set_streaming_(wanted_ && demanded());
  }
}

}  // namespace aibo_driver
