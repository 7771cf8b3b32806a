/// @file console_commands.h
/// The commands of the simulated robot's console.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H

#include <optional>
#include <string>

#include "simulator/ers7/simulated_ers7.h"

namespace simulated_ers7 {

/// Executes one line; `help` lists the commands. `where` answers "ok: where 0.1234 -0.0450 1.5708": x and y in metres
/// and yaw in radians from -pi to pi, in the frame of scene.h. stick_slot.h describes the states of `stick`.
/// @return complete lines: a confirmation or an error; no value if there is no such command
std::optional<std::string> obeyConsole(SimulatedErs7& robot, const std::string& line);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
