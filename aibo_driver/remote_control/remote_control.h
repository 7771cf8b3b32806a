/// @file remote_control.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_REMOTE_CONTROL_H
#define AIBO_DRIVER_REMOTE_CONTROL_REMOTE_CONTROL_H

#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <vector>

#include "remote_control/camera_page.h"
#include "remote_control/connection_bar.h"
#include "remote_control/page.h"
#include "remote_control/picture_view.h"
#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {

/// The whole window: STOP, the last answer, the connection, the live picture and the pages. The window shows only what
/// the robot reports, never what was clicked.
///
/// STOP must not move while somebody moves the mouse to it. So it is in the top left corner, and nothing above the
/// pages changes its size.
class RemoteControl : public QWidget {
  Q_OBJECT

 public:
  /// @param robot must outlive the window
  explicit RemoteControl(Robot& robot, QWidget* parent = nullptr);
  ~RemoteControl() override;

  /// Values that are kept from one start to the next. An empty namespace means the first driver that is found.
  void useDriver(const QString& name_space);
  QString driver() const { return driver_; }
  void setFolder(const QString& folder) { camera_page_->setFolder(folder); }
  QString folder() const { return camera_page_->folder(); }

 Q_SIGNALS:
  /// Emitted when a value that is kept has changed.
  void changed();

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keepSpaceBar();
  QLayout* makeTopRow();
  QWidget* makePages();
  void connectSignals();
  void showConnection(const RobotConnection& connection);
  void showCondition(const RobotCondition& condition);
  void showStopButton();
  void pressStopButton();
  void stop();
  bool isStopped() const;
  void letGoOfPads();
  void lookAt(const QPointF& place);
  void showStreaming(bool on);
  void askForWhatIsVisible();
  void showWhyNoPicture();
  void showAnswer(bool is_fine, const QString& text);

  Robot& robot_;
  QString driver_;  ///< the driver that the user has chosen
  RobotConnection connection_;
  RobotCondition condition_;
  QElapsedTimer stopped_since_;  ///< how long the button has meant Release
  bool streaming_ = false;

  ConnectionBar* connection_bar_;
  PictureView* picture_;
  CameraPage* camera_page_;
  QPushButton* stop_button_ = nullptr;
  ElidedLabel* commanded_ = nullptr;  ///< the driver that all buttons command
  ElidedLabel* condition_text_ = nullptr;
  QPushButton* take_button_ = nullptr;
  QPushButton* stream_button_ = nullptr;
  QLabel* status_;
  std::vector<Page*> pages_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_REMOTE_CONTROL_H
