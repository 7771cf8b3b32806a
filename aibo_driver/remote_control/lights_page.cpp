#include "remote_control/page.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>
#include <map>

namespace aibo_driver::remote_control {
namespace {

constexpr int kFaceLeds = 14;

class LightsPage : public Page {
 public:
  explicit LightsPage(Robot& robot, QWidget* parent);

 private:
  QWidget* makeFace();
  QWidget* makeGroups();
  QWidget* makeEars();
  QPushButton* makeLed(const QString& name, const QString& label);
  void showLeds(const LedIntensities& intensities);
  double intensity() const;

  Robot& robot_;
  QSlider* intensity_;
  LedIntensities shown_;
  std::map<QString, QPushButton*> leds_;
};

LightsPage::LightsPage(Robot& robot, QWidget* parent)
    : Page(parent), robot_(robot), intensity_(new QSlider(Qt::Horizontal, this)) {
  intensity_->setObjectName("intensity");
  intensity_->setRange(1, 100);
  intensity_->setValue(100);
  intensity_->setToolTip("The brightness of LEDs that you switch on next");
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel("Intensity", this));
  row->addWidget(intensity_);
  auto* layout = new QVBoxLayout(makeContent());
  layout->setContentsMargins(6, 4, 6, 4);
  layout->addLayout(row);
  layout->addWidget(makeFace());
  layout->addWidget(makeGroups());
  layout->addWidget(makeEars());
  layout->addStretch(1);
  connect(&robot, &Robot::ledsChanged, this, &LightsPage::showLeds);
}

double LightsPage::intensity() const {
  return intensity_->value() / 100.0;
}

QPushButton* LightsPage::makeLed(const QString& name, const QString& label) {
  auto* led = makeButton(Needs::kConnection, label, "Switches " + name + " on or off", [this, name] {
    const bool is_on = shown_.value(name) > 0;
    robot_.setLeds({name}, is_on ? 0 : intensity());
  });
  led->setObjectName(name);
  led->setFixedWidth(fontMetrics().horizontalAdvance("0000"));
  leds_[name] = led;
  return led;
}

QWidget* LightsPage::makeFace() {
  auto* face = new QGroupBox("Face", this);
  auto* grid = new QGridLayout(face);
  grid->setContentsMargins(4, 4, 4, 4);
  for (int number = 1; number <= kFaceLeds; ++number) {
    const QString label = QString::number(number);
    grid->addWidget(makeLed("face_" + label, label), (number - 1) / 7, (number - 1) % 7);
  }
  return face;
}

QWidget* LightsPage::makeGroups() {
  auto* groups = new QGroupBox("Groups", this);
  auto* grid = new QGridLayout(groups);
  grid->setContentsMargins(4, 4, 4, 4);
  int column = 0;
  for (const char* name : {"face", "back", "head", "all"}) {
    const QString group = name;
    auto* on = makeButton(Needs::kConnection, group + " on", "Switches them on",
                          [this, group] { robot_.setLeds({group}, intensity()); });
    auto* off = makeButton(Needs::kConnection, group + " off", "Switches them off",
                           [this, group] { robot_.setLeds({group}, 0); });
    grid->addWidget(on, 0, column);
    grid->addWidget(off, 1, column);
    ++column;
  }
  return groups;
}

QWidget* LightsPage::makeEars() {
  auto* ears = new QWidget(this);
  auto* row = new QHBoxLayout(ears);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(makeButton(Needs::kConnection, "Left ear", "Flicks it", [this] { robot_.flickEars(true, false); }));
  row->addWidget(makeButton(Needs::kConnection, "Both ears", "Flicks them", [this] { robot_.flickEars(true, true); }));
  row->addWidget(makeButton(Needs::kConnection, "Right ear", "Flicks it", [this] { robot_.flickEars(false, true); }));
  return ears;
}

void LightsPage::showLeds(const LedIntensities& intensities) {
  shown_ = intensities;
  for (const auto& [name, button] : leds_) {
    const double shines = intensities.value(name);
    button->setStyleSheet(shines > 0 ? QString("background-color: hsl(48, 100%, %1%)").arg(90 - qRound(35 * shines))
                                     : QString());
  }
}

}  // namespace

Page* makeLightsPage(Robot& robot, QWidget* parent) {
  return new LightsPage(robot, parent);
}

}  // namespace aibo_driver::remote_control
