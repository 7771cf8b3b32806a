/// @file motion_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_MOTION_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_MOTION_PAGE_H

#include <QLineEdit>
#include <QListWidget>
#include <QSpinBox>

#include "remote_control/elided_label.h"
#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// Shows the motions on the robot, and what moves it now.
class MotionPage : public Page {
  Q_OBJECT

 public:
  /// @param robot must outlive the page
  explicit MotionPage(Robot& robot, QWidget* parent = nullptr);

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void showMotions(const QStringList& names);
  void play();

  Robot& robot_;
  QListWidget* list_;
  QLineEdit* name_;
  QSpinBox* repetitions_;
  ElidedLabel* movement_;
  QString listed_for_;  ///< the connection for which the motions were requested
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_MOTION_PAGE_H
