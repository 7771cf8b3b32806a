#include "remote_control/remote_control.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QShortcut>
#include <QTabWidget>
#include <QTime>
#include <QUrl>
#include <QVBoxLayout>

#include "remote_control/joints_page.h"
#include "remote_control/lights_page.h"
#include "remote_control/motion_page.h"
#include "remote_control/move_page.h"
#include "remote_control/plain_text.h"
#include "remote_control/sensors_page.h"

namespace aibo_driver::remote_control {
namespace {

constexpr int kLongestAnswer = 1000;  // characters: laying out megabytes would take the time of STOP

}  // namespace

RemoteControl::RemoteControl(Robot& robot, QWidget* parent)
    : QWidget(parent),
      robot_(robot),
      connection_bar_(new ConnectionBar(this)),
      picture_(new PictureView(this)),
      camera_page_(new CameraPage(robot, this)),
      status_(new QLabel(this)) {
  new PlainText(this);
  status_->setObjectName("status");
  status_->setWordWrap(true);
  status_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  status_->setFixedHeight(2 * fontMetrics().lineSpacing() + 2);  // a long answer must not move the buttons
  status_->setText("Nothing has been asked of the robot yet.");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(connection_bar_);
  layout->addWidget(picture_, 1);
  layout->addLayout(makeButtons());
  layout->addWidget(makePages(), 1);
  layout->addWidget(status_);
  connectSignals();
  keepSpaceBar();
  RobotConnection unknown;
  unknown.text = "no driver has been found yet";
  showConnection(unknown);
}

// Its parts tell it when they are hidden. ~QWidget would hide them too late: the members are gone by then.
RemoteControl::~RemoteControl() {
  hide();
}

QLayout* RemoteControl::makeButtons() {
  take_button_ = new QPushButton("Take picture", this);
  take_button_->setObjectName("take_picture");
  take_button_->setToolTip("Takes a fresh picture and saves it in the folder of the page Camera");
  stream_button_ = new QPushButton(this);
  stream_button_->setObjectName("stream");
  stop_button_ = new QPushButton("STOP", this);
  stop_button_->setObjectName("stop");
  stop_button_->setToolTip("Holds everything that moves, at once. Or press the space bar.");
  stop_button_->setStyleSheet("background: #c62828; color: white; font-weight: bold; padding: 6px 18px");
  auto* row = new QHBoxLayout;
  row->addWidget(take_button_);
  row->addWidget(stream_button_);
  row->addStretch(1);
  row->addWidget(stop_button_);
  return row;
}

QWidget* RemoteControl::makePages() {
  auto* joints = new JointsPage(this);
  connect(joints, &JointsPage::moved, &robot_, &Robot::moveJoints);
  connect(&robot_, &Robot::jointsMeasured, joints, &JointsPage::showPositions);
  auto* tabs = new QTabWidget(this);
  const std::pair<const char*, Page*> pages[] = {
      {"Move", new MovePage(robot_, this)},      {"Camera", camera_page_},
      {"Motions", new MotionPage(robot_, this)}, {"Joints", joints},
      {"Lights", new LightsPage(robot_, this)},  {"Sensors", new SensorsPage(robot_, this)}};
  for (const auto& [title, page] : pages) {
    page->setObjectName(title);
    tabs->addTab(page, title);
    pages_.push_back(page);
    connect(page, &Page::visibilityChanged, this, &RemoteControl::askForWhatIsVisible);
  }
  return tabs;
}

void RemoteControl::connectSignals() {
  auto* space = new QShortcut(Qt::Key_Space, this);
  space->setAutoRepeat(false);
  connect(space, &QShortcut::activated, this, [this] { robot_.stop(); });
  connect(space, &QShortcut::activatedAmbiguously, this, [this] { robot_.stop(); });
  connect(stop_button_, &QPushButton::clicked, this, [this] { robot_.stop(); });
  connect(take_button_, &QPushButton::clicked, camera_page_, &CameraPage::takePicture);
  connect(stream_button_, &QPushButton::clicked, this, [this] { robot_.setStreaming(!streaming_); });
  connect(picture_, &PictureView::clicked, &robot_, &Robot::lookAt);
  connect(picture_, &PictureView::visibilityChanged, this, &RemoteControl::askForWhatIsVisible);
  connect(camera_page_, &CameraPage::folderChanged, this, &RemoteControl::changed);
  connect(camera_page_, &CameraPage::opened, this,
          [](const QString& path) { QDesktopServices::openUrl(QUrl::fromLocalFile(path)); });
  connect(connection_bar_, &ConnectionBar::chosen, this, [this](const QString& name_space) {
    useDriver(name_space);
    Q_EMIT changed();
  });
  connect(&robot_, &Robot::settingsDescribed, this, &RemoteControl::keepSpaceBar);
  connect(&robot_, &Robot::driversFound, connection_bar_, &ConnectionBar::showDrivers);
  connect(&robot_, &Robot::batteryMeasured, connection_bar_, &ConnectionBar::showBattery);
  connect(&robot_, &Robot::linkMeasured, connection_bar_, [this](const LinkFigures& figures) {
    if (connection_.isConnected()) {
      connection_bar_->showLink(figures);
    }
  });
  connect(&robot_, &Robot::connectionChanged, this, &RemoteControl::showConnection);
  connect(&robot_, &Robot::streamingChanged, this, &RemoteControl::showStreaming);
  connect(&robot_, &Robot::pictureArrived, picture_, &PictureView::showPicture);
  connect(&robot_, &Robot::answered, this, &RemoteControl::showAnswer);
}

// A text field would take the space bar for itself, and so would the list of a choice, which is a window of its own.
void RemoteControl::keepSpaceBar() {
  for (QLineEdit* edit : findChildren<QLineEdit*>()) {
    edit->installEventFilter(this);
  }
  for (QAbstractSpinBox* box : findChildren<QAbstractSpinBox*>()) {
    box->installEventFilter(this);
  }
  for (QComboBox* choice : findChildren<QComboBox*>()) {
    choice->view()->installEventFilter(this);
  }
}

bool RemoteControl::eventFilter(QObject* watched, QEvent* event) {
  const bool is_key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (!is_key || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Space) {
    return QWidget::eventFilter(watched, event);
  }
  if (event->type() == QEvent::ShortcutOverride) {
    event->ignore();  // it is a shortcut
  } else if (!static_cast<QKeyEvent*>(event)->isAutoRepeat()) {
    robot_.stop();  // in another window, where the shortcut does not hold
  }
  return true;
}

void RemoteControl::askForWhatIsVisible() {
  const auto is_visible = [this](const QString& page) { return findChild<Page*>(page)->isVisible(); };
  robot_.show(Part::kPictures, picture_->isVisible());
  robot_.show(Part::kJoints, is_visible("Move") || is_visible("Joints"));
  robot_.show(Part::kSensors, is_visible("Sensors"));
}

void RemoteControl::useDriver(const QString& name_space) {
  driver_ = name_space;
  robot_.useDriver(name_space);
}

void RemoteControl::showConnection(const RobotConnection& connection) {
  connection_ = connection;
  connection_bar_->showConnection(connection);
  const QString why_not = connection.isConnected() ? QString() : connection.text;
  allow(take_button_, why_not);
  allow(stream_button_, why_not);
  for (Page* page : pages_) {
    page->setConnection(connection);
  }
  showWhyNoPicture();
}

void RemoteControl::showStreaming(bool on) {
  streaming_ = on;
  showWhyNoPicture();
}

void RemoteControl::showWhyNoPicture() {
  stream_button_->setText(streaming_ ? "Stop stream" : "Start stream");
  if (!connection_.isConnected()) {
    picture_->showText(connection_.text);
  } else if (!streaming_) {
    picture_->showText("The stream is off.");
  }
}

void RemoteControl::showAnswer(bool success, const QString& text) {
  const QString shown = text.left(kLongestAnswer);
  status_->setText(QTime::currentTime().toString("HH:mm:ss ") + shown);
  status_->setToolTip(shown);
  status_->setStyleSheet(success ? "" : "color: #e53935");
}

}  // namespace aibo_driver::remote_control
