/// @file picture_view.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PICTURE_VIEW_H
#define AIBO_DRIVER_REMOTE_CONTROL_PICTURE_VIEW_H

#include <QImage>
#include <QWidget>

namespace aibo_driver::remote_control {

/// Shows the live picture as large as the room allows.
class PictureView : public QWidget {
  Q_OBJECT

 public:
  explicit PictureView(QWidget* parent = nullptr);

  void showPicture(const QImage& picture);

  /// Shows a text instead of a picture, until the next picture comes.
  void showText(const QString& text);

  bool showsText() const { return !text_.isEmpty(); }

  QSize sizeHint() const override { return {416, 240}; }

 Q_SIGNALS:
  /// Emitted when somebody has clicked on the picture.
  /// @param place the place, 0..1 from left to right and from top to bottom
  void clicked(const QPointF& place);

  /// Emitted when the view has appeared or disappeared.
  void visibilityChanged();

 private:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  QRectF target() const;

  QImage picture_;
  QString text_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PICTURE_VIEW_H
