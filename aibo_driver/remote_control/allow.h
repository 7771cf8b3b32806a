/// @file allow.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
#define AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H

#include <QString>
#include <QVariant>
#include <QWidget>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// Enables a widget, or disables it and says why in its tooltip. Its own tooltip comes back when it is enabled.
/// @param why_not empty: enable it
inline void allow(QWidget* widget, const QString& why_not) {
  constexpr const char* kOwnToolTip = "own_tool_tip";
  if (!widget->property(kOwnToolTip).isValid()) {
    widget->setProperty(kOwnToolTip, widget->toolTip());
  }
  widget->setEnabled(why_not.isEmpty());
  widget->setToolTip(why_not.isEmpty() ? widget->property(kOwnToolTip).toString() : "Not now: " + why_not);
}

/// What a part of the window needs from the robot.
enum class Needs {
  kConnection,
  kVersion2,    ///< and a server of version 2
  kNotStopped,  ///< and that it is not stopped: it moves the robot, and switches the motors on
  kMotors,      ///< and that the motors are on, with any server
  kFeet         ///< and that it stands on its feet
};

/// Why the robot cannot do something now; empty if it can, or if nobody knows.
QString whyNot(Needs needs, const RobotConnection& connection, const RobotCondition& condition);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
