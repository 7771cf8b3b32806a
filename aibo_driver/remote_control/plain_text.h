/// @file plain_text.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H
#define AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H

#include <QObject>
#include <QWidget>

namespace aibo_driver::remote_control {

/// Has all labels and tooltips in a window, also in its dialogs and in those that come later, show text as it is. Qt
/// takes what looks like HTML for HTML, and then loads the pictures in it: a robot whose refusal is
/// `<img src="/dev/stdin">` would stop the window, with the button STOP in it.
class PlainText : public QObject {
  Q_OBJECT

 public:
  /// @param window to which this will belong. Call it before anything in the window is shown
  explicit PlainText(QWidget* window);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool isInWindow(const QObject* object) const;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PLAIN_TEXT_H
