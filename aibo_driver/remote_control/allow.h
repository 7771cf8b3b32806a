/// @file allow.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
#define AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H

#include <QString>
#include <QVariant>
#include <QWidget>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// Enables a widget, or disables it and says why in its tooltip. When the widget is enabled, its own tooltip comes
/// back.
/// @param why_not the reason; empty enables the widget
inline void allow(QWidget* widget, const QString& why_not) {
  constexpr const char* kOwnToolTip = "own_tool_tip";
  if (!widget->property(kOwnToolTip).isValid()) {
    widget->setProperty(kOwnToolTip, widget->toolTip());
  }
  widget->setEnabled(why_not.isEmpty());
  widget->setToolTip(why_not.isEmpty() ? widget->property(kOwnToolTip).toString() : "Not now: " + why_not);
}

/// What a part of the window needs from the robot. Each need includes those above it, but kMotors does not need a
/// server of version 2.
enum class Needs {
  kConnection,
  kVersion2,    ///< a server of version 2
  kNotStopped,  ///< the robot must not be stopped: the part moves it or switches the motors on
  kMotors,      ///< the motors must be on, with any server
  kFeet         ///< the robot must stand on its feet
};

/// Why the robot cannot do something now. It is empty if the robot can do it, or if nobody knows.
QString whyNot(Needs needs, const RobotConnection& connection, const RobotCondition& condition);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
