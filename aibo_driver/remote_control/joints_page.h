/// @file joints_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_JOINTS_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_JOINTS_PAGE_H

#include <QVBoxLayout>
#include <map>

#include "remote_control/joint_slider.h"
#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// A slider for each joint of the robot.
class JointsPage : public Page {
  Q_OBJECT

 public:
  explicit JointsPage(QWidget* parent = nullptr);

  void showPositions(const JointPositions& positions);

 Q_SIGNALS:
  /// Emitted when somebody has moved a slider.
  void moved(const aibo_driver::remote_control::JointPositions& positions);

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void makeSliders(const QString& design);

  QString design_;
  std::map<QString, JointSlider*> sliders_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_JOINTS_PAGE_H
