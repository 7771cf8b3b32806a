/// @file interruption.h
/// Handles Ctrl-C and SIGTERM. The first signal is only noted, so that a command can end in an orderly way: it stops
/// what it has begun, and completes its files. The second signal ends the program at once. The robot then stops what it
/// does for this client.
#ifndef AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H
#define AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H

#include "aibo_client/exceptions.h"

namespace aibo_driver::command_line {

/// Thrown if a command ends early because of Ctrl-C.
class Interrupted : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// Call this once, before other threads begin.
void noteInterruptions();

/// The first signal that came; 0 if none came.
int interruption();

/// A descriptor that poll() finds readable once a signal has come.
int interruptionDescriptor();

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H
