#include "campaign/witness.h"

#include <stdexcept>
#include <utility>

using aibo_client::ConnectionState;
using aibo_client::ConnectionStatus;
using aibo_client::Picture;
using aibo_client::PicturePtr;

namespace fault_bench {

aibo_client::Callbacks Witness::callbacks() {
  aibo_client::Callbacks callbacks;
  callbacks.on_picture = [this](const PicturePtr& picture) { see(*picture); };
  callbacks.on_status = [this](const ConnectionStatus& status) { hear(status); };
  return callbacks;
}

void Witness::hear(const ConnectionStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool has_ended =
      status.state == ConnectionState::kDisconnected && status_.state != ConnectionState::kDisconnected;
  if (has_ended && (status.reason.empty() || status.advice.empty())) {
    violations_.push_back("a connection has ended without reason or advice: '" + status.reason + "'");
  }
  status_ = status;
  changed_.notify_all();
}

void Witness::see(const Picture& picture) {
  const auto name = test_pictures::nameOf(picture.jpeg);
  const TimePoint sent = name ? server_.timeOf(name->number) : TimePoint();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!name) {
    violations_.emplace_back("a picture that the server never sent");
    return;
  }
  const Sighting sighting = {*name, steady_clock::now(), sent};
  judge(picture, sighting);
  last_ = sighting;
  changed_.notify_all();
}

void Witness::judge(const Picture& picture, const Sighting& sighting) {
  const std::uint64_t number = sighting.name.number;
  const std::uint64_t before = last_.name.number;
  const std::string which = "picture " + std::to_string(number) + " after picture " + std::to_string(before);
  if (picture.jpeg != test_pictures::makeNamed(sighting.name) || number > server_.lastNumber()) {
    violations_.push_back(which + " is not as it was sent");
  }
  if (number <= before) {
    violations_.push_back(which);
  }
  if (sighting.name.connection == last_.name.connection && number > before + 1 && !gaps_allowed_) {
    violations_.push_back(which + " over one connection: some are lost");
  }
}

void Witness::allowGaps(bool allowed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gaps_allowed_ = allowed;
}

Witness::Sighting Witness::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

Witness::Sighting Witness::waitFor(const std::function<bool(const Sighting&)>& condition) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, kSafetyNet, [&] { return last_.name.number > 0 && condition(last_); })) {
    throw std::runtime_error("no picture came any more: " + status_.reason);
  }
  return last_;
}

void Witness::waitForDisconnection() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!changed_.wait_for(lock, kSafetyNet, [&] { return status_.state == ConnectionState::kDisconnected; })) {
    throw std::runtime_error("the client did not notice the end of its connection");
  }
}

std::vector<std::string> Witness::takeViolations() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(violations_, {});
}

}  // namespace fault_bench
