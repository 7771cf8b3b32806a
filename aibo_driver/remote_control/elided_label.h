/// @file elided_label.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H
#define AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H

#include <QLabel>
#include <QPainter>

namespace aibo_driver::remote_control {

/// One line of text. What has no room is replaced by three dots, so a text moves nothing, however long it is.
class ElidedLabel : public QLabel {
 public:
  /// @param dots where the three dots are
  explicit ElidedLabel(QWidget* parent, Qt::TextElideMode dots = Qt::ElideRight) : QLabel(parent), dots_(dots) {
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    policy.setRetainSizeWhenHidden(true);
    setSizePolicy(policy);
    setFixedHeight(fontMetrics().lineSpacing() + 2);
  }

  /// Shows a text. The tooltip has all of it.
  void showText(const QString& text) {
    setText(text);
    setToolTip(text);
  }

 private:
  void paintEvent(QPaintEvent*) override {
    QPainter(this).drawText(rect(), alignment(), fontMetrics().elidedText(text(), dots_, width()));
  }

  const Qt::TextElideMode dots_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ELIDED_LABEL_H
