#include "remote_control/picture_view.h"

#include <QMouseEvent>
#include <QPainter>

namespace aibo_driver::remote_control {

PictureView::PictureView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(104, 80);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setToolTip("Click, and the head turns to it");
  setCursor(Qt::CrossCursor);
}

void PictureView::showPicture(const QImage& picture) {
  const bool has_new_frame = picture.size() != picture_.size() || !text_.isEmpty();
  picture_ = picture;
  text_.clear();
  if (has_new_frame) {
    update();
  } else {
    update(target().toAlignedRect());
  }
}

void PictureView::showText(const QString& text) {
  if (text != text_) {
    text_ = text;
    update();
  }
}

QRectF PictureView::target() const {
  const QSizeF size = QSizeF(picture_.size()).scaled(QSizeF(this->size()), Qt::KeepAspectRatio);
  return {QPointF((width() - size.width()) / 2, (height() - size.height()) / 2), size};
}

void PictureView::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  const QRectF place = target();
  if (!text_.isEmpty() || picture_.isNull() || !place.contains(QRectF(event->rect()))) {
    painter.fillRect(rect(), QColor(24, 24, 24));
  }
  if (!text_.isEmpty() || picture_.isNull()) {
    painter.setPen(Qt::lightGray);
    painter.drawText(rect().adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap, text_);
    return;
  }
  painter.drawImage(place, picture_);
}

void PictureView::mousePressEvent(QMouseEvent* event) {
  const QRectF place = target();
  if (event->button() == Qt::LeftButton && text_.isEmpty() && place.contains(event->localPos())) {
    const QPointF offset = event->localPos() - place.topLeft();
    Q_EMIT clicked({offset.x() / place.width(), offset.y() / place.height()});
  }
}

void PictureView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  Q_EMIT visibilityChanged();
}

void PictureView::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  Q_EMIT visibilityChanged();
}

}  // namespace aibo_driver::remote_control
