#include "remote_control/drive_pad.h"

#include <cmath>

namespace aibo_driver::remote_control {
namespace {

// The velocities at the edges. aibo_teleop_joy has the same. The driver and the robot have limits of their own.
constexpr double kForward = 0.15;  // m/s
constexpr double kLeft = 0.06;     // m/s
constexpr double kTurn = 1.0;      // rad/s

constexpr double kDeadZone = 0.1;  // part of the half width, so that it is easy to walk straight ahead

constexpr int kPeriod = 100;  // ms; the robot stops 500 ms after the last command

double withoutDeadZone(double deflection) {
  return std::abs(deflection) < kDeadZone ? 0 : deflection;
}

}  // namespace

DrivePad::DrivePad(QWidget* parent) : AxisPad(parent) {
  setObjectName("drive_pad");
  setToolTip("The robot walks while the mouse is held down here. The right button steps to the sides.");
  setTexts("forward", "backward", "left", "right");
  connect(this, &AxisPad::moved, this, [this] {
    if (!timer_.isActive()) {
      send();
      timer_.start(kPeriod);
    }
  });
  connect(this, &AxisPad::released, this, [this] {
    timer_.stop();
    Q_EMIT walk(0, 0, 0);
  });
  connect(&timer_, &QTimer::timeout, this, &DrivePad::send);
}

void DrivePad::send() {
  const double forward = withoutDeadZone(chosen().y());
  const double left = -withoutDeadZone(chosen().x());
  const bool turns = button() == Qt::LeftButton;
  Q_EMIT walk(forward * kForward, turns ? 0 : left * kLeft, turns ? left * kTurn : 0);
}

}  // namespace aibo_driver::remote_control
