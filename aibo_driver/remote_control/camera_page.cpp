#include "remote_control/camera_page.h"

#include <QDesktopServices>
#include <QGridLayout>
#include <QPixmap>
#include <QStandardPaths>
#include <QUrl>

namespace aibo_driver::remote_control {
namespace {

constexpr QSize kThumbnail(104, 80);

QString defaultFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
}

}  // namespace

CameraPage::CameraPage(Robot& robot, QWidget* parent)
    : Page(parent),
      robot_(robot),
      folder_(defaultFolder()),
      thumbnail_(new QPushButton(this)),
      path_(new QLabel(this)),
      folder_button_(new QPushButton("Folder...", this)),
      settings_(new SettingsForm(this)) {
  thumbnail_->setObjectName("thumbnail");
  thumbnail_->setIconSize(kThumbnail);
  thumbnail_->setFixedSize(kThumbnail + QSize(8, 8));
  allow(thumbnail_, "no picture has been taken yet");
  path_->setObjectName("path");
  folder_button_->setObjectName("folder");
  path_->setWordWrap(true);
  path_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // names of folders may be long
  path_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* grid = new QGridLayout(makeContent());
  grid->addWidget(thumbnail_, 0, 0, 2, 1);
  grid->addWidget(path_, 0, 1);
  grid->addWidget(folder_button_, 1, 1, Qt::AlignLeft);
  grid->setColumnStretch(1, 1);
  grid->addWidget(settings_, 2, 0, 1, 2);
  grid->setRowStretch(3, 1);
  setFolder(folder_);
  connect(thumbnail_, &QPushButton::clicked, this, [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(taken_)); });
  connect(folder_button_, &QPushButton::clicked, this, &CameraPage::chooseFolder);
  connect(settings_, &SettingsForm::changed, &robot, &Robot::changeSetting);
  connect(&robot, &Robot::settingsDescribed, settings_, &SettingsForm::describe);
  connect(&robot, &Robot::settingsChanged, settings_, &SettingsForm::showValues);
  connect(&robot, &Robot::pictureTaken, this, &CameraPage::showTaken);
}

void CameraPage::setFolder(const QString& folder) {
  folder_ = folder.isEmpty() ? defaultFolder() : folder;
  folder_button_->setToolTip("Pictures are saved in " + folder_ + ". Click to choose another folder.");
  if (taken_.isEmpty()) {
    path_->setText("Pictures are saved in " + folder_ + ".");
  }
}

void CameraPage::takePicture() {
  robot_.takePicture(folder_);
}

void CameraPage::showTaken(const QImage& picture, const QString& path) {
  taken_ = path;
  thumbnail_->setIcon(QPixmap::fromImage(picture.scaled(kThumbnail, Qt::KeepAspectRatio, Qt::SmoothTransformation)));
  thumbnail_->setProperty(kOwnToolTip, "Opens " + path);
  allow(thumbnail_, {});
  path_->setText(path);
}

// The dialog is not modal, because STOP has to work while it is open.
void CameraPage::chooseFolder() {
  if (dialog_ != nullptr) {
    dialog_->raise();
    return;
  }
  dialog_ = new QFileDialog(this, "Folder for pictures", folder_);
  dialog_->setAttribute(Qt::WA_DeleteOnClose);
  dialog_->setFileMode(QFileDialog::Directory);
  dialog_->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog_, &QFileDialog::fileSelected, this, [this](const QString& folder) {
    setFolder(folder);
    Q_EMIT folderChanged();
  });
  dialog_->show();
}

// The driver's settings can be changed even while it has no robot.
void CameraPage::connectionChanged(const RobotConnection& connection) {
  allow(settings_, connection.hasDriver() ? QString() : connection.text);
}

}  // namespace aibo_driver::remote_control
