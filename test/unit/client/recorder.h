/// @file recorder.h
#ifndef TEST_UNIT_CLIENT_RECORDER_H
#define TEST_UNIT_CLIENT_RECORDER_H

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "support/safety_net.h"

/// Keeps what a client reports through its callbacks, and waits for it. Must outlive the client.
class Recorder {
 public:
  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) {
      change([&] { pictures_.push_back(picture); });
    };
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) {
      change([&] { statuses_.push_back(status); });
    };
    callbacks.on_streaming = [this](bool streaming) { change([&] { streaming_.push_back(streaming); }); };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) {
      change([&] { telemetry_.push_back(telemetry); });
    };
    callbacks.on_refused = [this](const aibo_client::Refusal& refusal) {
      change([&] { orders_ += std::to_string(refusal.order) + ":" + refusal.reason + "; "; });
    };
    callbacks.on_sound_ended = [this](const aibo_client::SoundEnd& end) {
      change([&] {
        sound_ends_ += std::to_string(end.sound) + (end.how == aibo_client::EndedHow::kLost ? " lost" : " ended");
      });
    };
    callbacks.log = [this](aibo_client::LogLevel, const std::string& line) { change([&] { log_.push_back(line); }); };
    return callbacks;
  }

  /// Waits until the last status is this one.
  /// @return false if it is not within a generous time
  bool waitForState(aibo_client::ConnectionState state) {
    return waitFor([this, state] { return !statuses_.empty() && statuses_.back().state == state; });
  }

  /// Waits until some status had a reason that contains this text.
  bool waitForReason(const std::string& text) {
    return waitFor([this, &text] {
      return std::any_of(statuses_.begin(), statuses_.end(), [&text](const aibo_client::ConnectionStatus& status) {
        return status.reason.find(text) != std::string::npos && !status.advice.empty();
      });
    });
  }

  bool waitForTelemetry(std::size_t count) {
    return waitFor([this, count] { return telemetry_.size() >= count; });
  }

  /// Waits until the ends of sounds so far are these, such as "1 lost".
  bool waitForSoundEnds(const std::string& ends) {
    return waitFor([&] { return sound_ends_ == ends; });
  }

  bool waitForStreaming(const std::vector<bool>& history) {
    return waitFor([this, &history] { return streaming_ == history; });
  }

  std::vector<aibo_client::PicturePtr> pictures() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pictures_;
  }

  std::vector<aibo_client::Telemetry> telemetry() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return telemetry_;
  }

  /// Orders that were refused, and why, as in "7:too old; ".
  std::string orders() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return orders_;
  }

  /// Lines logged that contain this text.
  long logged(const std::string& text) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::count_if(log_.begin(), log_.end(),
                         [&text](const std::string& line) { return line.find(text) != std::string::npos; });
  }

 private:
  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    changed_.notify_all();
  }

  template <typename Condition>
  bool waitFor(const Condition& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, test_support::kSafetyNet, condition);
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<aibo_client::PicturePtr> pictures_;
  std::vector<aibo_client::ConnectionStatus> statuses_;
  std::vector<bool> streaming_;
  std::vector<aibo_client::Telemetry> telemetry_;
  std::string orders_;
  std::string sound_ends_;
  std::vector<std::string> log_;
};

#endif  // TEST_UNIT_CLIENT_RECORDER_H
