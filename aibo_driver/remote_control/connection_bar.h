/// @file connection_bar.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_CONNECTION_BAR_H
#define AIBO_DRIVER_REMOTE_CONTROL_CONNECTION_BAR_H

#include <QComboBox>
#include <QLabel>
#include <QWidget>

#include "remote_control/robot.h"
#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {

/// Shows which driver is used, whether its robot is connected, the robot's battery, and how well pictures come. Its
/// size is always the same.
class ConnectionBar : public QWidget {
  Q_OBJECT

 public:
  explicit ConnectionBar(QWidget* parent = nullptr);

  void showDrivers(const QStringList& name_spaces);
  void showConnection(const RobotConnection& connection);
  void showBattery(double charge, double temperature);
  void showLink(const LinkFigures& figures);

 Q_SIGNALS:
  /// Emitted when somebody has chosen another driver.
  void chosen(const QString& name_space);

 private:
  void fillChooser();

  QComboBox* chooser_;
  QLabel* lamp_;
  ElidedLabel* text_;
  QLabel* battery_;
  ElidedLabel* link_;
  QStringList found_;
  QStringList entries_;
  QString current_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_CONNECTION_BAR_H
