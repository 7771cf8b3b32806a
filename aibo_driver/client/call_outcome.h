/// @file call_outcome.h
#ifndef AIBO_DRIVER_CLIENT_CALL_OUTCOME_H
#define AIBO_DRIVER_CLIENT_CALL_OUTCOME_H

namespace aibo_driver {

/// How a call that waits for the robot's answer has ended. A failure is a value until it has reached the caller's
/// thread, and is thrown there.
enum class CallOutcome { kDone, kTimeout, kRefused, kConnectionLost, kStopped };

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_CALL_OUTCOME_H
