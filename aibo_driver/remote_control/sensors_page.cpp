#include "remote_control/page.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QProgressBar>
#include <QVBoxLayout>
#include <cmath>
#include <map>
#include <utility>

namespace aibo_driver::remote_control {
namespace {

constexpr double kNear = 0.2;  // m; the robot is about to meet such an obstacle
const QColor kNearColor("#e53935");

const char* const kUntouched = "background: palette(base); border: 1px solid palette(mid); border-radius: 4px";
const char* const kTouched =
    "background: #ffb300; color: black; border: 1px solid palette(mid); border-radius: 4px; font-weight: bold";

/// The places as seen from above, with the head at the top.
constexpr std::pair<const char*, std::pair<int, int>> kPlaces[] = {
    {"head", {0, 0}},          {"chin", {0, 2}},        {"paw_left_front", {1, 0}},
    {"back_front", {1, 1}},    {"back_middle", {2, 1}}, {"paw_right_front", {1, 2}},
    {"paw_left_hind", {3, 0}}, {"back_rear", {3, 1}},   {"paw_right_hind", {3, 2}}};

QString words(const Distance& distance) {
  if (std::isnan(distance.metres)) {
    return distance.name + ": unknown";
  }
  if (std::isinf(distance.metres)) {
    return distance.name + (distance.metres > 0 ? ": nothing within reach" : ": nearer than it can measure");
  }
  return QString("%1: %2 m").arg(distance.name).arg(distance.metres, 0, 'f', 2);
}

class SensorsPage : public Page {
 public:
  explicit SensorsPage(Robot& robot, QWidget* parent);

  std::optional<Part> part() const override { return Part::kSensors; }

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void showTouched(const QStringList& places);
  void showDistance(const Distance& distance);

  std::map<QString, QLabel*> places_;
  QGridLayout* distances_;
  std::map<QString, QProgressBar*> bars_;  ///< made for the range finders that the robot has
};

SensorsPage::SensorsPage(Robot& robot, QWidget* parent) : Page(parent) {
  auto* touch = new QGroupBox("Touch", this);
  auto* grid = new QGridLayout(touch);
  grid->setContentsMargins(4, 4, 4, 4);
  for (const auto& [name, cell] : kPlaces) {
    auto* place = new QLabel(QString(name).replace('_', ' '), touch);
    place->setObjectName(name);
    place->setAlignment(Qt::AlignCenter);
    place->setMinimumHeight(3 * fontMetrics().height() / 2);
    place->setStyleSheet(kUntouched);
    grid->addWidget(place, cell.first, cell.second);
    places_[name] = place;
  }
  auto* ranges = new QGroupBox("Range finders", this);
  distances_ = new QGridLayout(ranges);
  distances_->setContentsMargins(4, 4, 4, 4);
  auto* layout = new QVBoxLayout(makeContent());
  layout->setContentsMargins(6, 4, 6, 4);
  layout->addWidget(touch);
  layout->addWidget(ranges);
  layout->addStretch(1);
  connect(&robot, &Robot::touched, this, &SensorsPage::showTouched);
  connect(&robot, &Robot::distanceMeasured, this, &SensorsPage::showDistance);
}

void SensorsPage::connectionChanged(const RobotConnection& connection) {
  if (!connection.hasRobot()) {
    showTouched({});
    for (const auto& [name, bar] : bars_) {
      bar->deleteLater();
    }
    bars_.clear();
  }
}

void SensorsPage::showTouched(const QStringList& places) {
  for (const auto& [name, label] : places_) {
    const bool is_touched = hasRobot() && places.contains(name);
    if (label->property("touched").toBool() != is_touched) {
      label->setStyleSheet(is_touched ? kTouched : kUntouched);
      label->setProperty("touched", is_touched);
    }
  }
}

void SensorsPage::showDistance(const Distance& distance) {
  if (!hasRobot()) {
    return;
  }
  QProgressBar*& bar = bars_[distance.name];
  if (bar == nullptr) {
    bar = new QProgressBar(this);
    bar->setObjectName("range_" + distance.name);
    bar->setRange(0, 100);
    distances_->addWidget(bar, static_cast<int>(bars_.size()), 0);
  }
  const QString text = words(distance);
  if (text == bar->format()) {
    return;
  }
  const double share =
      std::isinf(distance.metres) ? (distance.metres > 0 ? 1 : 0) : distance.metres / distance.farthest;
  bar->setFormat(text);
  bar->setValue(std::isnan(share) ? 0 : qRound(100 * share));
  QPalette colors = palette();
  if (distance.metres < kNear) {
    colors.setColor(QPalette::Highlight, kNearColor);
  }
  if (colors != bar->palette()) {
    bar->setPalette(colors);
  }
}

}  // namespace

Page* makeSensorsPage(Robot& robot, QWidget* parent) {
  return new SensorsPage(robot, parent);
}

}  // namespace aibo_driver::remote_control
