/// @file head_pad.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_HEAD_PAD_H
#define AIBO_DRIVER_REMOTE_CONTROL_HEAD_PAD_H

#include "movement/joint_table.h"
#include "remote_control/axis_pad.h"
#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// A pad that points the head: to the sides with head_pan, up and down with head_tilt. Its mark shows where the head
/// is.
class HeadPad : public AxisPad {
  Q_OBJECT

 public:
  explicit HeadPad(QWidget* parent = nullptr);

  /// Uses the limits of this robot. It does nothing if the robot is not known.
  void setDesign(const QString& design);

  void showPositions(const JointPositions& positions);

 Q_SIGNALS:
  /// Emitted when somebody points the head to these positions.
  void pointed(const aibo_driver::remote_control::JointPositions& positions);

 private:
  movement::JointProperties pan_;
  movement::JointProperties tilt_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_HEAD_PAD_H
