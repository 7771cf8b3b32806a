#include "remote_control/remote_control.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QProxyStyle>
#include <QShortcut>
#include <QTabBar>
#include <QTabWidget>
#include <QTime>
#include <QVBoxLayout>

#include "remote_control/axis_pad.h"

namespace aibo_driver::remote_control {
namespace {

constexpr int kLongestAnswer = 1000;  // characters; laying out megabytes would delay STOP
// How long the button does not release: a frightened user clicks more than once, and must not undo the stop.
constexpr qint64 kNoReleaseFor = 1000;  // ms

/// A style with less room around the titles of tabs, so that all titles are visible in rviz on a small screen.
class NarrowTabs : public QProxyStyle {
 public:
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override {
    constexpr int kAroundTitle = 8;  // pixels
    return metric == PM_TabBarTabHSpace ? kAroundTitle : QProxyStyle::pixelMetric(metric, option, widget);
  }
};

QString nameOf(RobotCondition::Posture posture) {
  switch (posture) {
    case RobotCondition::Posture::kStanding:
      return "stands";
    case RobotCondition::Posture::kSitting:
      return "sits";
    case RobotCondition::Posture::kLying:
      return "lies";
    case RobotCondition::Posture::kWalking:
      return "walks";
    case RobotCondition::Posture::kFallen:
      return "has fallen";
    case RobotCondition::Posture::kCarried:
      return "is carried";
    case RobotCondition::Posture::kNotKnown:
      break;
  }
  return "";
}

QString describe(const RobotCondition& condition) {
  if (condition.is_stopped) {
    return "stopped by " + condition.stopped_by;
  }
  QStringList parts;
  if (const QString posture = nameOf(condition.posture); !posture.isEmpty()) {
    parts.append(posture);
  }
  if (condition.motors != RobotCondition::Motors::kNotKnown) {
    parts.append(condition.motors == RobotCondition::Motors::kOn ? "motors on" : "motors off");
  }
  return parts.join(", ");
}

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
  status_->setFixedHeight(2 * fontMetrics().lineSpacing() + 2);
  status_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  status_->setText("No command has been sent to the robot yet.");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->setSpacing(4);
  layout->addLayout(makeTopRow());
  layout->addWidget(status_);
  layout->addWidget(connection_bar_);
  layout->addWidget(picture_, 1);
  layout->addWidget(makePages(), 1);
  connectSignals();
  keepSpaceBar();
  RobotConnection unknown;
  unknown.text = "no driver has been found yet";
  showConnection(unknown);
}

// Hides the parts of the window, which tell the window when they are hidden. ~QWidget would hide them too late, when
// the window's members no longer exist.
RemoteControl::~RemoteControl() {
  hide();
}

QLayout* RemoteControl::makeTopRow() {
  stop_button_ = new QPushButton(this);
  stop_button_->setObjectName("stop");
  stop_button_->setFixedSize(fontMetrics().horizontalAdvance("Release") + 60, 2 * fontMetrics().lineSpacing() + 8);
  showStopButton();
  commanded_ = new ElidedLabel(this, Qt::ElideMiddle);  // the names of a fleet differ at their ends
  commanded_->setObjectName("commanded");
  commanded_->setStyleSheet("font-weight: bold");
  commanded_->setMinimumWidth(fontMetrics().horizontalAdvance("/aibo_left"));
  condition_text_ = new ElidedLabel(this);
  condition_text_->setObjectName("condition");
  take_button_ = new QPushButton("Take picture", this);
  take_button_->setObjectName("take_picture");
  take_button_->setToolTip("Takes a fresh picture and saves it in the folder of the page Camera");
  stream_button_ = new QPushButton(this);
  stream_button_->setObjectName("stream");
  stream_button_->setText("Start stream");  // the longer of the button's two texts
  stream_button_->setMinimumWidth(stream_button_->sizeHint().width());
  auto* texts = new QVBoxLayout;
  texts->setSpacing(0);
  texts->addWidget(commanded_);
  texts->addWidget(condition_text_);
  auto* row = new QHBoxLayout;
  row->addWidget(stop_button_);
  row->addLayout(texts, 1);
  row->addWidget(take_button_);
  row->addWidget(stream_button_);
  return row;
}

QWidget* RemoteControl::makePages() {
  auto* tabs = new QTabWidget(this);
  auto* style = new NarrowTabs;
  style->setParent(tabs);
  tabs->tabBar()->setStyle(style);
  tabs->setUsesScrollButtons(false);  // buttons to scroll would hide titles
  const std::pair<const char*, Page*> pages[] = {
      {"Move", makeMovePage(robot_, this)},      {"Camera", camera_page_},
      {"Motions", makeMotionPage(robot_, this)}, {"Joints", makeJointsPage(robot_, this)},
      {"Lights", makeLightsPage(robot_, this)},  {"Sensors", makeSensorsPage(robot_, this)},
      {"Sound", makeSoundPage(robot_, this)}};
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
  connect(space, &QShortcut::activated, this, &RemoteControl::stop);
  connect(space, &QShortcut::activatedAmbiguously, this, &RemoteControl::stop);
  connect(stop_button_, &QPushButton::clicked, this, &RemoteControl::pressStopButton);
  connect(take_button_, &QPushButton::clicked, camera_page_, &CameraPage::takePicture);
  connect(stream_button_, &QPushButton::clicked, this, [this] { robot_.setStreaming(!streaming_); });
  connect(picture_, &PictureView::clicked, this, &RemoteControl::lookAt);
  connect(picture_, &PictureView::visibilityChanged, this, &RemoteControl::askForWhatIsVisible);
  connect(camera_page_, &CameraPage::folderChanged, this, &RemoteControl::changed);
  connect(connection_bar_, &ConnectionBar::chosen, this, [this](const QString& name_space) {
    useDriver(name_space);
    Q_EMIT changed();
  });
  connect(&robot_, &Robot::settingsDescribed, this, &RemoteControl::keepSpaceBar);
  connect(&robot_, &Robot::driversFound, connection_bar_, &ConnectionBar::showDrivers);
  // A measurement from before the robot was lost may come later.
  connect(&robot_, &Robot::batteryMeasured, connection_bar_, [this](double charge, double temperature) {
    if (connection_.hasRobot()) {
      connection_bar_->showBattery(charge, temperature);
    }
  });
  connect(&robot_, &Robot::linkMeasured, connection_bar_, [this](const LinkFigures& figures) {
    if (connection_.hasRobot()) {
      connection_bar_->showLink(figures);
    }
  });
  connect(&robot_, &Robot::connectionChanged, this, &RemoteControl::showConnection);
  connect(&robot_, &Robot::conditionChanged, this, &RemoteControl::showCondition);
  connect(&robot_, &Robot::streamingChanged, this, &RemoteControl::showStreaming);
  connect(&robot_, &Robot::pictureArrived, picture_, &PictureView::showPicture);
  connect(&robot_, &Robot::pictureTaken, this,
          [this](const QImage&, const QString& path) { showAnswer(true, "take picture: saved as " + path); });
  connect(&robot_, &Robot::hinted, this, [this](const QString& text) { showAnswer(true, text); });
  connect(&robot_, &Robot::answered, this, &RemoteControl::showAnswer);
}

// A text field would take the space bar for itself, and so would the list of a combo box, which is a window of its own.
// A field for sentences has to take spaces, but there the Escape key stops the robot.
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
  const auto* const edit = qobject_cast<const QLineEdit*>(watched);
  const bool is_written_in = edit != nullptr && edit->property(kTakesSpaces).toBool() && !edit->text().isEmpty();
  if (!is_key || static_cast<QKeyEvent*>(event)->key() != (is_written_in ? Qt::Key_Escape : Qt::Key_Space)) {
    return QWidget::eventFilter(watched, event);
  }
  if (event->type() == QEvent::ShortcutOverride) {
    event->ignore();  // so that the key works as a shortcut
  } else if (!static_cast<QKeyEvent*>(event)->isAutoRepeat()) {
    stop();  // in another window, the shortcut does not work
  }
  return true;
}

void RemoteControl::askForWhatIsVisible() {
  std::set<Part> parts;
  if (picture_->isVisible()) {
    parts.insert(Part::kPictures);
  }
  for (const Page* page : pages_) {
    if (page->isVisible() && page->part()) {
      parts.insert(*page->part());
    }
  }
  robot_.show(parts);
}

void RemoteControl::letGoOfPads() {
  for (AxisPad* pad : findChildren<AxisPad*>()) {
    pad->letGo();
  }
}

void RemoteControl::useDriver(const QString& name_space) {
  letGoOfPads();
  driver_ = name_space;
  robot_.useDriver(name_space);
}

void RemoteControl::showConnection(const RobotConnection& connection) {
  connection_ = connection;
  connection_bar_->showConnection(connection);
  commanded_->showText(connection.name_space);
  for (QPushButton* button : {take_button_, stream_button_}) {
    allow(button, whyNot(Needs::kConnection, connection, condition_));
  }
  showCondition(condition_);
  showWhyNoPicture();
}

void RemoteControl::showCondition(const RobotCondition& condition) {
  condition_ = condition;
  const QString text = connection_.hasDriver() ? describe(condition) : QString();
  condition_text_->showText(text);
  for (Page* page : pages_) {
    page->setState(connection_, condition);
  }
  showStopButton();
}

// What a driver said before it fell silent may not be true any more. So somebody may want to stop the robot.
bool RemoteControl::isStopped() const {
  return condition_.is_stopped && connection_.hasDriver();
}

void RemoteControl::showStopButton() {
  const bool releases = isStopped();
  if (releases && !stopped_since_.isValid()) {
    stopped_since_.start();
  } else if (!releases) {
    stopped_since_.invalidate();
  }
  stop_button_->setText(releases ? "Release" : "STOP");
  const bool obeys = !connection_.isPlayback();
  stop_button_->setEnabled(obeys);
  stop_button_->setToolTip(
      !obeys     ? "Not now: " + connection_.text
      : releases ? "Lets the robot move again. Nothing starts by itself."
                 : "Immediately stops everything that moves, until Release. The space bar does the same.");
  const char* const color = !obeys ? "#9e9e9e" : releases ? "#1565c0" : "#c62828";
  stop_button_->setStyleSheet(QString("background: %1; color: white; font-weight: bold; padding: 6px 18px").arg(color));
}

void RemoteControl::pressStopButton() {
  if (isStopped() && stopped_since_.hasExpired(kNoReleaseFor)) {
    robot_.release();
  } else {
    stop();
  }
}

void RemoteControl::stop() {
  if (connection_.isPlayback()) {
    showAnswer(false, "stop: not now: " + connection_.text);
  } else {
    letGoOfPads();
    robot_.stop();
  }
}

void RemoteControl::lookAt(const QPointF& place) {
  if (const QString why_not = whyNot(Needs::kMotors, connection_, condition_); why_not.isEmpty()) {
    robot_.lookAt(place);
  } else {
    showAnswer(false, "look there: not now: " + why_not);
  }
}

void RemoteControl::showStreaming(bool on) {
  streaming_ = on;
  showWhyNoPicture();
}

void RemoteControl::showWhyNoPicture() {
  stream_button_->setText(streaming_ ? "Stop stream" : "Start stream");
  if (!connection_.hasRobot()) {
    picture_->showText(connection_.text);
  } else if (!streaming_) {
    picture_->showText("The stream is off.");
  } else if (picture_->showsText()) {
    picture_->showText("No picture has come yet.");
  }
}

void RemoteControl::showAnswer(bool is_fine, const QString& text) {
  const QString shown = text.left(kLongestAnswer);
  status_->setText(QTime::currentTime().toString("HH:mm:ss ") + shown);
  status_->setToolTip(shown);
  status_->setStyleSheet(is_fine ? "" : "color: #e53935");
}

}  // namespace aibo_driver::remote_control
