#include "remote_control/page.h"

#include <QVariant>

namespace aibo_driver::remote_control {

QString whyNot(Needs needs, const RobotConnection& connection, const RobotCondition& condition) {
  if (!connection.isConnected()) {
    return connection.text;
  }
  if (connection.protocol_version == 1 && needs != Needs::kConnection && needs != Needs::kMotors) {
    return "the robot's RCServer is of version 1, which does not support this";
  }
  if (needs == Needs::kConnection || needs == Needs::kVersion2) {
    return "";
  }
  if (condition.is_stopped) {
    return condition.stopped_by + " has stopped the robot; click Release";
  }
  if (needs == Needs::kNotStopped) {
    return "";
  }
  if (condition.motors == RobotCondition::Motors::kOff) {
    return "the motors are off; click Stand, or Motors on";
  }
  if (needs == Needs::kFeet && condition.posture == RobotCondition::Posture::kFallen) {
    return "the robot has fallen; put it on its feet, and click Stand";
  }
  if (needs == Needs::kFeet && condition.posture == RobotCondition::Posture::kCarried) {
    return "the robot is carried; put it on its feet";
  }
  return "";
}

void allow(QWidget* widget, const QString& why_not) {
  if (!widget->property(kOwnToolTip).isValid()) {
    widget->setProperty(kOwnToolTip, widget->toolTip());
  }
  widget->setEnabled(why_not.isEmpty());
  widget->setToolTip(why_not.isEmpty() ? widget->property(kOwnToolTip).toString() : "Not now: " + why_not);
}

Page::Page(QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  viewport()->setAutoFillBackground(false);
}

void Page::setState(const RobotConnection& connection, const RobotCondition& condition) {
  for (const Control& control : controls_) {
    allow(control.widget, whyNot(control.needs, connection, condition));
  }
  has_robot_ = connection.hasRobot();
  connectionChanged(connection);
}

QWidget* Page::makeContent() {
  auto* content = new QWidget;
  setWidget(content);
  content->setAutoFillBackground(false);  // so that the content shows the window's background
  return content;
}

QPushButton* Page::makeButton(Needs needs, const QString& text, const QString& tip,
                              const std::function<void()>& clicked) {
  return need(needs, makeButton(text, tip, clicked));
}

QPushButton* Page::makeButton(const QString& text, const QString& tip, const std::function<void()>& clicked) {
  auto* button = new QPushButton(text, this);
  button->setObjectName(text);
  button->setToolTip(tip);
  connect(button, &QPushButton::clicked, this, clicked);
  return button;
}

void Page::showEvent(QShowEvent* event) {
  QScrollArea::showEvent(event);
  Q_EMIT visibilityChanged();
}

void Page::hideEvent(QHideEvent* event) {
  QScrollArea::hideEvent(event);
  Q_EMIT visibilityChanged();
}

}  // namespace aibo_driver::remote_control
