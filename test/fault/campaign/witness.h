/// @file witness.h
#ifndef TEST_FAULT_CAMPAIGN_WITNESS_H
#define TEST_FAULT_CAMPAIGN_WITNESS_H

#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "support/picture_server.h"
#include "support/test_pictures.h"

namespace fault_bench {

using aibo_client::ConnectionState;

/// Checks what a client delivers against what a PictureServer has sent. The witness must outlive the client, and the
/// server must outlive the witness.
///
/// It complains if a picture is not, byte for byte, one that the server has sent, if a picture comes twice or after a
/// newer one, and if a picture of a connection is missing. When a connection ends, the status must give reason and
/// advice.
class Witness {
 public:
  struct Sighting {
    test_pictures::Name name;
    TimePoint time;  ///< of its delivery
    TimePoint sent;  ///< according to the server
  };

  explicit Witness(const PictureServer& server) : server_(server) {}

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { see(*picture); };
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) { hear(status); };
    return callbacks;
  }

  /// While gaps are allowed, it does not complain about pictures that are left out over one connection.
  void allowGaps(bool allowed) {
    const std::lock_guard<std::mutex> lock(mutex_);
    gaps_allowed_ = allowed;
  }

  /// The last picture; its number is 0 if there was none.
  Sighting last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_;
  }

  /// Waits for a picture that fulfils the condition.
  /// @throw std::runtime_error it did not come
  template <typename Condition>
  Sighting waitFor(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!changed_.wait_for(lock, kSafetyNet, [&] { return last_.name.number > 0 && condition(last_); })) {
      throw std::runtime_error("no picture came any more: " + status_.reason);
    }
    return last_;
  }

  /// Waits until the client has noticed that it is not connected.
  /// @throw std::runtime_error it has not
  void waitForDisconnection() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!changed_.wait_for(lock, kSafetyNet, [&] { return status_.state == ConnectionState::kDisconnected; })) {
      throw std::runtime_error("the client did not notice the end of its connection");
    }
  }

  /// The complaints since the last call.
  std::vector<std::string> takeViolations() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(violations_, {});
  }

 private:
  void hear(const aibo_client::ConnectionStatus& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool has_ended =
        status.state == ConnectionState::kDisconnected && status_.state != ConnectionState::kDisconnected;
    if (has_ended && (status.reason.empty() || status.advice.empty())) {
      violations_.push_back("a connection has ended without reason or advice: '" + status.reason + "'");
    }
    status_ = status;
    changed_.notify_all();
  }

  void see(const aibo_client::Picture& picture) {
    const auto name = test_pictures::nameOf(picture.jpeg);
    const TimePoint sent = name ? server_.timeOf(name->number) : TimePoint();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!name) {
      violations_.emplace_back("a picture that the server never sent");
      return;
    }
    judge(picture, *name);
    last_ = {*name, steady_clock::now(), sent};
    changed_.notify_all();
  }

  void judge(const aibo_client::Picture& picture, const test_pictures::Name& name) {
    const std::uint64_t before = last_.name.number;
    const std::string which = "picture " + std::to_string(name.number) + " after picture " + std::to_string(before);
    if (picture.jpeg != test_pictures::makeNamed(name) || name.number > server_.lastNumber()) {
      violations_.push_back(which + " is not as it was sent");
    }
    if (name.number <= before) {
      violations_.push_back(which);
    }
    if (name.connection == last_.name.connection && name.number > before + 1 && !gaps_allowed_) {
      violations_.push_back(which + " over one connection: some are lost");
    }
  }

  const PictureServer& server_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  Sighting last_;
  bool gaps_allowed_ = false;
  aibo_client::ConnectionStatus status_;
  std::vector<std::string> violations_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_WITNESS_H
