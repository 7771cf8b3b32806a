/// @file allow.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
#define AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H

#include <QString>
#include <QVariant>
#include <QWidget>

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

/// Why a server of version 1 cannot do what the driver offers; empty if this one is another, or is not known.
inline QString whyNotVersion1(int protocol_version) {
  return protocol_version == 1 ? QString("the robot's RCServer is of version 1, which does not support this")
                               : QString();
}

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ALLOW_H
