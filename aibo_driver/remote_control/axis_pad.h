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
/// The pad counts as held from the press of a mouse button until its release, but only while the pad is visible and
/// enabled in the active window.
class AxisPad : public QWidget {
  Q_OBJECT

 public:
  explicit AxisPad(QWidget* parent = nullptr);

  /// Sets the texts at the edges, which say what the values there mean.
  void setTexts(const QString& top, const QString& bottom, const QString& left, const QString& right);

  /// Shows the measured place beside the chosen one. An empty value means that nothing is known.
  void setMeasured(const std::optional<QPointF>& place);

  /// The measured place that was set last.
  const std::optional<QPointF>& measured() const { return measured_; }

  bool isHeld() const { return held_; }

  /// Does what the release of the mouse button does.
  void letGo();

  /// The place that was chosen last.
  QPointF chosen() const { return chosen_; }

  /// The button that holds the pad, or that held it last.
  Qt::MouseButton button() const { return button_; }

  QSize sizeHint() const override { return {180, 180}; }

 Q_SIGNALS:
  /// Emitted when the mouse was pressed, or when it moved while the pad is held.
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
