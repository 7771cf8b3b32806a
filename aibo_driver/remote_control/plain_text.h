/// @file plain_text.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H
#define AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H

#include <QObject>
#include <QWidget>

namespace aibo_driver::remote_control {

/// Makes all labels and tooltips in a window show text as it is. This includes its dialogs and widgets that are added
/// later. Qt treats text that looks like HTML as HTML, and then loads the pictures in it. So if a robot's refusal were
/// `<img src="/dev/stdin">`, it would stop the window together with its button STOP.
class PlainText : public QObject {
  Q_OBJECT

 public:
  /// @param window owns this object. Construct it before anything in the window is shown
  explicit PlainText(QWidget* window);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool isInWindow(const QObject* object) const;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H
