#include "remote_control/lights_page.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace aibo_driver::remote_control {
namespace {

constexpr int kFaceLeds = 14;

/// A pattern of the face's LEDs.
struct Pattern {
  const char* name;
  bool (*has)(int number);  ///< whether the LED with this number, 1..14, is part of the pattern
};

constexpr Pattern kPatterns[] = {{"Even", [](int number) { return number % 2 == 0; }},
                                 {"Odd", [](int number) { return number % 2 == 1; }},
                                 {"Upper", [](int number) { return number > kFaceLeds / 2; }},
                                 {"Lower", [](int number) { return number <= kFaceLeds / 2; }}};

QString faceLed(int number) {
  return "face_" + QString::number(number);
}

}  // namespace

LightsPage::LightsPage(Robot& robot, QWidget* parent)
    : Page(parent), robot_(robot), intensity_(new QSlider(Qt::Horizontal, this)) {
  intensity_->setObjectName("intensity");
  intensity_->setRange(1, 100);
  intensity_->setValue(100);
  intensity_->setToolTip("How bright the LEDs are that are switched on from now on");
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
    grid->addWidget(makeLed(faceLed(number), QString::number(number)), (number - 1) / 7, (number - 1) % 7);
  }
  auto* patterns = new QHBoxLayout;
  for (const Pattern& pattern : kPatterns) {
    QStringList on;
    for (int number = 1; number <= kFaceLeds; ++number) {
      if (pattern.has(number)) {
        on.append(faceLed(number));
      }
    }
    patterns->addWidget(makeButton(Needs::kConnection, pattern.name, "Only these LEDs: " + on.join(", "), [this, on] {
      robot_.setLeds({"face"}, 0);
      robot_.setLeds(on, intensity());
    }));
  }
  grid->addLayout(patterns, 2, 0, 1, 7);
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

}  // namespace aibo_driver::remote_control
