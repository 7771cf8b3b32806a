/// @file panel.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PANEL_H
#define AIBO_DRIVER_REMOTE_CONTROL_PANEL_H

#include <rviz/panel.h>

#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"

namespace aibo_driver::remote_control {

/// The window as a panel of rviz: aibo_driver/RemoteControl. rviz's configuration keeps the driver's namespace and the
/// folder for pictures.
class Panel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit Panel(QWidget* parent = nullptr);
  ~Panel() override;

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  RosRobot robot_;
  RemoteControl* window_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PANEL_H
