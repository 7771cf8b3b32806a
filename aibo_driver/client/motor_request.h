/// @file motor_request.h
#ifndef AIBO_DRIVER_CLIENT_MOTOR_REQUEST_H
#define AIBO_DRIVER_CLIENT_MOTOR_REQUEST_H

#include <chrono>
#include <future>
#include <string>

#include "client/call_outcome.h"

namespace aibo_driver {

/// What RcServerClient::setMotors() waits for.
struct MotorAnswer {
  CallOutcome outcome = CallOutcome::kDone;
  bool on = false;      ///< what the robot says is now the case
  std::string problem;  ///< empty if done
};

/// A call of RcServerClient::setMotors() that is in progress.
struct MotorRequest {
  using Answer = MotorAnswer;

  bool on = false;
  std::chrono::milliseconds timeout{0};            ///< what the caller allowed, for messages
  std::chrono::steady_clock::time_point deadline;  ///< the caller waits no longer
  std::promise<Answer> promise;

  void fail(CallOutcome outcome, const std::string& problem) { promise.set_value({outcome, false, problem}); }
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_MOTOR_REQUEST_H
