/// @file drive_pad.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVE_PAD_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVE_PAD_H

#include <QTimer>

#include "remote_control/axis_pad.h"

namespace aibo_driver::remote_control {

/// A pad that makes the robot walk while a mouse button is held on it. Up and down walk forward and backward. With the
/// left button, the sides turn; with another button, they step sideways. Releasing the button works like a dead-man's
/// switch: the robot is told once to stop, and then nothing more.
class DrivePad : public AxisPad {
  Q_OBJECT

 public:
  explicit DrivePad(QWidget* parent = nullptr);

 Q_SIGNALS:
  /// Emitted several times a second while the pad is held, and once with zeros when it is released.
  /// @param forward m/s
  /// @param left m/s
  /// @param turn rad/s, counterclockwise
  void walk(double forward, double left, double turn);

 private:
  void send();

  QTimer timer_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVE_PAD_H
