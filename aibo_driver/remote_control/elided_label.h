/// @file elided_label.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H
#define AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H

#include <QLabel>
#include <QPainter>

namespace aibo_driver::remote_control {

/// One line of text. What has no room is replaced by three dots, so a long text makes no window wider. The tooltip has
/// all of it.
class ElidedLabel : public QLabel {
 public:
  explicit ElidedLabel(QWidget* parent) : QLabel(parent) { setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); }

 private:
  void paintEvent(QPaintEvent*) override {
    QPainter(this).drawText(rect(), alignment(), fontMetrics().elidedText(text(), Qt::ElideRight, width()));
  }
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H
