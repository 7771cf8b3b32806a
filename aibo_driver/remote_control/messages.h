/// @file messages.h
/// Converts the driver's messages to what the window shows, and back. Any node may have sent a message.
#ifndef AIBO_DRIVER_REMOTE_CONTROL_MESSAGES_H
#define AIBO_DRIVER_REMOTE_CONTROL_MESSAGES_H

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Touch.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include <string>
#include <vector>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// Shortens the text of a message for display: laying out a megabyte would block the window and its button STOP.
QString fromRos(const std::string& text);

QStringList fromRos(const std::vector<std::string>& texts);

RobotCondition conditionIn(const RobotState& message);

/// The places that are touched.
QStringList touchedPlacesIn(const Touch& message);

/// The movements that have ended between two messages of motion_state. Each message lists the latest movements, with
/// the newest last.
std::vector<EndedMovement> endedBetween(const std::vector<EndedMovement>& before,
                                        const std::vector<EndedMovement>& now);

/// What the user reads about a movement that failed. It is empty if the movement did what it should, or if somebody
/// wanted it to end.
QString complaintAbout(const EndedMovement& ended);

/// The driver's settings in the driver's order. Texts that are not a choice are left out.
QVector<Setting> settingsIn(const dynamic_reconfigure::ConfigDescription& description);

/// The values in force.
SettingValues valuesIn(const dynamic_reconfigure::Config& message);

/// A message that changes one setting.
/// @param value a bool, int, double or QString, depending on the setting
dynamic_reconfigure::Config changeOf(const QString& name, const QVariant& value);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_MESSAGES_H
