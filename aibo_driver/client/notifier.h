/// @file notifier.h
#ifndef AIBO_DRIVER_CLIENT_NOTIFIER_H
#define AIBO_DRIVER_CLIENT_NOTIFIER_H

#include <chrono>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/callbacks.h"
#include "client/rate_limit.h"

namespace aibo_client {

/// Calls the callbacks of the client's user if they are set. It logs exceptions that callbacks throw. The robot can
/// cause nearly everything that is logged, so all of it is limited. Otherwise a robot could fill the disk.
class Notifier {
 public:
  /// At most this many lines may be logged at once. In the long run it is one per kLogPeriod.
  static constexpr int kLogBurst = 20;
  static constexpr std::chrono::seconds kLogPeriod{1};

  using Clock = std::function<RateLimit::TimePoint()>;

  explicit Notifier(Callbacks callbacks, Clock clock = RateLimit::TimePoint::clock::now)
      : callbacks_(std::move(callbacks)), clock_(std::move(clock)) {}

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

  void steered(const WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk) const noexcept {
    call(callbacks_.on_steered, "on_steered", in_force, order, walk);
  }

  void ended(const ActivityEnd& end) const noexcept { call(callbacks_.on_ended, "on_ended", end); }

  void refused(const Refusal& refusal) const noexcept { call(callbacks_.on_refused, "on_refused", refusal); }

  void motorsAndPosture(const MotorsAndPosture& state) const noexcept {
    call(callbacks_.on_motors_and_posture, "on_motors_and_posture", state);
  }

  void colors(const DetectedColors& colors) const noexcept { call(callbacks_.on_colors, "on_colors", colors); }

  void heard(const HeardSound& sound) const noexcept { call(callbacks_.on_heard, "on_heard", sound); }

  void soundEnded(const SoundEnd& end) const noexcept { call(callbacks_.on_sound_ended, "on_sound_ended", end); }

  void awake() const noexcept { call(callbacks_.on_awake, "on_awake"); }

  void log(LogLevel level, const std::string& message) const noexcept {
    try {
      const RateLimit::Admission admission = log_limit_.admit(clock_(), kLogPeriod);
      const std::string left_out = std::to_string(admission.left_out);
      if (!callbacks_.log) {
        return;
      }
      if (!admission.is_admitted && admission.left_out == 1) {
        callbacks_.log(LogLevel::kWarn, "There are more messages than can be logged. Some are left out and counted.");
      } else if (admission.is_admitted) {
        callbacks_.log(level,
                       admission.left_out == 0 ? message : message + " (earlier messages left out: " + left_out + ")");
      }
    } catch (...) {  // there is nobody left to report it to
    }
  }

 private:
  template <typename Callback, typename... Arguments>
  void call(const Callback& callback, const char* name, const Arguments&... arguments) const noexcept {
    try {
      if (callback) {
        callback(arguments...);
      }
    } catch (const std::exception& error) {
      log(LogLevel::kError, std::string("The callback ") + name + " threw an exception: " + error.what());
    }
  }

  Callbacks callbacks_;
  Clock clock_;
  mutable RateLimit log_limit_{kLogBurst};
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_NOTIFIER_H
