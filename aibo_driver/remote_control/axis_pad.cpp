#include "remote_control/axis_pad.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

namespace aibo_driver::remote_control {

AxisPad::AxisPad(QWidget* parent) : QWidget(parent) {
  setMinimumSize(120, 120);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void AxisPad::setTexts(const QString& top, const QString& bottom, const QString& left, const QString& right) {
  texts_[0] = top;
  texts_[1] = bottom;
  texts_[2] = left;
  texts_[3] = right;
  update();
}

void AxisPad::setMeasured(const std::optional<QPointF>& place) {
  const bool is_near = place && measured_ && (*place - *measured_).manhattanLength() < 0.01;
  if (!is_near && place != measured_) {
    measured_ = place;
    update();
  }
}

QRectF AxisPad::area() const {
  const int side = std::min(width(), height()) - 2;
  return QRectF((width() - side) / 2.0, (height() - side) / 2.0, side, side);
}

QPointF AxisPad::positionOf(const QPointF& place) const {
  const QRectF square = area();
  return square.center() + QPointF(place.x() * square.width() / 2, -place.y() * square.height() / 2);
}

void AxisPad::choose(const QPointF& position) {
  const QRectF square = area();
  const QPointF offset = position - square.center();
  chosen_ = {std::clamp(2 * offset.x() / square.width(), -1.0, 1.0),
             std::clamp(-2 * offset.y() / square.height(), -1.0, 1.0)};
  update();
  Q_EMIT moved(chosen_);
}

void AxisPad::letGo() {
  if (held_) {
    held_ = false;
    update();
    Q_EMIT released();
  }
}

bool AxisPad::event(QEvent* event) {
  const bool ends = event->type() == QEvent::Hide || event->type() == QEvent::WindowDeactivate ||
                    (event->type() == QEvent::EnabledChange && !isEnabled());
  if (ends) {
    letGo();
  }
  return QWidget::event(event);
}

void AxisPad::mousePressEvent(QMouseEvent* event) {
  if (!held_) {
    held_ = true;
    button_ = event->button();
    choose(event->localPos());
  }
}

void AxisPad::mouseMoveEvent(QMouseEvent* event) {
  if (held_) {
    choose(event->localPos());
  }
}

void AxisPad::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == button_) {
    letGo();
  }
}

// Each axis goes from one text to the opposite text.
void AxisPad::paintAxes(QPainter& painter, const QRectF& inside) const {
  const int height = fontMetrics().height() + 2;
  const auto width = [this](const QString& text) { return fontMetrics().horizontalAdvance(text) + 4; };
  const QPointF center = inside.center();
  painter.drawLine(QPointF(inside.left() + width(texts_[2]), center.y()),
                   QPointF(inside.right() - width(texts_[3]), center.y()));
  painter.drawLine(QPointF(center.x(), inside.top() + height), QPointF(center.x(), inside.bottom() - height));
}

void AxisPad::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF square = area();
  const QPalette::ColorGroup group = isEnabled() ? QPalette::Active : QPalette::Disabled;
  painter.setPen(palette().color(group, QPalette::Mid));
  painter.setBrush(palette().color(group, QPalette::Base));
  painter.drawRoundedRect(square, 6, 6);
  const QRectF inside = square.adjusted(4, 2, -4, -2);
  paintAxes(painter, inside);
  painter.setPen(palette().color(group, QPalette::Text));
  painter.drawText(inside, Qt::AlignTop | Qt::AlignHCenter, texts_[0]);
  painter.drawText(inside, Qt::AlignBottom | Qt::AlignHCenter, texts_[1]);
  painter.drawText(inside, Qt::AlignLeft | Qt::AlignVCenter, texts_[2]);
  painter.drawText(inside, Qt::AlignRight | Qt::AlignVCenter, texts_[3]);
  if (measured_) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor("#4caf50"));
    painter.drawEllipse(positionOf({std::clamp(measured_->x(), -1.0, 1.0), std::clamp(measured_->y(), -1.0, 1.0)}), 6,
                        6);
  }
  if (held_) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(palette().color(QPalette::Highlight), 3));
    painter.drawEllipse(positionOf(chosen_), 10, 10);
  }
}

}  // namespace aibo_driver::remote_control
