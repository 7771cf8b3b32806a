/// @file settings_form.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_FORM_H
#define AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_FORM_H

#include <QWidget>
#include <functional>
#include <map>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// The driver's settings. The form is made from the driver's own description, so a new setting of the driver appears
/// here by itself. The form shows the values in force.
class SettingsForm : public QWidget {
  Q_OBJECT

 public:
  explicit SettingsForm(QWidget* parent = nullptr) : QWidget(parent) {}

  void describe(const QVector<Setting>& settings);
  void showValues(const SettingValues& values);

 Q_SIGNALS:
  /// Emitted when somebody has chosen another value.
  void changed(const QString& name, const QVariant& value);

 private:
  QWidget* makeChoice(const Setting& setting);
  QWidget* makeNumber(const Setting& setting);

  QWidget* form_ = nullptr;
  SettingValues values_;
  std::map<QString, std::function<void(const QVariant&)>> show_;  ///< functions that show a value, by setting
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_SETTINGS_FORM_H
