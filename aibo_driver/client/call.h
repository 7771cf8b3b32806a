/// @file call.h
#ifndef AIBO_DRIVER_CLIENT_CALL_H
#define AIBO_DRIVER_CLIENT_CALL_H

#include <chrono>
#include <cstdint>
#include <future>
#include <string>
#include <vector>

#include "client/call_outcome.h"

namespace aibo_driver {

/// What a RobotRequest waits for.
struct RobotAnswer {
  CallOutcome outcome = CallOutcome::kDone;
  std::string problem;             ///< empty if done
  bool motors_on = false;          ///< answers `O`: what is now the case
  std::vector<std::string> names;  ///< answers `N`: of the motions
};

/// Something that the robot is asked to do once, and a call that waits until it has: motors, motions, shutting down.
/// (Pictures and commands have rules of their own.)
struct RobotRequest {
  using Answer = RobotAnswer;
  using Bytes = std::vector<std::uint8_t>;

  char letter = 0;   ///< the same in both versions of the protocol
  std::string name;  ///< of a motion; `P` alone may go without
  int number = 0;    ///< `O`: 1 = on, 0 = off; `P`: repetitions, 0 = stop
  Bytes content;     ///< of the motion that is to be uploaded

  std::chrono::milliseconds timeout{0};            ///< what the caller allowed, for messages
  std::chrono::steady_clock::time_point deadline;  ///< the caller waits no longer
  std::promise<Answer> promise;

  void answer(const Answer& answer) { promise.set_value(answer); }
  void fail(CallOutcome outcome, const std::string& problem) { promise.set_value({outcome, problem, false, {}}); }
};

/// What is asked for, in words that follow "refused to ".
std::string describe(const RobotRequest& request);

/// What an error code of version 1 means in answer to this request, and what the user can do.
std::string explainRefusal(const RobotRequest& request, int code);

/// True if it decides where joints are from then on, as a motion does and the motors' switch: what they were told
/// before counts no more.
bool takesOverJoints(const RobotRequest& request);

/// True if version 1 of the protocol has this request.
bool isKnownToVersion1(const RobotRequest& request);

/// The whole request, of version 1.
RobotRequest::Bytes encodeForVersion1(const RobotRequest& request);

/// The payload of the request, of version 2.
RobotRequest::Bytes encodeForVersion2(const RobotRequest& request);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CALL_H
