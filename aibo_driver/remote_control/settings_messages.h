/// @file settings_messages.h
/// Converts messages of dynamic_reconfigure to settings of the window, and back.
#ifndef AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_MESSAGES_H
#define AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_MESSAGES_H

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// The driver's settings in the driver's order. Texts that are not a choice are left out.
QVector<Setting> settingsIn(const dynamic_reconfigure::ConfigDescription& description);

/// The values in force.
SettingValues valuesIn(const dynamic_reconfigure::Config& message);

/// A message that changes one setting.
/// @param value a bool, int, double or QString, depending on the setting
dynamic_reconfigure::Config changeOf(const QString& name, const QVariant& value);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_MESSAGES_H
