#include "remote_control/joint_slider.h"

#include <QHBoxLayout>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyle>
#include <QStyleOptionSlider>
#include <cstdlib>

#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {
namespace {

constexpr double kSteps = 1000;        // steps per radian
constexpr int kArrived = 30;           // mrad
constexpr qint64 kFollowAgain = 2000;  // ms after the last command

int toSteps(double position) {
  return qRound(position * kSteps);
}

int degrees(int steps) {
  constexpr double kDegrees = 57.29577951308232;
  return qRound(steps / kSteps * kDegrees);
}

}  // namespace

void MarkedSlider::setMark(std::optional<int> value) {
  if (mark_ != value) {
    mark_ = value;
    update();
  }
}

void MarkedSlider::paintEvent(QPaintEvent* event) {
  QSlider::paintEvent(event);
  if (!mark_) {
    return;
  }
  QStyleOptionSlider option;
  initStyleOption(&option);
  const QRect groove = style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
  const int handle = style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this).width();
  const int x = groove.left() + handle / 2 +
                QStyle::sliderPositionFromValue(minimum(), maximum(), *mark_, groove.width() - handle);
  QPainter painter(this);
  painter.fillRect(QRect(x - 1, 1, 3, height() - 2), QColor("#4caf50"));
}

JointSlider::JointSlider(const movement::JointProperties& joint, const QString& label, QWidget* parent)
    : QWidget(parent),
      joint_(QString::fromStdString(joint.name)),
      slider_(new MarkedSlider(this)),
      text_(new QLabel(this)) {
  setObjectName(joint_);
  slider_->setRange(toSteps(joint.lowest), toSteps(joint.highest));
  slider_->setEnabled(false);  // until the joint's position is known
  slider_->setPageStep(toSteps(0.1));
  slider_->setSingleStep(toSteps(0.02));
  setToolTip(QString::fromUtf8("%1: %2\u00B0 to %3\u00B0. The green mark is where it is measured.")
                 .arg(joint_)
                 .arg(degrees(slider_->minimum()))
                 .arg(degrees(slider_->maximum())));
  auto* name = new QLabel(label, this);
  name->setFixedWidth(fontMetrics().horizontalAdvance("elevator  "));
  text_->setFixedWidth(fontMetrics().horizontalAdvance(QString::fromUtf8("\u2192-100\u00B0")));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(name);
  row->addWidget(slider_, 1);
  row->addWidget(text_);
  new IgnoreWheel(slider_);
  showText();
  connect(slider_, &QSlider::valueChanged, this, &JointSlider::command);
}

void JointSlider::command(int value) {
  commanded_ = value;
  since_commanded_.start();
  showText();
  Q_EMIT moved(joint_, value / kSteps);
}

bool JointSlider::isBusy(int measured) {
  if (slider_->isSliderDown()) {
    return true;
  }
  if (commanded_ && (std::abs(*commanded_ - measured) < kArrived || since_commanded_.elapsed() > kFollowAgain)) {
    commanded_.reset();
  }
  return commanded_.has_value();
}

void JointSlider::measure(double position) {
  const int measured = toSteps(position);
  slider_->setEnabled(true);
  const bool is_new = !measured_ || std::abs(measured - *measured_) >= 5;  // smaller changes are noise of the sensor
  const bool was_busy = commanded_.has_value();
  if (!isBusy(measured) && (is_new || was_busy)) {
    const QSignalBlocker nobody_moved_it(slider_);
    slider_->setValue(measured);
  }
  if (is_new || was_busy) {
    measured_ = measured;
    slider_->setMark(measured);
    showText();
  }
}

std::optional<double> JointSlider::position() const {
  return measured_ ? std::optional<double>(slider_->value() / kSteps) : std::nullopt;
}

void JointSlider::forget() {
  measured_.reset();
  commanded_.reset();
  slider_->setEnabled(false);
  const QSignalBlocker nobody_moved_it(slider_);
  slider_->setValue(0);  // the same as before the first measurement
  slider_->setMark(std::nullopt);
  showText();
}

// Shows the target while the joint is moving to one, and the joint's position at all other times.
void JointSlider::showText() {
  const QString text = commanded_  ? QString::fromUtf8("\u2192%1\u00B0").arg(degrees(*commanded_))
                       : measured_ ? QString::fromUtf8("%1\u00B0").arg(degrees(*measured_))
                                   : QString("?");
  if (text != text_->text()) {
    text_->setText(text);
  }
}

}  // namespace aibo_driver::remote_control
