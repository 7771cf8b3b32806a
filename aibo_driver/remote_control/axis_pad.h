/// @file axis_pad.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_AXIS_PAD_H
#define AIBO_DRIVER_REMOTE_CONTROL_AXIS_PAD_H

#include <QPainter>
#include <QPointF>
#include <QString>
#include <QWidget>
#include <optional>

namespace aibo_driver::remote_control {

/// A square in which the mouse chooses two values at once, each -1..1: x to the right, y upwards.
///
/// It counts as held from the press of a mouse button until its release, and never longer than the pad is visible and
/// enabled in the active window.
class AxisPad : public QWidget {
  Q_OBJECT

 public:
  explicit AxisPad(QWidget* parent = nullptr);

  /// What the values at the edges mean.
  void setTexts(const QString& top, const QString& bottom, const QString& left, const QString& right);

  /// Shows what is measured beside what is chosen; none: nothing is known.
  void setMeasured(const std::optional<QPointF>& place);

  /// What is measured, as it was set.
  const std::optional<QPointF>& measured() const { return measured_; }

  bool isHeld() const { return held_; }

  /// What was chosen last.
  QPointF chosen() const { return chosen_; }

  /// The button with which it is held, or was last.
  Qt::MouseButton button() const { return button_; }

  QSize sizeHint() const override { return {180, 180}; }

 Q_SIGNALS:
  /// The mouse was pressed, or moved while it is held.
  void moved(const QPointF& place);
  void released();

 private:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void paintAxes(QPainter& painter, const QRectF& inside) const;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void choose(const QPointF& position);
  void release();
  QRectF area() const;
  QPointF positionOf(const QPointF& place) const;

  QString texts_[4];
  std::optional<QPointF> measured_;
  QPointF chosen_;
  bool held_ = false;
  Qt::MouseButton button_ = Qt::NoButton;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_AXIS_PAD_H
