/// @file interruption.h
/// Ctrl-C, and SIGTERM. The first one is noted, so that a command can end in an orderly way: what it has begun is
/// stopped, and files are whole. The second one ends the program at once; the robot then stops what it does for this
/// client.
#ifndef AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H
#define AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H

#include "aibo_driver/exceptions.h"

namespace aibo_driver::command_line {

/// A command ends early because of Ctrl-C.
class Interrupted : public Exception {
 public:
  using Exception::Exception;
};

/// To be called once, before other threads begin.
void noteInterruptions();

/// The signal that came first; 0 if none came.
int interruption();

/// Readable by poll() once a signal came.
int interruptionDescriptor();

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_INTERRUPTION_H
