#include "remote_control/settings_form.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QSignalBlocker>
#include <algorithm>

#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {
namespace {

/// Turns "jpeg_quality" into "Jpeg quality".
QString labelOf(const QString& name) {
  const QString label = QString(name).replace('_', ' ');
  return label.left(1).toUpper() + label.mid(1);
}

}  // namespace

QWidget* SettingsForm::makeChoice(const Setting& setting) {
  auto* box = new QComboBox(form_);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // the list shows long texts in full
  for (const auto& [text, value] : setting.choices) {
    box->addItem(text, value);
  }
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, box, name = setting.name](int index) { Q_EMIT changed(name, box->itemData(index)); });
  show_[setting.name] = [box](const QVariant& value) { box->setCurrentIndex(box->findData(value)); };
  return box;
}

// Makes a field for a number. A value is sent when it is complete, not with each key.
QWidget* SettingsForm::makeNumber(const Setting& setting) {
  const bool is_whole = setting.lowest.type() != QVariant::Double;
  auto* box = new QDoubleSpinBox(form_);
  box->setDecimals(is_whole ? 0 : 2);
  box->setRange(setting.lowest.toDouble(), setting.highest.toDouble());
  box->setSingleStep(setting.highest.toDouble() > 2 ? 1 : 0.1);
  box->setKeyboardTracking(false);
  box->setFocusPolicy(Qt::StrongFocus);  // so that the mouse wheel does not give it the focus
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this, is_whole, name = setting.name](double value) {
            Q_EMIT changed(name, is_whole ? QVariant(qRound(value)) : QVariant(value));
          });
  show_[setting.name] = [box, setting](const QVariant& value) {
    const QSignalBlocker nobody_changed_it(box);
    // The range includes the value, because a new driver's values can come before its limits.
    box->setRange(std::min(setting.lowest.toDouble(), value.toDouble()),
                  std::max(setting.highest.toDouble(), value.toDouble()));
    box->setValue(value.toDouble());
  };
  return box;
}

void SettingsForm::describe(const QVector<Setting>& settings) {
  show_.clear();
  delete layout();
  delete form_;
  form_ = new QWidget(this);
  auto* rows = new QFormLayout(form_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setVerticalSpacing(3);
  for (const Setting& setting : settings) {
    QWidget* editor = setting.choices.empty() ? makeNumber(setting) : makeChoice(setting);
    editor->setObjectName(setting.name);
    editor->setToolTip(setting.description);
    new IgnoreWheel(editor);
    rows->addRow(labelOf(setting.name), editor);
  }
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(form_);
  showValues(values_);
}

void SettingsForm::showValues(const SettingValues& values) {
  values_ = values;
  for (const auto& [name, show] : show_) {
    if (values.contains(name)) {
      show(values[name]);
    }
  }
}

}  // namespace aibo_driver::remote_control
