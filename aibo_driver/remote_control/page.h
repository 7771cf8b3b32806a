/// @file page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_PAGE_H

#include <QPushButton>
#include <QScrollArea>
#include <QWidget>
#include <functional>
#include <vector>

#include "remote_control/allow.h"
#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// A part of the window. Each of its widgets can be used while the robot can do what the widget is for. It scrolls if
/// it needs more room than it has, so nothing on it changes the size of anything else.
class Page : public QScrollArea {
  Q_OBJECT

 public:
  explicit Page(QWidget* parent = nullptr) : QScrollArea(parent) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    viewport()->setAutoFillBackground(false);
  }

  Q_SIGNAL void visibilityChanged();

  /// Enables its widgets, or disables them and says why.
  void setState(const RobotConnection& connection, const RobotCondition& condition) {
    for (const Control& control : controls_) {
      allow(control.widget, whyNot(control.needs, connection, condition));
    }
    has_robot_ = connection.hasRobot();
    connectionChanged(connection);
  }

 protected:
  /// What was measured before the robot was lost may come later.
  bool hasRobot() const { return has_robot_; }

  /// Adds a widget that can be used only while the robot meets this need.
  template <typename Widget>
  Widget* need(Needs needs, Widget* widget) {
    controls_.push_back({widget, needs});
    allow(widget, "nothing is known of the robot yet");
    return widget;
  }

  /// Makes a widget for everything on the page. It replaces the previous one.
  QWidget* makeContent() {
    auto* content = new QWidget;
    setWidget(content);
    content->setAutoFillBackground(false);  // it shows the window's background
    return content;
  }

  QPushButton* makeButton(Needs needs, const QString& text, const QString& tip, const std::function<void()>& clicked) {
    auto* button = new QPushButton(text, this);
    button->setObjectName(text);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, clicked);
    return need(needs, button);
  }

 private:
  void showEvent(QShowEvent* event) override {
    QScrollArea::showEvent(event);
    Q_EMIT visibilityChanged();
  }
  void hideEvent(QHideEvent* event) override {
    QScrollArea::hideEvent(event);
    Q_EMIT visibilityChanged();
  }
  virtual void connectionChanged(const RobotConnection&) {}

  struct Control {
    QWidget* widget;
    Needs needs;
  };
  std::vector<Control> controls_;
  bool has_robot_ = false;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
