/// @file camera_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_CAMERA_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_CAMERA_PAGE_H

#include <QFileDialog>
#include <QLabel>
#include <QPointer>
#include <QPushButton>

#include "remote_control/page.h"
#include "remote_control/settings_form.h"

namespace aibo_driver::remote_control {

/// Takes pictures and changes the settings of the camera and the driver.
class CameraPage : public Page {
  Q_OBJECT

 public:
  /// @param robot must outlive the page
  explicit CameraPage(Robot& robot, QWidget* parent = nullptr);

  /// The folder on this machine in which pictures are saved.
  const QString& folder() const { return folder_; }
  void setFolder(const QString& folder);

  /// Takes a picture, and shows the picture when it comes.
  void takePicture();

 Q_SIGNALS:
  /// Emitted when somebody has chosen another folder.
  void folderChanged();

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void showTaken(const QImage& picture, const QString& path);
  void chooseFolder();

  Robot& robot_;
  QString folder_;
  QString taken_;  ///< the path of the newest picture that was taken
  QPushButton* thumbnail_;
  QLabel* path_;
  QPushButton* folder_button_;
  SettingsForm* settings_;
  QPointer<QFileDialog> dialog_;  ///< the dialog to choose a folder; null when it is closed
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_CAMERA_PAGE_H
