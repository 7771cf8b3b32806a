/// @file notifier.h
#ifndef AIBO_DRIVER_CLIENT_NOTIFIER_H
#define AIBO_DRIVER_CLIENT_NOTIFIER_H

#include <chrono>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "client/rate_limit.h"

namespace aibo_driver {

/// Calls the callbacks of the client's user, as far as they are set. An exception from a callback is logged. Nearly
/// everything that is logged can be caused by what the robot sends, so there is a limit for all of it: a robot cannot
/// fill the disk.
class Notifier {
 public:
  /// So many lines may be logged at once, in the long run one per kLogPeriod.
  static constexpr int kLogBurst = 20;
  static constexpr std::chrono::seconds kLogPeriod{1};

  explicit Notifier(RcServerClient::Callbacks callbacks) : callbacks_(std::move(callbacks)) {}

  void picture(const PicturePtr& picture) const noexcept { call(callbacks_.on_picture, "on_picture", picture); }
  void status(const ConnectionStatus& status) const noexcept { call(callbacks_.on_status, "on_status", status); }
  void streaming(bool streaming) const noexcept { call(callbacks_.on_streaming, "on_streaming", streaming); }
  void telemetry(const Telemetry& telemetry) const noexcept {
    call(callbacks_.on_telemetry, "on_telemetry", telemetry);
  }
  void jointsAccepted(const std::vector<JointTarget>& targets) const noexcept {
    call(callbacks_.on_joints_accepted, "on_joints_accepted", targets);
  }

  void ledsAccepted(const std::vector<LedCommand>& leds) const noexcept {
    call(callbacks_.on_leds_accepted, "on_leds_accepted", leds);
  }

  void steered(const WalkVelocity& in_force) const noexcept { call(callbacks_.on_steered, "on_steered", in_force); }

  void ended(const MotionEnd& end) const noexcept { call(callbacks_.on_ended, "on_ended", end); }

  /// @return false if nobody wants to know
  bool refused(const Refusal& refusal) const noexcept {
    call(callbacks_.on_refused, "on_refused", refusal);
    return callbacks_.on_refused != nullptr;
  }

  void lateAnswer(const LateAnswer& answer) const noexcept {
    call(callbacks_.on_late_answer, "on_late_answer", answer);
  }

  void motorsAndPosture(const MotorsAndPosture& state) const noexcept {
    call(callbacks_.on_motors_and_posture, "on_motors_and_posture", state);
  }

  void colors(const DetectedColors& colors) const noexcept { call(callbacks_.on_colors, "on_colors", colors); }

  void log(LogLevel level, const std::string& message) const noexcept {
    try {
      const RateLimit::Admission admission = log_limit_.admit(RateLimit::TimePoint::clock::now(), kLogPeriod);
      const std::string left_out = std::to_string(admission.left_out);
      if (!callbacks_.log) {
        return;
      }
      if (!admission.is_admitted && admission.left_out == 1) {
        callbacks_.log(LogLevel::kWarn, "More messages come than can be logged; some are left out, and counted.");
      } else if (admission.is_admitted) {
        callbacks_.log(level, admission.left_out == 0 ? message : message + " (" + left_out + " before it left out)");
      }
    } catch (...) {  // there is nothing left to report it to
    }
  }

 private:
  template <typename Callback, typename Argument>
  void call(const Callback& callback, const char* name, const Argument& argument) const noexcept {
    try {
      if (callback) {
        callback(argument);
      }
    } catch (const std::exception& error) {
      log(LogLevel::kError, std::string("The callback ") + name + " threw an exception: " + error.what());
    }
  }

  RcServerClient::Callbacks callbacks_;
  mutable RateLimit log_limit_{kLogBurst};
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_NOTIFIER_H
