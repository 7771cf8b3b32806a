#include "remote_control/head_pad.h"

#include "aibo_client/exceptions.h"

namespace aibo_driver::remote_control {
namespace {

constexpr const char* kPan = "head_pan";
constexpr const char* kTilt = "head_tilt";

/// -1 is the lowest position, 1 is the highest.
double toPad(double position, const movement::JointProperties& joint) {
  return 2 * (position - joint.lowest) / (joint.highest - joint.lowest) - 1;
}

double fromPad(double place, const movement::JointProperties& joint) {
  return joint.lowest + (place + 1) / 2 * (joint.highest - joint.lowest);
}

}  // namespace

HeadPad::HeadPad(QWidget* parent) : AxisPad(parent) {
  setObjectName("head_pad");
  setToolTip("Points the head. The green mark is where it is.");
  setTexts("up", "down", "left", "right");
  setDesign("ERS-7");
  // The robot counts angles to the left as positive.
  connect(this, &AxisPad::moved, this, [this](const QPointF& place) {
    Q_EMIT pointed({{kPan, fromPad(-place.x(), pan_)}, {kTilt, fromPad(place.y(), tilt_)}});
  });
}

void HeadPad::setDesign(const QString& design) {
  try {
    const movement::JointTable table(design.toStdString(), kAnySpeed);
    const auto pan = table.findByName(kPan);
    const auto tilt = table.findByName(kTilt);
    if (pan && tilt) {
      pan_ = table[*pan];
      tilt_ = table[*tilt];
    }
  } catch (const aibo_client::InvalidArgumentException&) {
    // The driver refuses commands to such a robot.
  }
}

void HeadPad::showPositions(const JointPositions& positions) {
  if (isVisible() && positions.contains(kPan) && positions.contains(kTilt)) {
    setMeasured(QPointF(-toPad(positions[kPan], pan_), toPad(positions[kTilt], tilt_)));
  }
}

}  // namespace aibo_driver::remote_control
