/// @file console_commands.h
/// Commands that can be typed at the simulated robot's console.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H

#include <optional>
#include <string>

#include "simulator/ers7/simulated_ers7.h"

namespace simulated_ers7 {

/// Executes one line:
///
///     press BUTTON      presses the pause button or a switch, or touches a touch sensor
///     release BUTTON    releases it
///     battery PERCENT   sets the remaining charge
///     jam JOINT         blocks a joint
///     free JOINT        unblocks it
///     lift on|off       lifts the robot from the floor, or sets it down
///     lie SIDE          lets it fall on its left, right or back, or puts it back on its feet
///     stick STATE       makes the memory stick ready, full, locked, out or slow (stick_slot.h)
///     where             tells where it really is, "ok: where 0.1234 -0.0450 1.5708": x and y in metres, and yaw in
///                       radian from -pi to pi, in the frame of scene.h
///     help              prints this list
///
/// @return the answer in one or more complete lines: a confirmation, or an error; none if the line is none of these
std::optional<std::string> obeyConsole(SimulatedErs7& robot, const std::string& line);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CONSOLE_COMMANDS_H
