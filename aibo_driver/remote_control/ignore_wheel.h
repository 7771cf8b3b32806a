/// @file ignore_wheel.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_IGNORE_WHEEL_H
#define AIBO_DRIVER_REMOTE_CONTROL_IGNORE_WHEEL_H

#include <QEvent>
#include <QWidget>

namespace aibo_driver::remote_control {

/// Keeps the mouse wheel from changing the value of a widget. Somebody who scrolls a page does not want to move the
/// robot or to change a setting.
class IgnoreWheel : public QObject {
 public:
  /// @param widget owns this object
  explicit IgnoreWheel(QWidget* widget) : QObject(widget) { widget->installEventFilter(this); }

 private:
  bool eventFilter(QObject*, QEvent* event) override {
    const bool is_wheel = event->type() == QEvent::Wheel;
    if (is_wheel) {
      event->ignore();  // then the page gets it
    }
    return is_wheel;
  }
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_IGNORE_WHEEL_H
