/// @file widgets.h Qt's widgets, adapted to this window.
#ifndef AIBO_DRIVER_REMOTE_CONTROL_WIDGETS_H
#define AIBO_DRIVER_REMOTE_CONTROL_WIDGETS_H

#include <QLabel>
#include <QWidget>

namespace aibo_driver::remote_control {

/// One line of text. What has no room is replaced by three dots, so that a long text moves nothing.
class ElidedLabel : public QLabel {
 public:
  /// @param dots where the three dots are
  explicit ElidedLabel(QWidget* parent, Qt::TextElideMode dots = Qt::ElideRight);

  /// Shows a text. The tooltip has all of it.
  void showText(const QString& text);

 private:
  void paintEvent(QPaintEvent* event) override;

  const Qt::TextElideMode dots_;
};

/// Keeps the mouse wheel from changing the value of a widget. Somebody who scrolls a page does not want to move the
/// robot or to change a setting.
class IgnoreWheel : public QObject {
 public:
  /// @param widget owns this object
  explicit IgnoreWheel(QWidget* widget) : QObject(widget) { widget->installEventFilter(this); }

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

/// Makes all labels and tooltips in a window show text as it is. This includes its dialogs and widgets that are added
/// later. Qt treats text that looks like HTML as HTML, and then loads the pictures in it. So if a robot's refusal were
/// `<img src="/dev/stdin">`, it would stop the window together with its button STOP.
class PlainText : public QObject {
 public:
  /// @param window owns this object. Construct it before anything in the window is shown
  explicit PlainText(QWidget* window);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool isInWindow(const QObject* object) const;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_WIDGETS_H
