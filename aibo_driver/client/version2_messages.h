/// @file version2_messages.h
/// What the messages of version 2 mean in the words of this library, and the reverse.
#ifndef AIBO_DRIVER_CLIENT_VERSION2_MESSAGES_H
#define AIBO_DRIVER_CLIENT_VERSION2_MESSAGES_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/status.h"
#include "aibo_client/telemetry.h"
#include "client/command_outbox.h"
#include "client/session.h"
#include "protocol/color_requests.h"
#include "protocol/hello.h"
#include "protocol/version2.h"

namespace aibo_client {

/// The values of the settings. The index of a setting is its id - 1.
std::array<int, protocol::version2::NUMBER_OF_CAMERA_SETTINGS> valuesOf(const CameraSettings& settings);

/// The settings; empty if the robot does not know them all.
std::optional<CameraSettings> settingsIn(const protocol::version2::CameraSettings& values);

/// The layer of a resolution. Both have the same numbers.
protocol::version2::Layer layerOf(Resolution resolution);

RobotInfo robotIn(const protocol::version2::Hello& hello);

/// Makes telemetry of a message, but without the time of arrival.
/// @param design the design of the robot that has measured
Telemetry telemetryIn(const protocol::version2::Telemetry& measured, const std::string& design);

std::vector<JointTarget> targetsIn(const protocol::version2::JointTargets& accepted);
std::vector<LedCommand> ledsIn(const protocol::version2::LedValues& accepted);

/// Makes an end of a message, but without the order's number, because the client has a number of its own for it.
ActivityEnd endIn(const protocol::version2::EndMessage& message);

MotorsAndPosture stateIn(const protocol::version2::MotorsAndPosture& state);

/// What an error message says, or its code if it says nothing.
std::string describe(const protocol::version2::ErrorMessage& message);

protocol::version2::JointTargets targetsOf(const JointCommand& command);
protocol::version2::SpeedLimits limitsOf(const std::vector<JointSpeedLimit>& wanted);
protocol::version2::LedValues ledsOf(const std::vector<LedCommand>& wanted);

/// @param chosen null stands for a table without colours
/// @param index the index of the table
protocol::version2::ColorTable tableOf(const ColorTablePtr& chosen, std::ptrdiff_t index);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION2_MESSAGES_H
