/// @file sensors_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_SENSORS_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_SENSORS_PAGE_H

#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <map>

#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// Shows what touches the robot and what its range finders measure.
class SensorsPage : public Page {
  Q_OBJECT

 public:
  /// @param robot must outlive the page
  explicit SensorsPage(Robot& robot, QWidget* parent = nullptr);

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void showTouched(const QStringList& places);
  void showDistance(const Distance& distance);

  std::map<QString, QLabel*> places_;
  QGridLayout* distances_;
  std::map<QString, QProgressBar*> bars_;  ///< made for the range finders that the robot has
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_SENSORS_PAGE_H
