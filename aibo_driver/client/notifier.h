/// @file notifier.h
#ifndef AIBO_DRIVER_CLIENT_NOTIFIER_H
#define AIBO_DRIVER_CLIENT_NOTIFIER_H

#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver {

/// Calls the callbacks of the client's user, as far as they are set. An exception from a callback is logged.
class Notifier {
 public:
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

  void ended(const MotionEnd& end) const noexcept { call(callbacks_.on_ended, "on_ended", end); }

  void log(LogLevel level, const std::string& message) const noexcept {
    try {
      if (callbacks_.log) {
        callbacks_.log(level, message);
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
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_NOTIFIER_H
