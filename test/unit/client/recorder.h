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

/// What a client has reported through its callbacks.
struct Reports {
  std::vector<aibo_client::PicturePtr> pictures;
  std::vector<aibo_client::ConnectionStatus> statuses;
  std::vector<bool> streaming;
  std::vector<aibo_client::Telemetry> telemetry;
  std::string orders;      ///< that were refused, and why, as in "7:too old; "
  std::string sound_ends;  ///< such as "1 lost"
  std::vector<std::string> log;
};

/// Keeps what a client reports, and waits for it. Must outlive the client.
class Recorder {
 public:
  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) {
      change([&] { reports_.pictures.push_back(picture); });
    };
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) {
      change([&] { reports_.statuses.push_back(status); });
    };
    callbacks.on_streaming = [this](bool streaming) { change([&] { reports_.streaming.push_back(streaming); }); };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) {
      change([&] { reports_.telemetry.push_back(telemetry); });
    };
    callbacks.on_refused = [this](const aibo_client::Refusal& refusal) {
      change([&] { reports_.orders += std::to_string(refusal.order) + ":" + refusal.reason + "; "; });
    };
    callbacks.on_sound_ended = [this](const aibo_client::SoundEnd& end) {
      change([&] {
        reports_.sound_ends +=
            std::to_string(end.sound) + (end.how == aibo_client::EndedHow::kLost ? " lost" : " ended");
      });
    };
    callbacks.log = [this](aibo_client::LogLevel, const std::string& line) {
      change([&] { reports_.log.push_back(line); });
    };
    return callbacks;
  }

  /// Waits until the last status is this one.
  /// @return false if it is not within a generous time
  bool waitForState(aibo_client::ConnectionState state) {
    return waitFor([this, state] { return !reports_.statuses.empty() && reports_.statuses.back().state == state; });
  }

  /// What was reported so far.
  Reports reports() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return reports_;
  }

  /// Lines logged that contain this text.
  long logged(const std::string& text) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::count_if(reports_.log.begin(), reports_.log.end(),
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
  Reports reports_;
};

#endif  // TEST_UNIT_CLIENT_RECORDER_H
