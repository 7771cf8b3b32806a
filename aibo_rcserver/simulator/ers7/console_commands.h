/// @file console_commands.h
/// What can be done to the simulated robot by typing at its console.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H

#include <string>

#include "simulator/ers7/simulated_ers7.h"

namespace simulated_ers7 {

/// Obeys one line:
///
///     press BUTTON      somebody presses the pause button or a switch, or touches a touch sensor
///     release BUTTON    and no longer does
///     battery PERCENT   what is left in the battery
///     jam JOINT         something holds a joint fast
///     free JOINT        and no longer does
///     help              says this
///
/// @return the answer, one or more whole lines: what has been done, or what was wrong and what there is; nothing for an
///         empty line
std::string obeyConsole(SimulatedErs7& robot, const std::string& line);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
