#include "remote_control/settings_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QSignalBlocker>
#include <QSpinBox>

#include "remote_control/ignore_wheel.h"

namespace aibo_driver::remote_control {
namespace {

/// Turns "jpeg_quality" into "Jpeg quality".
QString labelOf(const QString& name) {
  QString label = QString(name).replace('_', ' ');
  label[0] = label[0].toUpper();
  return label;
}

/// A value is sent when it is complete, not with each key.
template <typename Box>
Box* makeSpinBox(QWidget* parent) {
  auto* box = new Box(parent);
  box->setKeyboardTracking(false);
  box->setFocusPolicy(Qt::StrongFocus);  // the mouse wheel does not give it the focus
  new IgnoreWheel(box);
  return box;
}

}  // namespace

QWidget* SettingsForm::makeSwitch(const Setting& setting) {
  auto* box = new QCheckBox(form_);
  connect(box, &QCheckBox::clicked, this, [this, name = setting.name](bool on) { Q_EMIT changed(name, on); });
  show_[setting.name] = [box](const QVariant& value) { box->setChecked(value.toBool()); };
  return box;
}

QWidget* SettingsForm::makeChoice(const Setting& setting) {
  auto* box = new QComboBox(form_);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // its list shows long texts in full
  new IgnoreWheel(box);
  for (const auto& [text, value] : setting.choices) {
    box->addItem(text, value);
  }
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, box, name = setting.name](int index) { Q_EMIT changed(name, box->itemData(index)); });
  show_[setting.name] = [box](const QVariant& value) { box->setCurrentIndex(box->findData(value)); };
  return box;
}

QWidget* SettingsForm::makeInteger(const Setting& setting) {
  auto* box = makeSpinBox<QSpinBox>(form_);
  box->setRange(static_cast<int>(setting.lowest), static_cast<int>(setting.highest));
  connect(box, qOverload<int>(&QSpinBox::valueChanged), this,
          [this, name = setting.name](int value) { Q_EMIT changed(name, value); });
  show_[setting.name] = [box](const QVariant& value) {
    const QSignalBlocker nobody_changed_it(box);
    box->setValue(value.toInt());
  };
  return box;
}

QWidget* SettingsForm::makeNumber(const Setting& setting) {
  auto* box = makeSpinBox<QDoubleSpinBox>(form_);
  box->setRange(setting.lowest, setting.highest);
  box->setSingleStep(setting.highest > 2 ? 1 : 0.1);
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this, name = setting.name](double value) { Q_EMIT changed(name, value); });
  show_[setting.name] = [box](const QVariant& value) {
    const QSignalBlocker nobody_changed_it(box);
    box->setValue(value.toDouble());
  };
  return box;
}

QWidget* SettingsForm::makeEditor(const Setting& setting) {
  switch (setting.kind) {
    case Setting::Kind::kSwitch:
      return makeSwitch(setting);
    case Setting::Kind::kChoice:
      return makeChoice(setting);
    case Setting::Kind::kNumber:
      return makeNumber(setting);
    case Setting::Kind::kInteger:
      break;
  }
  return makeInteger(setting);
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
    QWidget* editor = makeEditor(setting);
    editor->setObjectName(setting.name);
    editor->setToolTip(setting.description);
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
