/// @file move_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_MOVE_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_MOVE_PAGE_H

#include <QCheckBox>

#include "remote_control/drive_pad.h"
#include "remote_control/elided_label.h"
#include "remote_control/head_pad.h"
#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// Controls walking, the head, postures and the motors.
class MovePage : public Page {
  Q_OBJECT

 public:
  /// @param robot must outlive the page
  explicit MovePage(Robot& robot, QWidget* parent = nullptr);

 private:
  void connectionChanged(const RobotConnection& connection) override;

  DrivePad* drive_pad_;
  HeadPad* head_pad_;
  ElidedLabel* movement_;
  QCheckBox* guard_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_MOVE_PAGE_H
