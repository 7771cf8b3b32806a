// The window, without a display and with a robot that only writes down what is wished of it.
#include "remote_control/remote_control.h"

#include <gmock/gmock.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QDir>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QFormLayout>
#include <QGroupBox>
#include <QHelpEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMouseEvent>
#include <QPaintEngine>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QSlider>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTime>
#include <QToolTip>
#include <QWheelEvent>
#include <QtTest/QTest>
#include <functional>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "movement/joint_table.h"
#include "remote_control/axis_pad.h"
#include "remote_control/joint_slider.h"
#include "unit/remote_control/fake_robot.h"

namespace aibo_driver::remote_control {
namespace {

using State = RobotConnection::State;

/// Keeps the texts that are painted, and nothing else.
class TextEngine : public QPaintEngine {
 public:
  TextEngine() : QPaintEngine(AllFeatures) {}
  bool begin(QPaintDevice*) override { return true; }
  bool end() override { return true; }
  Type type() const override { return User; }
  void updateState(const QPaintEngineState& now) override { transform_ = now.transform(); }
  void drawTextItem(const QPointF& place, const QTextItem& item) override {
    texts[item.text()] = transform_.map(place);
  }
  void drawPath(const QPainterPath&) override {}
  void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
  void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
  void drawImage(const QRectF&, const QImage&, const QRectF&, Qt::ImageConversionFlags) override {}

  QMap<QString, QPointF> texts;

 private:
  QTransform transform_;
};

class TextImage : public QImage {
 public:
  explicit TextImage(QWidget* widget) : QImage(widget->size(), Format_RGB32) { widget->render(this); }
  QPaintEngine* paintEngine() const override { return engine_.get(); }
  const QMap<QString, QPointF>& texts() const { return engine_->texts; }

 private:
  const std::unique_ptr<TextEngine> engine_ = std::make_unique<TextEngine>();
};

// The texts that a widget paints itself, and where each of them begins.
QMap<QString, QPointF> textsOn(QWidget* widget) {
  return TextImage(widget).texts();
}

class RemoteControlTest : public ::testing::Test {
 protected:
  RemoteControlTest() : window_(robot_) {
    window_.resize(480, 700);
    window_.show();
    window_.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window_));
  }

  // Shows the page with this title.
  void open(const QString& page) { find<QTabWidget>("")->setCurrentWidget(find<QWidget>(page)); }

  template <typename Widget>
  Widget* find(const QString& name) {
    auto* widget = window_.findChild<Widget*>(name);
    if (widget == nullptr) {
      throw std::runtime_error("there is no " + name.toStdString());
    }
    return widget;
  }

  // What the robot is asked for when this button is clicked.
  QStringList click(const QString& button) {
    robot_.take();
    find<QAbstractButton>(button)->click();
    return robot_.take();
  }

  QString textOf(const QString& label) { return find<QLabel>(label)->text(); }

  // Qt deletes some widgets only in its event loop.
  static void deleteLeftovers() { QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete); }

  // Until everything is laid out and painted.
  static void settle() {
    for (int round = 0; round < 4; ++round) {
      QCoreApplication::processEvents();
    }
  }

  QPoint placeOn(const QWidget* pad, double x, double y) {
    const double half = std::min(pad->width(), pad->height()) / 2.0 - 1;
    return QPoint(qRound(pad->width() / 2.0 + x * half), qRound(pad->height() / 2.0 - y * half));
  }

  FakeRobot robot_;
  RemoteControl window_;
};

TEST_F(RemoteControlTest, EachButtonAsksForWhatItSays) {
  robot_.connectIt();
  window_.setFolder("/pictures");
  EXPECT_EQ(click("take_picture"), QStringList("picture /pictures"));
  EXPECT_EQ(find<QAbstractButton>("take_picture")->text(), "Take picture");
  EXPECT_EQ(click("stop"), QStringList("stop"));
  EXPECT_EQ(click("Stand"), QStringList("stand"));
  EXPECT_EQ(click("Sit"), QStringList("sit"));
  EXPECT_EQ(click("Rest"), QStringList("rest"));
  EXPECT_EQ(click("Motors on"), QStringList("motors on"));
  EXPECT_EQ(click("Motors off"), QStringList("motors off"));
  EXPECT_TRUE(find<QWidget>("Motors on")->toolTip().startsWith("The joints hold"));
  EXPECT_TRUE(find<QWidget>("Motors off")->toolTip().endsWith("A robot that stands falls!"));
  open("Motions");
  EXPECT_EQ(click("Stop motions"), QStringList("stop motions"));
  EXPECT_EQ(click("List again"), QStringList("list"));
  open("Lights");
  for (const QString group : {"face", "back", "head", "all"}) {
    EXPECT_EQ(click(group + " on"), QStringList(group + " 1"));
    EXPECT_EQ(click(group + " off"), QStringList(group + " 0"));
  }
  EXPECT_EQ(click("Left ear"), QStringList("ears 1 0"));
  EXPECT_EQ(click("Right ear"), QStringList("ears 0 1"));
  EXPECT_EQ(click("Both ears"), QStringList("ears 1 1"));
}

TEST_F(RemoteControlTest, WithoutAConnectionOnlyStopCanBeClickedAndTheReasonIsThere) {
  const QString reason = "not connected to robot:54321: refused (is the robot on?)";
  robot_.connectIt();
  robot_.disconnectIt(State::kDisconnected, reason);
  EXPECT_EQ(textOf("connection"), reason);
  for (QPushButton* button : window_.findChildren<QPushButton*>()) {
    const bool needs_no_robot = button->objectName() == "stop" || button->text() == "Folder...";
    EXPECT_EQ(button->isEnabled(), needs_no_robot) << button->text().toStdString();
  }
  EXPECT_EQ(find<QWidget>("take_picture")->toolTip(), "Not now: " + reason);
  EXPECT_EQ(find<QWidget>("drive_pad")->toolTip(), "Not now: " + reason);
  EXPECT_EQ(click("stop"), QStringList("stop"));
  robot_.connectIt();
  EXPECT_TRUE(find<QWidget>("Stand")->isEnabled());
  EXPECT_EQ(find<QWidget>("Stand")->toolTip(), "Stands up");
}

TEST_F(RemoteControlTest, APlaybackIsShownAndCommandsNothing) {
  const QString where = "playback of walk.bag, 0:12 of 1:30";
  robot_.disconnectIt(State::kPlayback, where);
  EXPECT_EQ(textOf("connection"), where);
  Q_EMIT robot_.batteryMeasured(0.82, 31.4);
  Q_EMIT robot_.linkMeasured({29.96, 0.012, 0.034});
  Q_EMIT robot_.movementChanged("moved by /anna (walk)", false);
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", 0.7}});
  Q_EMIT robot_.touched({"chin"});
  robot_.disconnectIt(State::kPlayback, where);  // again, as its time goes on
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("Battery 82 %, 31 \u00B0C"));
  EXPECT_EQ(textOf("link"), "30.0 pictures/s, 12 ms old, 3.4 % lost");
  EXPECT_EQ(textOf("who_moves"), "moved by /anna (walk)");
  EXPECT_FALSE(find<QLabel>("who_moves")->isHidden());
  EXPECT_FALSE(find<QLabel>("movement")->isHidden());
  EXPECT_TRUE(find<AxisPad>("head_pad")->measured());
  EXPECT_TRUE(find<QLabel>("chin")->property("touched").toBool());
  robot_.take();
  for (QPushButton* button : window_.findChildren<QPushButton*>()) {
    EXPECT_EQ(button->isEnabled(), button->text() == "Folder...") << button->text().toStdString();
  }
  EXPECT_EQ(find<QWidget>("stop")->toolTip(), "Not now: " + where);
  QTest::keyClick(&window_, Qt::Key_Space);
  EXPECT_TRUE(textOf("status").endsWith("stop: not now: " + where));
  EXPECT_EQ(robot_.take(), QStringList());
  robot_.connectIt();
  EXPECT_EQ(click("stop"), QStringList("stop"));
}

TEST_F(RemoteControlTest, BeforeAnythingIsKnownOnlyStopCanBeClicked) {
  EXPECT_FALSE(find<QWidget>("take_picture")->isEnabled());
  EXPECT_FALSE(find<QWidget>("Play")->isEnabled());
  EXPECT_EQ(find<QWidget>("Stand")->toolTip(), "Not now: no driver has been found yet");
  EXPECT_TRUE(find<QWidget>("stop")->isEnabled());
}

TEST_F(RemoteControlTest, WhatVersion1CannotDoIsDisabledAndSaysSo) {
  robot_.connectIt(1);
  for (const char* name : {"Stand", "Sit", "Rest", "Motors on", "Motors off", "drive_pad", "motions", "List again",
                           "listen", "say_text", "Say", "Silence"}) {
    EXPECT_FALSE(find<QWidget>(name)->isEnabled()) << name;
    EXPECT_TRUE(find<QWidget>(name)->toolTip().contains("version 1")) << name;
  }
  for (const char* name : {"Play", "motion_name", "Stop motions", "head_pad", "take_picture", "face_1", "Left ear"}) {
    EXPECT_TRUE(find<QWidget>(name)->isEnabled()) << name;
  }
  EXPECT_NE(window_.findChild<JointSlider*>("head_pan"), nullptr) << "those of an ERS-7";
  EXPECT_EQ(robot_.take(), QStringList()) << "it cannot list its motions";
  EXPECT_EQ(textOf("connection"), "robot at robot:54321, connected (version 1)") << "it does not tell its kind";
}

TEST_F(RemoteControlTest, StopBecomesReleaseWhileTheRobotIsStoppedButNotForASecondClickInFright) {
  const auto looks = [this](const QString& color, const QString& tip) {
    return find<QWidget>("stop")->styleSheet().contains(color) && find<QWidget>("stop")->toolTip().startsWith(tip);
  };
  robot_.connectIt();
  EXPECT_TRUE(looks("#c62828", "Holds everything that moves"));
  EXPECT_EQ(click("stop"), QStringList("stop"));
  RobotCondition condition;
  condition.is_stopped = true;
  condition.stopped_by = "/gamepad";
  Q_EMIT robot_.conditionChanged(condition);
  EXPECT_EQ(find<QPushButton>("stop")->text(), "Release");
  EXPECT_TRUE(looks("#1565c0", "Lets the robot move again"));
  EXPECT_EQ(click("stop"), QStringList("stop"));
  EXPECT_TRUE(QTest::qWaitFor([this, &condition] {
    Q_EMIT robot_.conditionChanged(condition);  // the robot says so again and again
    return click("stop") == QStringList("release");
  }));
  QTest::keyClick(&window_, Qt::Key_Space);
  EXPECT_EQ(robot_.take(), QStringList("stop")) << "the space bar never releases";

  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(find<QPushButton>("stop")->text(), "Release") << "a stop outlives the connection";
  robot_.disconnectIt(State::kNoDriver, "the driver does not answer");
  EXPECT_EQ(find<QPushButton>("stop")->text(), "STOP") << "nobody knows";
  robot_.connectIt();
  EXPECT_EQ(find<QPushButton>("stop")->text(), "Release");
  Q_EMIT robot_.conditionChanged({});
  EXPECT_EQ(find<QPushButton>("stop")->text(), "STOP");
  EXPECT_EQ(click("stop"), QStringList("stop"));
  Q_EMIT robot_.conditionChanged(condition);
  EXPECT_EQ(click("stop"), QStringList("stop")) << "a second click in fright, also at the next stop";
}

TEST_F(RemoteControlTest, WhatCannotMoveNowIsDisabledAndSaysWhy) {
  robot_.connectIt();
  const auto expect_disabled = [this](const RobotCondition& condition, const QStringList& disabled,
                                      const QString& why) {
    Q_EMIT robot_.conditionChanged(condition);
    for (const char* name :
         {"Stand",  "Sit",         "Rest",    "Motors on",    "Motors off", "drive_pad", "head_pad",
          "Play",   "motion_name", "motions", "Stop motions", "List again", "face_1",    "Odd",
          "all on", "Both ears",   "listen",  "Say",          "Silence",    "say_text",  "take_picture"}) {
      EXPECT_EQ(find<QWidget>(name)->isEnabled(), !disabled.contains(name)) << name << ": " << why.toStdString();
      EXPECT_EQ(find<QWidget>(name)->toolTip() == "Not now: " + why, disabled.contains(name)) << name;
    }
    EXPECT_EQ(find<JointSlider>("head_pan")->parentWidget()->isEnabled(), !disabled.contains("head_pad"));
  };
  RobotCondition condition;
  condition.motors = RobotCondition::Motors::kOn;
  expect_disabled(condition, {}, "");
  condition.posture = RobotCondition::Posture::kCarried;
  expect_disabled(condition, {"drive_pad"}, "the robot is carried; put it on its feet");
  condition.posture = RobotCondition::Posture::kFallen;
  expect_disabled(condition, {"drive_pad"}, "the robot has fallen; put it on its feet, and click Stand");
  condition.motors = RobotCondition::Motors::kOff;
  condition.posture = RobotCondition::Posture::kLying;
  expect_disabled(condition, {"drive_pad", "head_pad", "Play"}, "the motors are off; click Stand, or Motors on");
  const auto look = [this](const QString& why) {
    robot_.take();
    Q_EMIT window_.findChild<PictureView*>()->clicked({0.5, 0.5});
    EXPECT_EQ(robot_.take(), QStringList());
    EXPECT_TRUE(textOf("status").endsWith("look there: not now: " + why));
  };
  look("the motors are off; click Stand, or Motors on");
  condition.is_stopped = true;
  condition.stopped_by = "/gamepad";
  expect_disabled(condition, {"Stand", "Sit", "Motors on", "drive_pad", "head_pad", "Play"},
                  "/gamepad has stopped the robot; click Release");
  EXPECT_EQ(textOf("condition"), "stopped by /gamepad");
  look("/gamepad has stopped the robot; click Release");
}

TEST_F(RemoteControlTest, ShowsWhatTheRobotDoesWhileThereIsADriver) {
  using Posture = RobotCondition::Posture;
  robot_.connectIt();
  RobotCondition condition;
  const std::pair<Posture, const char*> postures[] = {
      {Posture::kStanding, "stands"}, {Posture::kSitting, "sits"},      {Posture::kLying, "lies"},
      {Posture::kWalking, "walks"},   {Posture::kFallen, "has fallen"}, {Posture::kCarried, "is carried"},
      {Posture::kNotKnown, ""}};
  for (const auto& [posture, words] : postures) {
    condition.posture = posture;
    Q_EMIT robot_.conditionChanged(condition);
    EXPECT_EQ(textOf("condition"), words);
  }
  condition.motors = RobotCondition::Motors::kOn;
  Q_EMIT robot_.conditionChanged(condition);
  EXPECT_EQ(textOf("condition"), "motors on");
  condition.motors = RobotCondition::Motors::kOff;
  condition.posture = Posture::kLying;
  Q_EMIT robot_.conditionChanged(condition);
  EXPECT_EQ(textOf("condition"), "lies, motors off");
  EXPECT_EQ(find<QLabel>("condition")->toolTip(), "lies, motors off");
  robot_.disconnectIt(State::kNoDriver, "the driver does not answer");
  EXPECT_EQ(textOf("condition"), "");
}

TEST_F(RemoteControlTest, TheSpaceBarStopsWhereverTheFocusIs) {
  robot_.connectIt();
  open("Motions");
  for (const char* focus : {"Play", "motion_name", "motions", "stop", "take_picture"}) {
    auto* widget = find<QWidget>(focus);
    widget->setFocus();
    robot_.take();
    QTest::keyClick(widget, Qt::Key_Space);
    EXPECT_EQ(robot_.take(), QStringList("stop")) << focus;
    QTest::simulateEvent(widget, true, Qt::Key_Space, Qt::NoModifier, " ", true);
    EXPECT_EQ(robot_.take(), QStringList()) << "a key that is held stops once";
  }
  EXPECT_EQ(find<QLineEdit>("motion_name")->text(), "");
}

TEST_F(RemoteControlTest, TheSpaceBarStopsAlsoWhereASettingIsTyped) {
  robot_.connectIt();
  open("Camera");
  for (const char* driver : {"one driver", "the next one"}) {
    Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "", Setting::Kind::kInteger, 1, 100, {}}});
    auto* quality = find<QSpinBox>("jpeg_quality");
    quality->setFocus();
    robot_.take();
    QTest::keyClick(quality, Qt::Key_Space);
    EXPECT_EQ(robot_.take(), QStringList("stop")) << driver;
  }
}

TEST_F(RemoteControlTest, TheSpaceBarStopsAlsoInTheListOfAChoice) {
  robot_.connectIt();
  Q_EMIT robot_.driversFound({"/left", "/right"});
  auto* choice = find<QComboBox>("driver");
  choice->showPopup();
  robot_.take();
  QTest::keyClick(choice->view(), Qt::Key_Space);
  EXPECT_EQ(robot_.take(), QStringList("stop"));
  QTest::keyClick(choice->view(), Qt::Key_Escape);
  EXPECT_FALSE(choice->view()->isVisible());
}

// A hostile robot's refusals, and names of motions, settings and folders.
TEST_F(RemoteControlTest, ShowsWhatLooksLikeHtmlAsItIs) {
  const QString html = "&lt;b&gt; <img src=\"/dev/stdin\">";  // Qt takes either for HTML if it comes first
  robot_.connectIt();
  Q_EMIT robot_.movementChanged(html, false);
  Q_EMIT robot_.settingsDescribed({{html, html, Setting::Kind::kInteger, 1, 100, {}}});
  window_.setFolder(html);
  Q_EMIT robot_.answered(false, html);
  auto* tabs = find<QTabWidget>("");
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
  }
  click("folder");
  QList<QWidget*> widgets = window_.findChildren<QWidget*>();
  EXPECT_TRUE(textOf("status").endsWith(html));
  for (QWidget* widget : widgets) {
    if (auto* label = qobject_cast<QLabel*>(widget)) {
      EXPECT_EQ(label->textFormat(), Qt::PlainText) << label->text().toStdString();
    }
    QHelpEvent wants_tip(QEvent::ToolTip, QPoint(1, 1), widget->mapToGlobal(QPoint(1, 1)));
    QCoreApplication::sendEvent(widget, &wants_tip);
    EXPECT_FALSE(Qt::mightBeRichText(QToolTip::text())) << QToolTip::text().toStdString();
  }
  for (QWidget* window : QApplication::topLevelWidgets()) {
    auto* tip = qobject_cast<QLabel*>(window);
    EXPECT_TRUE(tip == nullptr || tip->textFormat() == Qt::PlainText) << tip->text().toStdString();
  }
}

TEST_F(RemoteControlTest, OfALongAnswerTheBeginningIsShown) {
  Q_EMIT robot_.answered(false, "no" + QString(5'000'000, 'x'));
  EXPECT_LT(textOf("status").size(), 2000);
  EXPECT_TRUE(textOf("status").contains("nox"));
}

TEST_F(RemoteControlTest, ChoosingAFolderBlocksNoButton) {
  open("Camera");
  window_.setFolder(QDir::tempPath());
  click("folder");
  ASSERT_EQ(window_.findChildren<QFileDialog*>().size(), 1);
  EXPECT_EQ(window_.findChild<QFileDialog*>()->directory(), QDir(QDir::tempPath()));
  EXPECT_TRUE(window_.findChild<QFileDialog*>()->isVisible());
  EXPECT_EQ(window_.findChild<QFileDialog*>()->fileMode(), QFileDialog::Directory);
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  click("folder");
  EXPECT_EQ(window_.findChildren<QFileDialog*>().size(), 1) << "one dialog is enough";
  window_.findChild<QFileDialog*>()->close();
  deleteLeftovers();
  click("folder");
  EXPECT_EQ(window_.findChildren<QFileDialog*>().size(), 1) << "it opens again";
  EXPECT_EQ(click("stop"), QStringList("stop"));
}

TEST_F(RemoteControlTest, PicturesGoToTheChosenFolderAndTheNewestCanBeOpened) {
  robot_.connectIt();
  open("Camera");
  const QString usual = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  EXPECT_EQ(textOf("path"), "Pictures are saved in " + usual + ".");
  window_.setFolder("");
  EXPECT_EQ(window_.folder(), usual);
  int changes = 0;
  QObject::connect(&window_, &RemoteControl::changed, [&changes] { ++changes; });
  click("folder");
  Q_EMIT window_.findChild<QFileDialog*>()->fileSelected("/chosen");
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(window_.folder(), "/chosen");
  EXPECT_EQ(textOf("path"), "Pictures are saved in /chosen.");
  EXPECT_EQ(click("take_picture"), QStringList("picture /chosen"));
  EXPECT_FALSE(find<QWidget>("thumbnail")->isEnabled());
  Q_EMIT robot_.pictureTaken(QImage(208, 160, QImage::Format_RGB32), "/chosen/a.jpg");
  window_.setFolder("/other");
  EXPECT_EQ(textOf("path"), "/chosen/a.jpg");
  EXPECT_EQ(find<QWidget>("thumbnail")->toolTip(), "Opens /chosen/a.jpg");
  EXPECT_FALSE(find<QAbstractButton>("thumbnail")->icon().isNull());
  QTextBrowser viewer;
  QDesktopServices::setUrlHandler("file", &viewer, "setSource");
  click("thumbnail");
  EXPECT_EQ(viewer.source(), QUrl("file:///chosen/a.jpg"));
  const qint64 icon = find<QAbstractButton>("thumbnail")->icon().cacheKey();
  Q_EMIT robot_.pictureTaken(QImage(104, 80, QImage::Format_RGB32), "/other/b.jpg");
  click("thumbnail");
  QDesktopServices::unsetUrlHandler("file");
  EXPECT_EQ(viewer.source(), QUrl("file:///other/b.jpg")) << "the last one";
  EXPECT_EQ(textOf("path"), "/other/b.jpg");
  EXPECT_EQ(find<QWidget>("thumbnail")->toolTip(), "Opens /other/b.jpg");
  EXPECT_NE(find<QAbstractButton>("thumbnail")->icon().cacheKey(), icon);
}

TEST_F(RemoteControlTest, TheStreamsButtonFollowsTheRobotNotTheClick) {
  robot_.connectIt();
  Q_EMIT robot_.streamingChanged(true);
  EXPECT_EQ(click("stream"), QStringList("stream off"));
  EXPECT_EQ(find<QAbstractButton>("stream")->text(), "Stop stream");
  Q_EMIT robot_.streamingChanged(false);
  EXPECT_EQ(find<QAbstractButton>("stream")->text(), "Start stream");
  EXPECT_EQ(click("stream"), QStringList("stream on"));
}

TEST_F(RemoteControlTest, ThePadWalksWhileItIsHeldAndStopsOnce) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("drive_pad");
  robot_.take();
  QTest::mousePress(pad, Qt::LeftButton, {}, placeOn(pad, 0, 1));
  EXPECT_EQ(robot_.take(), QStringList("walk 0.15 0.00 0.00"));
  EXPECT_TRUE(QTest::qWaitFor([this] { return robot_.wishes.size() >= 10; }, 5000)) << "or the robot would stop";
  QTest::mousePress(pad, Qt::RightButton, {}, placeOn(pad, 1, 0));
  EXPECT_EQ(pad->button(), Qt::LeftButton) << "the first button counts";
  QMouseEvent move(QEvent::MouseMove, placeOn(pad, -1.2, 0), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(pad, &move);
  EXPECT_TRUE(QTest::qWaitFor([this] { return robot_.wishes.contains("walk 0.00 0.00 1.00"); }));
  QTest::mouseRelease(pad, Qt::LeftButton);
  EXPECT_EQ(robot_.take().last(), "walk 0.00 0.00 0.00");
  QApplication::sendEvent(pad, &move);
  QTest::qWait(250);
  EXPECT_EQ(robot_.take(), QStringList()) << "then it is silent, also under the mouse";
}

TEST_F(RemoteControlTest, StopAndAnotherDriverLetGoOfThePads) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("drive_pad");
  const auto hold_until = [&](const std::function<void()>& happen) {
    QTest::mousePress(pad, Qt::LeftButton, {}, placeOn(pad, 0, 1));
    robot_.take();
    happen();
    EXPECT_FALSE(pad->isHeld());
    QTest::mouseRelease(pad, Qt::LeftButton);
    return robot_.take();
  };
  EXPECT_EQ(hold_until([this] { QTest::keyClick(&window_, Qt::Key_Space); }),
            QStringList({"walk 0.00 0.00 0.00", "stop"}));
  EXPECT_EQ(hold_until([this] { window_.useDriver("/bert"); }), QStringList({"walk 0.00 0.00 0.00", "use /bert"}));
}

TEST_F(RemoteControlTest, ShowsThatTheMasterDoesNotAnswerThoughTheDriverDoes) {
  RobotConnection connection;
  connection.state = State::kConnected;
  connection.master_answers = false;
  Q_EMIT robot_.connectionChanged(connection);
  EXPECT_TRUE(textOf("connection").contains("the ROS master does not answer"));
  EXPECT_TRUE(find<QWidget>("drive_pad")->isEnabled());
}

TEST_F(RemoteControlTest, EachSideOfThePadHasItsDirectionAndTheMiddleIsStill) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("drive_pad");
  const auto press = [&](Qt::MouseButton button, double x, double y) {
    robot_.take();
    QTest::mousePress(pad, button, {}, placeOn(pad, x, y));
    const QStringList wishes = robot_.take();
    QTest::mouseRelease(pad, button);
    return wishes;
  };
  EXPECT_EQ(press(Qt::LeftButton, 0, -1), QStringList("walk -0.15 0.00 0.00"));
  EXPECT_EQ(press(Qt::LeftButton, 1, 0), QStringList("walk 0.00 0.00 -1.00"));
  EXPECT_EQ(press(Qt::RightButton, -1, 0), QStringList("walk 0.00 0.06 0.00"));
  EXPECT_EQ(press(Qt::LeftButton, 0.05, -0.05), QStringList("walk 0.00 0.00 0.00"));
  EXPECT_EQ(press(Qt::RightButton, -0.2, 0.6), QStringList("walk 0.09 0.01 0.00")) << "both at once";
  QMap<QString, QPointF> texts = textsOn(pad);
  EXPECT_LT(texts.value("forward").y(), texts.value("left").y());
  EXPECT_LT(texts.value("left").y(), texts.value("backward").y());
  EXPECT_LT(texts.value("left").x(), texts.value("forward").x());
  EXPECT_LT(texts.value("forward").x(), texts.value("right").x());
  const auto is_circled = [&] {
    const QColor color = pad->grab().toImage().pixelColor(placeOn(pad, 0.5, 0.5) + QPoint(10, 0));
    return color == pad->palette().color(QPalette::Highlight);
  };
  QTest::mousePress(pad, Qt::LeftButton, {}, placeOn(pad, 0.5, 0.5));
  EXPECT_TRUE(is_circled());
  QTest::mouseRelease(pad, Qt::LeftButton);
  EXPECT_FALSE(is_circled());
}

TEST_F(RemoteControlTest, TheRightButtonStepsToTheSides) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("drive_pad");
  robot_.take();
  QTest::mousePress(pad, Qt::RightButton, {}, placeOn(pad, 1, 0));
  EXPECT_EQ(robot_.take(), QStringList("walk 0.00 -0.06 0.00"));
  QTest::mouseRelease(pad, Qt::LeftButton);
  EXPECT_TRUE(pad->isHeld()) << "another button than the one that holds it";
}

// A dead man's switch also opens when the mouse's release cannot be seen.
TEST_F(RemoteControlTest, ThePadStopsWhenItsPageIsLeftOrDisabledOrTheWindowLosesTheFocus) {
  const auto hold = [this] {
    robot_.connectIt();
    open("Move");
    auto* pad = find<AxisPad>("drive_pad");
    QTest::mouseRelease(pad, Qt::LeftButton);
    QTest::mousePress(pad, Qt::LeftButton, {}, placeOn(pad, 0, 1));
    robot_.take();
    EXPECT_TRUE(QTest::qWaitFor([this] { return !robot_.take().empty(); })) << "each hold is repeated";
    return pad;
  };
  hold();
  open("Camera");
  EXPECT_EQ(robot_.take(), QStringList("walk 0.00 0.00 0.00"));
  hold();
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(robot_.take(), QStringList("walk 0.00 0.00 0.00"));
  auto* pad = hold();
  QEvent deactivation(QEvent::WindowDeactivate);
  QApplication::sendEvent(pad, &deactivation);
  EXPECT_EQ(robot_.take(), QStringList("walk 0.00 0.00 0.00"));
}

TEST_F(RemoteControlTest, TheHeadsPadPointsWithinTheLimitsAndLeftIsPositive) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("head_pad");
  robot_.take();
  QTest::mouseClick(pad, Qt::LeftButton, {}, placeOn(pad, -1, 1));
  EXPECT_EQ(robot_.take(), QStringList("head_pan 1.5, head_tilt 0.8"));
  QTest::mouseClick(pad, Qt::LeftButton, {}, placeOn(pad, 1, -1));
  EXPECT_EQ(robot_.take(), QStringList("head_pan -1.5, head_tilt -0.3"));
  const QMap<QString, QPointF> texts = textsOn(pad);
  EXPECT_LT(texts.value("up").y(), texts.value("down").y());
  EXPECT_LT(texts.value("left").x(), texts.value("right").x());
}

TEST_F(RemoteControlTest, TheHeadsPadShowsWhereTheHeadIsAndForgetsItWithTheConnection) {
  robot_.connectIt();
  auto* pad = find<AxisPad>("head_pad");
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", 0.7}});
  ASSERT_TRUE(pad->measured());
  EXPECT_NEAR(pad->measured()->x(), -0.5, 0.05) << "the left is positive for the robot";
  EXPECT_GT(pad->measured()->y(), 0.7);
  const auto is_marked = [&](double x, double y) {
    return pad->grab().toImage().pixelColor(placeOn(pad, x, y)) == QColor("#4caf50");
  };
  EXPECT_TRUE(is_marked(pad->measured()->x(), pad->measured()->y()));
  EXPECT_FALSE(is_marked(-pad->measured()->x(), pad->measured()->y()));
  EXPECT_FALSE(is_marked(pad->measured()->x(), -pad->measured()->y()));
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", 0.1}});
  EXPECT_LT(pad->measured()->y(), 0) << "it nods";
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.4}, {"head_tilt", 0.1}});
  EXPECT_NEAR(pad->measured()->x(), -0.25, 0.03);
  const QPointF before = *pad->measured();
  Q_EMIT robot_.jointsMeasured({{"head_pan", -0.8}});
  Q_EMIT robot_.jointsMeasured({{"head_tilt", -0.2}});
  EXPECT_EQ(*pad->measured(), before) << "half of the head's place is none";
  Q_EMIT robot_.jointsMeasured({{"head_pan", -9}, {"head_tilt", 0.3}});
  EXPECT_TRUE(is_marked(1, pad->measured()->y())) << "at the edge";
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", -9}});
  EXPECT_TRUE(is_marked(pad->measured()->x(), -1));
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_FALSE(pad->measured());
  Q_EMIT robot_.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", 0.7}});
  EXPECT_FALSE(pad->measured()) << "it was on its way";
}

TEST_F(RemoteControlTest, AnotherKindOfRobotHasItsOwnLimits) {
  robot_.connectIt(2, "ERS-210");
  const movement::JointTable table("ERS-210", 1);
  const movement::JointProperties& pan = table[*table.findByName("head_pan")];
  const movement::JointProperties& tilt = table[*table.findByName("head_tilt")];
  auto* pad = find<AxisPad>("head_pad");
  robot_.take();
  QTest::mouseClick(pad, Qt::LeftButton, {}, placeOn(pad, -1, -1));
  EXPECT_EQ(robot_.take(),
            QStringList(QString("head_pan %1, head_tilt %2").arg(pan.highest, 0, 'f', 1).arg(tilt.lowest, 0, 'f', 1)));
  auto* slider = find<JointSlider>("head_tilt");
  EXPECT_EQ(slider->slider()->minimum(), qRound(1000 * tilt.lowest));
  robot_.connectIt(2, "ERS-210");
  deleteLeftovers();
  EXPECT_EQ(find<JointSlider>("head_tilt"), slider) << "somebody may hold it";
}

TEST_F(RemoteControlTest, AClickIntoThePictureLooksThere) {
  robot_.connectIt();
  auto* view = window_.findChild<PictureView*>();
  robot_.take();
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
  EXPECT_EQ(robot_.take(), QStringList()) << "there is none yet";
  Q_EMIT robot_.streamingChanged(true);
  Q_EMIT robot_.pictureArrived(QImage(208, 160, QImage::Format_RGB32));
  const double scale = std::min(view->width() / 208.0, view->height() / 160.0);
  const QPoint half(qRound(208 * scale / 2), qRound(160 * scale / 2));
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center() - QPoint(half.x() * 6 / 10, half.y() * 2 / 10));
  EXPECT_EQ(robot_.take(), QStringList("look 0.2 0.4"));
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center() - half - QPoint(3, 0));
  EXPECT_EQ(robot_.take(), QStringList()) << "beside the picture";
  Q_EMIT robot_.streamingChanged(false);
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
  EXPECT_EQ(robot_.take(), QStringList()) << "it is told that the stream is off";
  Q_EMIT robot_.pictureArrived(QImage(208, 160, QImage::Format_RGB32));
  QTest::mouseClick(view, Qt::RightButton, {}, view->rect().center());
  EXPECT_EQ(robot_.take(), QStringList());
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
  EXPECT_EQ(robot_.take(), QStringList("look 0.5 0.5"));
  robot_.disconnectIt(State::kDisconnected, "gone");
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
  EXPECT_EQ(robot_.take(), QStringList()) << "a text is shown instead";
}

TEST_F(RemoteControlTest, ThePictureFillsTheMiddleOfItsRoom) {
  robot_.connectIt();
  Q_EMIT robot_.streamingChanged(true);
  settle();  // a view that gets another size is painted as a whole
  QImage picture(208, 160, QImage::Format_RGB32);
  auto* view = window_.findChild<PictureView*>();
  const auto shows = [view](const QPoint& place) { return view->grab().toImage().pixelColor(place); };
  const QPoint corner =
      view->width() * 160 > view->height() * 208 ? QPoint(2, view->height() / 2) : QPoint(view->width() / 2, 2);
  for (const QColor& color : {QColor(Qt::red), QColor(Qt::blue)}) {
    picture.fill(color);
    Q_EMIT robot_.pictureArrived(picture);
    EXPECT_EQ(shows(view->rect().center()), color);
    EXPECT_LT(shows(corner).value(), 50) << "beside it is nothing";
  }
  // Only what has changed is painted again.
  const auto is_on_screen = [&](const QPoint& place, const QColor& color) {
    return QTest::qWaitFor([&] {
      const QImage screen = window_.screen()->grabWindow(window_.winId()).toImage();
      return screen.pixelColor(view->mapTo(&window_, place)) == color;
    });
  };
  const QPoint center = view->rect().center();
  EXPECT_TRUE(is_on_screen(center - QPoint(0, 60), Qt::blue));
  const QColor background = shows(corner);
  for (const QSize& size : {QSize(20, 160), QSize(208, 160), QSize(208, 40)}) {
    QImage other(size, QImage::Format_RGB32);
    other.fill(Qt::green);
    Q_EMIT robot_.pictureArrived(other);
    EXPECT_TRUE(is_on_screen(center - QPoint(0, 60), size.height() == 40 ? background : Qt::green));
    EXPECT_TRUE(is_on_screen(center - QPoint(60, 0), size.width() == 20 ? background : Qt::green));
  }
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_NE(shows(center), QColor(Qt::green));
}

TEST_F(RemoteControlTest, WhereThereIsNoPictureIsTheReason) {
  auto* view = window_.findChild<PictureView*>();
  const auto text = [view] { return QStringList(textsOn(view).keys()).join(","); };
  EXPECT_EQ(text(), "no driver has been found yet");
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(text(), "gone");
  robot_.connectIt();
  EXPECT_EQ(text(), "The stream is off.");
  Q_EMIT robot_.streamingChanged(true);
  EXPECT_EQ(text(), "No picture has come yet.");
  Q_EMIT robot_.pictureArrived(QImage(208, 160, QImage::Format_RGB32));
  EXPECT_EQ(text(), "");
  Q_EMIT robot_.streamingChanged(true);
  EXPECT_EQ(text(), "");
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(text(), "gone");
  robot_.connectIt();
  EXPECT_EQ(text(), "No picture has come yet.") << "the old one says nothing of this connection";
}

TEST_F(RemoteControlTest, EachPageFitsOnASmallScreen) {
  robot_.connectIt();
  for (const char* name : {"near", "far", "chest"}) {
    Q_EMIT robot_.distanceMeasured({name, 0.25, 0.5});
  }
  for (const char* page : {"Move", "Camera", "Motions", "Joints", "Lights", "Sensors", "Sound"}) {
    open(page);
    EXPECT_LE(window_.minimumSizeHint().height(), 500) << page << ", in rviz on 1024x600 pixels";
    EXPECT_LE(window_.minimumSizeHint().width(), 480) << page;
  }
  window_.resize(window_.minimumSizeHint());
  const auto* tabs = find<QTabWidget>("")->tabBar();
  EXPECT_LE(tabs->sizeHint().width(), tabs->width()) << "some titles are hidden";
}

const QString kLongWord(300, 'x');
const QString kLongText = QString("why it did not work and what to check ").repeated(20);

/// What can happen to the window while somebody moves the mouse to STOP.
const std::vector<std::pair<const char*, std::function<void(FakeRobot&)>>> kHappenings = {
    {"it is connected", [](FakeRobot& robot) { robot.connectIt(); }},
    {"figures",
     [](FakeRobot& robot) {
       Q_EMIT robot.batteryMeasured(0.1, 12345);
       Q_EMIT robot.linkMeasured({12345.6, 999.999, 0.123});
       Q_EMIT robot.streamingChanged(true);
       Q_EMIT robot.pictureArrived(QImage(416, 320, QImage::Format_RGB32));
       Q_EMIT robot.distanceMeasured({"near", 0.25, 0.5});
     }},
    {"long names",
     [](FakeRobot& robot) {
       RobotConnection connection;
       connection.state = State::kConnected;
       connection.name_space = connection.robot = connection.address = connection.text = "/" + kLongWord;
       connection.protocol_version = 2;
       Q_EMIT robot.connectionChanged(connection);
       Q_EMIT robot.driversFound({"/" + kLongWord, "/" + kLongText});
       Q_EMIT robot.motionsListed({kLongWord, kLongText});
       Q_EMIT robot.pictureTaken(QImage(416, 320, QImage::Format_RGB32), "/" + kLongWord);
       Q_EMIT robot.settingsDescribed({{kLongWord, kLongWord, Setting::Kind::kChoice, 0, 0, {{kLongWord, 1}}}});
       Q_EMIT robot.distanceMeasured({kLongWord, 0.25, 0.5});
     }},
    {"a movement", [](FakeRobot& robot) { Q_EMIT robot.movementChanged("moved by /" + kLongWord + kLongText, true); }},
    {"a refusal", [](FakeRobot& robot) { Q_EMIT robot.answered(false, kLongText); }},
    {"a refusal in one word", [](FakeRobot& robot) { Q_EMIT robot.answered(false, kLongWord); }},
    {"it is stopped",
     [](FakeRobot& robot) {
       RobotCondition condition;
       condition.is_stopped = true;
       condition.stopped_by = "/" + kLongWord;
       Q_EMIT robot.conditionChanged(condition);
     }},
    {"it is released", [](FakeRobot& robot) { Q_EMIT robot.conditionChanged({}); }},
    {"the robot is silent", [](FakeRobot& robot) { robot.disconnectIt(State::kDisconnected, kLongText); }},
    {"the driver is gone", [](FakeRobot& robot) { robot.disconnectIt(State::kNoDriver, kLongText); }},
    {"the master is gone", [](FakeRobot& robot) { robot.disconnectIt(State::kNoMaster, kLongWord); }},
    {"a playback", [](FakeRobot& robot) { robot.disconnectIt(State::kPlayback, kLongWord); }},
    {"a robot of version 1", [](FakeRobot& robot) { robot.connectIt(1); }},
    {"another kind of robot", [](FakeRobot& robot) { robot.connectIt(2, "ERS-210"); }},
    {"a kind that nobody knows", [](FakeRobot& robot) { robot.connectIt(2, "R2D2"); }}};

// With the usual and with a doubled font, as on a screen of high resolution.
TEST(RemoteControlLayout, StopAndTheTabsStayInTheirPlacesWhateverHappens) {
  const QFont usual = QApplication::font();
  for (const int factor : {1, 2}) {
    QFont font = usual;
    font.setPointSizeF(factor * usual.pointSizeF());
    QApplication::setFont(font);
    for (const QSize& size : {QSize(0, 0), QSize(420, 600), QSize(1024, 600), QSize(1280, 800), QSize(1920, 1080)}) {
      FakeRobot robot;
      RemoteControl window(robot);
      window.resize(size);
      window.show();
      auto* tabs = window.findChild<QTabWidget*>();
      const auto places = [&] {
        for (int round = 0; round < 4; ++round) {
          QCoreApplication::processEvents();
        }
        const auto place = [&window](const QWidget* widget) {
          return QRect(widget->mapTo(&window, QPoint()), widget->size());
        };
        return QVector<QRect>{window.rect(), place(window.findChild<QWidget*>("stop")), place(tabs->tabBar()),
                              place(window.findChild<QWidget*>("status"))};
      };
      const QVector<QRect> before = places();
      EXPECT_EQ(before[0] & before[1], before[1]) << "all of STOP can be seen";
      for (const auto& [name, happen] : kHappenings) {
        happen(robot);
        for (int page = 0; page < tabs->count(); ++page) {
          tabs->setCurrentIndex(page);
          ASSERT_EQ(places(), before) << name << " on page " << page << " of " << size.width() << ", font x" << factor;
        }
      }
    }
  }
  QApplication::setFont(usual);
}

TEST_F(RemoteControlTest, OnlyWhatIsVisibleIsAskedFor) {
  robot_.connectIt();
  open("Move");
  EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, Part::kJoints}));
  open("Sensors");
  EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, Part::kSensors}));
  open("Joints");
  EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, Part::kJoints}));
  for (int round = 0; round < 2; ++round) {
    window_.hide();
    EXPECT_EQ(robot_.visible, std::set<Part>());
    window_.show();
    EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, Part::kJoints}));
  }
}

TEST_F(RemoteControlTest, MotionsAreListedOnceForAConnectionAndPlayedByDoubleClickOrButton) {
  robot_.connectIt();
  EXPECT_EQ(robot_.take(), QStringList("list"));
  robot_.connectIt();
  EXPECT_EQ(robot_.take(), QStringList());
  open("Motions");
  Q_EMIT robot_.motionsListed({"OLD.MTN"});
  Q_EMIT robot_.motionsListed({"NOD.MTN", "WAG.MTN"});
  find<QListWidget>("motions")->setCurrentRow(1);
  EXPECT_EQ(click("Play"), QStringList("play WAG.MTN 1"));
  find<QWidget>("Motions")->findChild<QSpinBox*>()->setValue(3);
  EXPECT_EQ(click("Play"), QStringList("play WAG.MTN 3"));
  find<QLineEdit>("motion_name")->setText(" SIT.MTN ");
  QTest::keyClick(find<QLineEdit>("motion_name"), Qt::Key_Return);
  EXPECT_EQ(robot_.take(), QStringList("play SIT.MTN 3"));
  Q_EMIT find<QListWidget>("motions")->itemDoubleClicked(find<QListWidget>("motions")->item(1));
  EXPECT_EQ(robot_.take(), QStringList("play WAG.MTN 3")) << "what was written before does not count";
  find<QLineEdit>("motion_name")->setText(" ");
  EXPECT_EQ(click("Play"), QStringList()) << "no name";
  Q_EMIT robot_.movementChanged("motion WAG.MTN", true);
  EXPECT_EQ(textOf("movement"), "Now: motion WAG.MTN");
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(find<QListWidget>("motions")->count(), 0);
  EXPECT_TRUE(find<QLabel>("movement")->isHidden());
  Q_EMIT robot_.movementChanged("nothing moves the robot", false);
  EXPECT_TRUE(find<QLabel>("movement")->isHidden());
  robot_.connectIt();
  EXPECT_FALSE(find<QLabel>("movement")->isHidden()) << "what came before the connection counts";
  EXPECT_EQ(robot_.take(), QStringList("list")) << "it may be another robot, or have another stick";
  Q_EMIT robot_.movementChanged("", false);
  EXPECT_EQ(textOf("movement"), "") << "another driver has not said it yet";
  robot_.connectIt(1);
  Q_EMIT robot_.movementChanged("motion WAG.MTN", true);
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_TRUE(find<QLabel>("movement")->isHidden()) << "also in version 1";
}

TEST_F(RemoteControlTest, TheMovePageSaysWhoMovesTheRobot) {
  Q_EMIT robot_.movementChanged("moved by /anna (walk); last ended: posture stand, done", false);
  EXPECT_TRUE(find<QLabel>("who_moves")->isHidden()) << "there is no connection";
  robot_.connectIt();
  open("Move");
  EXPECT_EQ(textOf("who_moves"), "moved by /anna (walk)");
  EXPECT_TRUE(find<QLabel>("who_moves")->toolTip().endsWith("last ended: posture stand, done"));
  Q_EMIT robot_.movementChanged("moved by /" + QString(300, 'a') + " (walk)", false);
  EXPECT_TRUE(find<QLabel>("who_moves")->toolTip().endsWith("aaa (walk)")) << "all of it";
  const QStringList shown = textsOn(find<QWidget>("who_moves")).keys();
  EXPECT_TRUE(shown.join("").startsWith("moved by /aaa"));
  EXPECT_TRUE(shown.join("").endsWith(QString::fromUtf8("\u2026"))) << shown.join("").toStdString();
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_TRUE(find<QLabel>("who_moves")->isHidden());
}

TEST_F(RemoteControlTest, TheStatusRepeatsAnAnswer) {
  const auto now = [] { return QTime::currentTime().toString("HH:mm:ss "); };
  const QString before = now();
  Q_EMIT robot_.answered(false, "stand: the robot fell");
  const QString text = textOf("status");
  EXPECT_TRUE(text == before + "stand: the robot fell" || text == now() + "stand: the robot fell")
      << text.toStdString();
  EXPECT_EQ(find<QLabel>("status")->toolTip(), "stand: the robot fell");
  EXPECT_TRUE(find<QLabel>("status")->styleSheet().contains("color"));
  Q_EMIT robot_.answered(true, "stand: the robot stands");
  EXPECT_EQ(find<QLabel>("status")->styleSheet(), "") << "it has succeeded";
  Q_EMIT robot_.answered(false, "stand: the robot fell");
  Q_EMIT robot_.hinted("walk: the floor ends ahead");
  EXPECT_TRUE(textOf("status").endsWith("walk: the floor ends ahead"));
  EXPECT_EQ(find<QLabel>("status")->styleSheet(), "") << "nothing is broken";
  Q_EMIT robot_.answered(true, "stand: the robot stands");
  EXPECT_EQ(find<QLabel>("status")->toolTip(), "stand: the robot stands");
}

TEST_F(RemoteControlTest, TheConnectionIsShownInWordsAndFigures) {
  robot_.connectIt();
  Q_EMIT robot_.batteryMeasured(0.82, 31.4);
  Q_EMIT robot_.linkMeasured({29.96, 0.012, 0.034});
  EXPECT_EQ(textOf("connection"), "ERS-7 at robot:54321, connected (version 2)");
  EXPECT_EQ(textOf("commanded"), "/aibo") << "beside STOP";
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("Battery 82 %, 31 \u00B0C"));
  EXPECT_EQ(textOf("link"), "30.0 pictures/s, 12 ms old, 3.4 % lost");
  EXPECT_EQ(find<QLabel>("battery")->styleSheet(), "");
  Q_EMIT robot_.batteryMeasured(0.19, 31.4);
  EXPECT_TRUE(find<QLabel>("battery")->styleSheet().contains("color"));
  Q_EMIT robot_.batteryMeasured(0.9, 31.4);
  EXPECT_EQ(find<QLabel>("battery")->styleSheet(), "") << "it was charged";
  Q_EMIT robot_.batteryMeasured(kUnknown, kUnknown);
  EXPECT_EQ(textOf("battery"), "");
  EXPECT_EQ(find<QLabel>("battery")->styleSheet(), "");
  Q_EMIT robot_.batteryMeasured(0.9, kUnknown);
  EXPECT_EQ(textOf("battery"), "Battery 90 %");
  Q_EMIT robot_.batteryMeasured(kUnknown, 31.4);
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("31 \u00B0C"));
  Q_EMIT robot_.linkMeasured({0, kUnknown, kUnknown});
  EXPECT_EQ(textOf("link"), "0.0 pictures/s");
  Q_EMIT robot_.linkMeasured({30, 0.01, 0});
  EXPECT_EQ(textOf("link"), "30.0 pictures/s, 10 ms old, 0 % lost");
  robot_.disconnectIt(State::kNoDriver, "the driver in /aibo does not answer");
  Q_EMIT robot_.linkMeasured({0, kUnknown, kUnknown});
  EXPECT_EQ(textOf("link"), "");
}

TEST_F(RemoteControlTest, TheLastReadingOfTheBatteryStaysWhileTheRobotIsGone) {
  robot_.connectIt();
  Q_EMIT robot_.batteryMeasured(0.03, 31.4);
  robot_.disconnectIt(State::kDisconnected, "the robot said: the battery is low");
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("Battery 3 %, 31 \u00B0C"));
  EXPECT_FALSE(find<QLabel>("battery")->isEnabled());
  robot_.connectIt();
  EXPECT_TRUE(find<QLabel>("battery")->isEnabled());
}

TEST_F(RemoteControlTest, ALampTellsTheKindOfConnection) {
  const auto color = [this] {
    for (const QLabel* label : window_.findChildren<QLabel*>()) {
      if (label->text() == QString::fromUtf8("\u25CF")) {
        return label->styleSheet();
      }
    }
    return QString();
  };
  const QString red = color();
  robot_.connectIt();
  const QString green = color();
  robot_.disconnectIt(State::kConnecting, "it tries");
  const QString yellow = color();
  robot_.disconnectIt(State::kPlayback, "a bag");
  EXPECT_EQ((std::set<QString>{red, green, yellow, color()}).size(), 4U);
  robot_.disconnectIt(State::kWaiting, "not heard yet");
  EXPECT_EQ(color(), yellow);
  for (const State state : {State::kDisconnected, State::kNoDriver, State::kNoMaster}) {
    robot_.disconnectIt(state, "gone");
    EXPECT_EQ(color(), red);
  }
}

TEST_F(RemoteControlTest, TheChooserHasTheDriversThatRunAndTheOneInUse) {
  EXPECT_FALSE(find<QComboBox>("driver")->isEnabled()) << "there is none";
  robot_.disconnectIt(State::kNoDriver, "the driver in /aibo does not answer");
  Q_EMIT robot_.driversFound({"/left", "/right"});
  auto* chooser = find<QComboBox>("driver");
  EXPECT_TRUE(chooser->isEnabled());
  EXPECT_EQ(chooser->currentText(), "/aibo");
  robot_.take();
  Q_EMIT chooser->activated(chooser->findText("/right"));
  EXPECT_EQ(robot_.take(), QStringList("use /right"));
  EXPECT_EQ(window_.driver(), "/right");
  robot_.connectIt();
  Q_EMIT robot_.driversFound({"/aardvark", "/aibo", "/right"});
  EXPECT_EQ(chooser->currentText(), "/aibo") << "not the first of them";
  EXPECT_EQ(chooser->count(), 3) << "none of those from before";
  robot_.take();
  chooser->showPopup();
  QTest::keyClick(chooser->view(), Qt::Key_Down);
  robot_.disconnectIt(State::kPlayback, "playback of walk.bag, 0:13 of 1:30");
  QTest::keyClick(chooser->view(), Qt::Key_Return);
  EXPECT_EQ(robot_.take(), QStringList("use /right")) << "its list is not disturbed while somebody chooses";
}

TEST_F(RemoteControlTest, NothingCoversAnythingElse) {
  robot_.connectIt();
  auto* tabs = find<QTabWidget>("");
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
    QCoreApplication::processEvents();
    const auto widgets = window_.findChildren<QWidget*>();
    for (const QWidget* one : widgets) {
      for (const QWidget* other : widgets) {
        if (one < other && one->parent() == other->parent() && one->isVisible() && other->isVisible()) {
          EXPECT_FALSE(one->geometry().intersects(other->geometry()))
              << one->objectName().toStdString() << " and " << other->objectName().toStdString();
        }
      }
    }
  }
}

TEST_F(RemoteControlTest, TheMicrophonesAreOpenOnlyWhileTheUserListens) {
  robot_.connectIt();
  open("Sound");
  EXPECT_EQ(robot_.visible.count(Part::kMicrophones), 0u);
  Q_EMIT robot_.heard(-20);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "") << "somebody else listens";
  EXPECT_EQ(find<QProgressBar>("level")->value(), find<QProgressBar>("level")->minimum());
  find<QAbstractButton>("listen")->click();
  EXPECT_EQ(robot_.visible.count(Part::kMicrophones), 1u);
  Q_EMIT robot_.heard(-20.4);
  EXPECT_EQ(find<QProgressBar>("level")->value(), -20);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "-20 dB");
  const auto color = [this] { return find<QProgressBar>("level")->palette().color(QPalette::Highlight); };
  const QColor usual = color();
  Q_EMIT robot_.heard(-5);
  EXPECT_NE(color(), usual) << "it is too loud";
  Q_EMIT robot_.heard(-90);
  EXPECT_EQ(find<QProgressBar>("level")->value(), find<QProgressBar>("level")->minimum());
  EXPECT_EQ(color(), usual);
  find<QAbstractButton>("listen")->click();
  find<QAbstractButton>("listen")->click();
  EXPECT_EQ(find<QProgressBar>("level")->value(), find<QProgressBar>("level")->minimum()) << "nothing is heard yet";
  QElapsedTimer patience;
  patience.start();
  EXPECT_TRUE(QTest::qWaitFor([this] { return find<QProgressBar>("level")->format().contains("ALLOW_MICROPHONE=yes"); },
                              10000));
  EXPECT_GE(patience.elapsed(), 2500) << "sound may take its time";
  Q_EMIT robot_.heard(-20);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "-20 dB");
  QTest::qWait(600);
  patience.start();
  Q_EMIT robot_.heard(-21);
  EXPECT_TRUE(
      QTest::qWaitFor([this] { return find<QProgressBar>("level")->format().contains("ALLOW_MICROPHONE=yes"); }, 10000))
      << "the sound has ended";
  EXPECT_GE(patience.elapsed(), 2600) << "silence begins when the sound has ended";
  EXPECT_EQ(find<QProgressBar>("level")->value(), find<QProgressBar>("level")->minimum());
  open("Move");
  EXPECT_EQ(robot_.visible.count(Part::kMicrophones), 0u);
  open("Sound");
  EXPECT_EQ(robot_.visible.count(Part::kMicrophones), 1u);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "listening...") << "it has not waited for sound meanwhile";
  Q_EMIT robot_.heard(-20);
  Q_EMIT robot_.conditionChanged({});
  EXPECT_EQ(find<QProgressBar>("level")->format(), "-20 dB") << "the connection is the same";
  robot_.disconnectIt(State::kDisconnected, "gone");
  Q_EMIT robot_.heard(-20);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "") << "there is no robot to listen to";
  EXPECT_FALSE(QTest::qWaitFor([this] { return find<QProgressBar>("level")->format() != ""; }, 3500))
      << "silence is noticed after 3 s, but only that of a robot";
  robot_.connectIt();
  EXPECT_EQ(find<QProgressBar>("level")->format(), "listening...");
  find<QAbstractButton>("listen")->click();
  EXPECT_EQ(robot_.visible.count(Part::kMicrophones), 0u);
}

TEST_F(RemoteControlTest, TheRobotSaysASentenceAndTheEscapeKeyStopsIt) {
  robot_.connectIt();
  open("Sound");
  auto* text = find<QLineEdit>("say_text");
  text->setFocus();
  robot_.take();
  QTest::keyClick(text, Qt::Key_Space);
  EXPECT_EQ(robot_.take(), QStringList("stop")) << "nothing has been written";
  QTest::keyClicks(text, "Good dog");
  EXPECT_EQ(robot_.take(), QStringList());
  QTest::keyClick(text, Qt::Key_Escape);
  EXPECT_EQ(robot_.take(), QStringList("stop"));
  QTest::keyClick(text, Qt::Key_Return);
  EXPECT_EQ(robot_.take(), QStringList("say Good dog"));
  EXPECT_EQ(text->selectedText(), "Good dog") << "the next sentence replaces it";
  text->setText(QString(2000, 'a'));
  EXPECT_LE(text->text().size(), 1000);
  text->setText(" Sit ");
  EXPECT_EQ(click("Say"), QStringList("say Sit"));
  EXPECT_EQ(click("Silence"), QStringList("stop sound"));
  text->clear();
  EXPECT_EQ(click("Say"), QStringList());
}

TEST_F(RemoteControlTest, TouchedPlacesLightUp) {
  robot_.connectIt();
  open("Sensors");
  Q_EMIT robot_.touched({"chin", "back_rear"});
  EXPECT_TRUE(find<QLabel>("chin")->property("touched").toBool());
  EXPECT_FALSE(find<QLabel>("head")->property("touched").toBool());
  const auto place = [this](const char* name) { return find<QLabel>(name)->pos(); };
  for (const char* end : {"front", "hind"}) {
    EXPECT_LT(place((std::string("paw_left_") + end).c_str()).x(), place("back_middle").x());
    EXPECT_GT(place((std::string("paw_right_") + end).c_str()).x(), place("back_middle").x());
  }
  for (const auto& [front, behind] : {std::pair<const char*, const char*>("head", "back_front"),
                                      {"back_front", "back_middle"},
                                      {"back_middle", "back_rear"},
                                      {"paw_left_front", "paw_left_hind"},
                                      {"paw_right_front", "paw_right_hind"}}) {
    EXPECT_LT(place(front).y(), place(behind).y()) << "it looks up";
  }
  const QString lit = find<QLabel>("chin")->styleSheet();
  EXPECT_NE(lit, find<QLabel>("head")->styleSheet());
  EXPECT_EQ(lit, find<QLabel>("back_rear")->styleSheet());
  Q_EMIT robot_.touched({"back_rear"});
  EXPECT_EQ(find<QLabel>("chin")->styleSheet(), find<QLabel>("head")->styleSheet());
  EXPECT_FALSE(find<QLabel>("chin")->property("touched").toBool());
  EXPECT_TRUE(find<QLabel>("back_rear")->property("touched").toBool());
  robot_.disconnectIt(State::kDisconnected, "gone");
  Q_EMIT robot_.touched({"back_rear"});
  EXPECT_FALSE(find<QLabel>("back_rear")->property("touched").toBool()) << "it was on its way";
}

TEST_F(RemoteControlTest, DistancesAreShownAlsoAtTheirLimits) {
  robot_.connectIt();
  open("Sensors");
  Q_EMIT robot_.distanceMeasured({"far", 0.3, 1.5});
  Q_EMIT robot_.distanceMeasured({"near", 0.25, 0.5});
  EXPECT_EQ(find<QProgressBar>("range_far")->format(), "far: 0.30 m");
  EXPECT_EQ(find<QProgressBar>("range_far")->value(), 20);
  auto* bar = find<QProgressBar>("range_near");
  EXPECT_EQ(bar->format(), "near: 0.25 m");
  EXPECT_EQ(bar->value(), 50);
  const QColor usual = bar->palette().color(QPalette::Highlight);
  Q_EMIT robot_.distanceMeasured({"near", 0.15, 0.5});
  EXPECT_NE(bar->palette().color(QPalette::Highlight), usual) << "it is about to meet something";
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [metres, value, words] : {std::make_tuple(infinite, 100, "near: nothing within reach"),
                                             std::make_tuple(-infinite, 0, "near: nearer than it can measure"),
                                             std::make_tuple(kUnknown, 0, "near: unknown")}) {
    Q_EMIT robot_.distanceMeasured({"near", 0.25, 0.5});
    EXPECT_EQ(bar->value(), 50);
    EXPECT_EQ(bar->palette().color(QPalette::Highlight), usual);
    Q_EMIT robot_.distanceMeasured({"near", metres, 0.5});
    EXPECT_EQ(bar->value(), value) << words;
    EXPECT_EQ(bar->format(), words);
  }
  robot_.disconnectIt(State::kDisconnected, "gone");
  deleteLeftovers();
  Q_EMIT robot_.distanceMeasured({"near", 0.25, 0.5});
  EXPECT_EQ(window_.findChild<QProgressBar*>("range_near"), nullptr) << "it was on its way";
  robot_.connectIt();
  Q_EMIT robot_.distanceMeasured({"near", 0.25, 0.5});
  robot_.disconnectIt(State::kDisconnected, "gone");
  robot_.connectIt();
  Q_EMIT robot_.distanceMeasured({"near", 0.25, 0.5});
  deleteLeftovers();
  EXPECT_EQ(find<QProgressBar>("range_near")->format(), "near: 0.25 m") << "over the next connection, too";
}

TEST_F(RemoteControlTest, AnLedIsSwitchedOffOnlyIfTheRobotSaysThatItShines) {
  robot_.connectIt();
  open("Lights");
  find<QSlider>("intensity")->setValue(40);
  EXPECT_EQ(click("back on"), QStringList("back 0.4"));
  EXPECT_EQ(click("face_3"), QStringList("face_3 0.4"));
  EXPECT_EQ(click("face_3"), QStringList("face_3 0.4"));
  Q_EMIT robot_.ledsChanged({{"face_3", 0.4}});
  EXPECT_TRUE(find<QWidget>("face_3")->styleSheet().contains("76%")) << "it looks bright";
  EXPECT_EQ(find<QWidget>("face_4")->styleSheet(), "");
  Q_EMIT robot_.ledsChanged({{"face_3", 0.8}});
  EXPECT_TRUE(find<QWidget>("face_3")->styleSheet().contains("62%")) << "and brighter";
  EXPECT_EQ(click("face_3"), QStringList("face_3 0"));
  Q_EMIT robot_.ledsChanged({{"face_3", 0}});
  EXPECT_EQ(find<QWidget>("face_3")->styleSheet(), "");
  EXPECT_EQ(click("face_3"), QStringList("face_3 0.4"));
}

// The robot does not repeat what it has said.
TEST_F(RemoteControlTest, WhatIsSaidWhileAPageIsHiddenIsThereWhenItIsShown) {
  robot_.connectIt();
  Q_EMIT robot_.settingsDescribed({{"gain", "", Setting::Kind::kInteger, 0, 9, {}}});
  for (const int round : {1, 2, 3}) {
    open("Sound");
    window_.setVisible(round < 3);  // at last all pages are hidden
    const QString number = QString::number(round);
    Q_EMIT robot_.ledsChanged({{"face_" + number, 0.4}});
    Q_EMIT robot_.settingsChanged({{"gain", round}});
    Q_EMIT robot_.motionsListed({number + ".MTN"});
    Q_EMIT robot_.movementChanged("moved by /" + number, false);
    Q_EMIT robot_.pictureTaken(QImage(208, 160, QImage::Format_RGB32), number + ".jpg");
    Q_EMIT robot_.streamingChanged(round != 2);
    Q_EMIT robot_.answered(true, "answer " + number);
    window_.show();
    open("Lights");
    for (const int led : {1, 2, 3}) {
      const QString name = "face_" + QString::number(led);
      EXPECT_EQ(find<QWidget>(name)->styleSheet().isEmpty(), led != round) << led << " in round " << round;
      EXPECT_EQ(click(name), QStringList(name + (led == round ? " 0" : " 1")));
    }
    open("Camera");
    EXPECT_EQ(find<QSpinBox>("gain")->value(), round);
    EXPECT_EQ(textOf("path"), number + ".jpg");
    open("Motions");
    EXPECT_EQ(find<QListWidget>("motions")->item(0)->text(), number + ".MTN");
    EXPECT_EQ(textOf("movement"), "Now: moved by /" + number);
    open("Move");
    EXPECT_EQ(textOf("who_moves"), "moved by /" + number);
    EXPECT_EQ(click("stream"), QStringList(round == 2 ? "stream on" : "stream off"));
    EXPECT_TRUE(textOf("status").endsWith("answer " + number));
  }
}

TEST_F(RemoteControlTest, APatternReplacesTheFace) {
  robot_.connectIt();
  open("Lights");
  EXPECT_EQ(click("Lower"), (QStringList{"face 0", "face_1,face_2,face_3,face_4,face_5,face_6,face_7 1"}));
  EXPECT_EQ(click("Upper"), (QStringList{"face 0", "face_8,face_9,face_10,face_11,face_12,face_13,face_14 1"}));
  EXPECT_EQ(click("Even"), (QStringList{"face 0", "face_2,face_4,face_6,face_8,face_10,face_12,face_14 1"}));
  find<QSlider>("intensity")->setValue(40);
  EXPECT_EQ(click("Odd"), (QStringList{"face 0", "face_1,face_3,face_5,face_7,face_9,face_11,face_13 0.4"}));
}

TEST_F(RemoteControlTest, SettingsShowWhatIsInForce) {
  robot_.connectIt();
  open("Camera");
  Q_EMIT robot_.settingsChanged(
      {{"jpeg_quality", 85}, {"gain", 2}, {"auto_exposure", false}, {"speed_scale", 1.0}, {"telemetry_rate", 20.0}});
  Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "", Setting::Kind::kInteger, 5, 95, {}},
                                   {"gain", "", Setting::Kind::kChoice, 0, 0, {{"low", 1}, {"mid", 2}}},
                                   {"auto_exposure", "", Setting::Kind::kSwitch, 0, 0, {}},
                                   {"speed_scale", "", Setting::Kind::kNumber, 0.1, 1, {}},
                                   {"telemetry_rate", "", Setting::Kind::kNumber, 0, 31.25, {}}});
  EXPECT_EQ(find<QSpinBox>("jpeg_quality")->value(), 85);
  EXPECT_EQ(find<QComboBox>("gain")->currentText(), "mid");
  EXPECT_EQ(find<QDoubleSpinBox>("speed_scale")->value(), 1.0);
  EXPECT_EQ(click("auto_exposure"), QStringList("auto_exposure true"));
  robot_.take();
  Q_EMIT find<QComboBox>("gain")->activated(0);
  EXPECT_EQ(robot_.take(), QStringList("gain 1"));
  find<QDoubleSpinBox>("speed_scale")->stepDown();
  EXPECT_EQ(robot_.take(), QStringList("speed_scale 0.9"));
  find<QDoubleSpinBox>("telemetry_rate")->stepDown();
  EXPECT_EQ(robot_.take(), QStringList("telemetry_rate 19"));
  find<QDoubleSpinBox>("speed_scale")->setValue(-3);
  EXPECT_EQ(robot_.take(), QStringList("speed_scale 0.1"));
  find<QSpinBox>("jpeg_quality")->setValue(999);
  EXPECT_EQ(robot_.take(), QStringList("jpeg_quality 95"));
  find<QSpinBox>("jpeg_quality")->setValue(-3);
  EXPECT_EQ(robot_.take(), QStringList("jpeg_quality 5"));
  find<QSpinBox>("jpeg_quality")->setValue(60);
  EXPECT_EQ(robot_.take(), QStringList("jpeg_quality 60"));
  find<QSpinBox>("jpeg_quality")->selectAll();
  QTest::keyClicks(find<QSpinBox>("jpeg_quality"), "42");
  EXPECT_EQ(robot_.take(), QStringList()) << "no wish for 4";
  QTest::keyClick(find<QSpinBox>("jpeg_quality"), Qt::Key_Return);
  EXPECT_EQ(robot_.take(), QStringList("jpeg_quality 42"));
  Q_EMIT robot_.settingsChanged({{"jpeg_quality", 70}, {"gain", 2}, {"auto_exposure", true}, {"speed_scale", 0.35}});
  EXPECT_EQ(find<QSpinBox>("jpeg_quality")->value(), 70);
  EXPECT_EQ(find<QComboBox>("gain")->currentText(), "mid");
  EXPECT_TRUE(find<QCheckBox>("auto_exposure")->isChecked());
  EXPECT_EQ(find<QDoubleSpinBox>("speed_scale")->value(), 0.35);
  Q_EMIT robot_.settingsChanged({{"auto_exposure", false}});
  EXPECT_FALSE(find<QCheckBox>("auto_exposure")->isChecked());
  EXPECT_EQ(robot_.take(), QStringList()) << "what the driver says is no wish";
  Q_EMIT robot_.settingsDescribed({{"gain", "", Setting::Kind::kChoice, 0, 0, {{"low", 1}, {"mid", 2}}}});
  Q_EMIT robot_.settingsChanged({{"jpeg_quality", 50}, {"gain", 1}});
  EXPECT_EQ(find<QComboBox>("gain")->currentText(), "low") << "another driver has fewer settings";
}

TEST_F(RemoteControlTest, ThePageMoveSwitchesTheGuardAndShowsWhatTheDriverReports) {
  robot_.connectIt();
  auto* guard = find<QCheckBox>("guard_walks");
  EXPECT_FALSE(guard->isVisible()) << "nobody knows";
  Q_EMIT robot_.settingsChanged({{"guard", true}});
  EXPECT_TRUE(guard->isVisible() && guard->isChecked());
  EXPECT_EQ(click("guard_walks"), QStringList("guard false"));
  EXPECT_TRUE(guard->isChecked());
  Q_EMIT robot_.settingsChanged({{"guard", false}});
  EXPECT_FALSE(guard->isChecked());
}

TEST_F(RemoteControlTest, ADriverThatHasSpokenHasSettingsAndAConditionBeforeItHasItsRobot) {
  Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "how good", Setting::Kind::kInteger, 1, 100, {}}});
  auto* quality = find<QSpinBox>("jpeg_quality");
  EXPECT_EQ(quality->toolTip(), "how good");
  EXPECT_EQ(qobject_cast<QFormLayout*>(quality->parentWidget()->layout())->labelForField(quality)->property("text"),
            "Jpeg quality");
  RobotCondition condition;
  condition.is_stopped = true;
  condition.stopped_by = "/anna";
  Q_EMIT robot_.conditionChanged(condition);
  const std::tuple<State, bool, bool> states[] = {
      {State::kNoMaster, false, false},    {State::kNoDriver, false, false},  {State::kWaiting, false, false},
      {State::kDisconnected, true, false}, {State::kConnecting, true, false}, {State::kPlayback, true, true},
      {State::kConnected, true, true}};
  for (const auto& [state, has_driver, has_robot] : states) {
    robot_.connectIt();
    Q_EMIT robot_.linkMeasured({30, 0.01, 0});
    Q_EMIT robot_.batteryMeasured(0.8, 31);
    robot_.disconnectIt(state, "a reason");
    EXPECT_EQ(quality->isEnabled(), has_driver) << int(state);
    EXPECT_EQ(textOf("condition"), has_driver ? "stopped by /anna" : "") << int(state);
    EXPECT_EQ(find<QAbstractButton>("stop")->text(), has_driver ? "Release" : "STOP") << int(state);
    EXPECT_EQ(find<QLabel>("battery")->isEnabled(), has_robot) << int(state);
    Q_EMIT robot_.linkMeasured({30, 0.01, 0});
    EXPECT_EQ(textOf("link").isEmpty(), !has_robot) << int(state);
    EXPECT_EQ(find<QWidget>("who_moves")->isHidden(), !has_robot) << int(state);
    EXPECT_EQ(find<QWidget>("take_picture")->isEnabled(), state == State::kConnected) << int(state);
  }
}

void turnWheel(QWidget* widget) {
  QWheelEvent wheel(QPointF(5, 5), QPointF(5, 5), QPoint(), QPoint(0, 120), Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(widget, &wheel);
}

TEST_F(RemoteControlTest, WhoeverScrollsChangesNoSettingAndNoDriver) {
  robot_.connectIt();
  open("Camera");
  Q_EMIT robot_.driversFound({"/aibo", "/right"});
  Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "", Setting::Kind::kInteger, 1, 100, {}},
                                   {"gain", "", Setting::Kind::kChoice, 0, 0, {{"low", 1}, {"mid", 2}}},
                                   {"speed_scale", "", Setting::Kind::kNumber, 0.1, 1, {}}});
  Q_EMIT robot_.settingsChanged({{"jpeg_quality", 85}, {"gain", 2}, {"speed_scale", 0.5}});
  robot_.take();
  for (const char* name : {"jpeg_quality", "gain", "speed_scale", "driver"}) {
    turnWheel(find<QWidget>(name));
    EXPECT_EQ(robot_.take(), QStringList()) << name;
  }
}

TEST_F(RemoteControlTest, EachJointIsInTheGroupOfItsLeg) {
  robot_.connectIt();
  const std::tuple<const char*, const char*, const char*> places[] = {{"left_front_knee", "Left front", "knee"},
                                                                      {"right_hind_rotator", "Right hind", "rotator"},
                                                                      {"tail_pan", "Tail", "tail pan"},
                                                                      {"mouth", "Head", "mouth"}};
  for (const auto& [joint, group, label] : places) {
    auto* slider = find<JointSlider>(joint);
    EXPECT_EQ(qobject_cast<QGroupBox*>(slider->parentWidget())->title(), group);
    EXPECT_EQ(slider->findChildren<QLabel*>().last()->text(), label);
  }
  open("Joints");
  Q_EMIT robot_.jointsMeasured({{"left_front_knee", 0.4}, {"mouth", -0.2}, {"tail_pan", 0.1}});
  EXPECT_EQ(find<JointSlider>("left_front_knee")->slider()->value(), 400);
  EXPECT_EQ(find<JointSlider>("mouth")->slider()->value(), -200);
  EXPECT_EQ(find<JointSlider>("tail_pan")->slider()->value(), 100);
  robot_.take();
  find<JointSlider>("mouth")->slider()->setValue(-300);
  EXPECT_EQ(robot_.take(), QStringList("mouth -0.3"));
  robot_.connectIt(2, "R2D2");
  EXPECT_EQ(window_.findChild<JointSlider*>("mouth"), nullptr);
  const auto labels = find<QWidget>("Joints")->findChildren<QLabel*>();
  ASSERT_EQ(labels.size(), 1);
  EXPECT_EQ(labels.front()->text(), "There is no table of a robot named 'R2D2'.");
  Q_EMIT robot_.jointsMeasured({{"mouth", -0.2}});
  robot_.connectIt();
  Q_EMIT robot_.jointsMeasured({{"mouth", -0.2}});
  EXPECT_EQ(find<JointSlider>("mouth")->slider()->value(), -200);
}

TEST_F(RemoteControlTest, AJointCannotBeMovedBeforeItIsMeasuredOverThisConnection) {
  robot_.connectIt();
  open("Joints");
  const JointPositions positions{{"head_pan", 0.8}};
  Q_EMIT robot_.jointsMeasured(positions);
  auto* slider = find<JointSlider>("head_pan");
  EXPECT_TRUE(slider->slider()->isEnabled());
  robot_.disconnectIt(State::kDisconnected, "gone");
  Q_EMIT robot_.jointsMeasured(positions);  // it was on its way
  robot_.connectIt();
  EXPECT_FALSE(slider->slider()->isEnabled()) << "it may be another robot";
  EXPECT_EQ(slider->findChildren<QLabel*>().first()->text(), "?");
  Q_EMIT robot_.jointsMeasured(positions);
  EXPECT_TRUE(slider->slider()->isEnabled());
}

class JointSliderTest : public ::testing::Test {
 protected:
  JointSliderTest() : slider_({"head_pan", 2, -1.5, 1.5, 3, 3, false}, "pan") {
    QObject::connect(&slider_, &JointSlider::moved,
                     [this](const QString& joint, double position) { moved_[joint] = position; });
  }

  // The one behind the slider; the other label is the joint's name.
  QString text() const { return slider_.findChildren<QLabel*>().first()->text(); }

  JointPositions moved_;
  JointSlider slider_;
};

TEST_F(JointSliderTest, CannotBeMovedBeforeItsJointIsMeasured) {
  EXPECT_FALSE(slider_.slider()->isEnabled());
  slider_.measure(0.4);
  EXPECT_TRUE(slider_.slider()->isEnabled());
  QTest::keyClick(slider_.slider(), Qt::Key_Right);
  EXPECT_EQ(slider_.slider()->value(), 420);
  QTest::keyClick(slider_.slider(), Qt::Key_PageUp);
  EXPECT_EQ(slider_.slider()->value(), 520);
  EXPECT_TRUE(slider_.toolTip().startsWith(QString::fromUtf8("head_pan: -86\u00B0 to 86\u00B0. ")));
}

TEST_F(JointSliderTest, FollowsItsJointWithoutCommandingIt) {
  slider_.measure(0.4);
  slider_.measure(0.5);
  EXPECT_EQ(slider_.slider()->value(), 500);
  slider_.measure(0.506);
  EXPECT_EQ(slider_.slider()->value(), 506);
  slider_.measure(0.509);
  EXPECT_EQ(slider_.slider()->value(), 506);
  slider_.measure(0.512);
  EXPECT_EQ(slider_.slider()->value(), 512) << "however slowly it moves";
  EXPECT_EQ(moved_, JointPositions());
}

TEST_F(JointSliderTest, HasAMarkWhereItsJointIsAndSaysItInDegrees) {
  slider_.resize(400, 30);
  slider_.show();
  slider_.measure(-0.75);
  EXPECT_EQ(text(), QString::fromUtf8("-43\u00B0"));
  slider_.slider()->setValue(750);
  EXPECT_EQ(text(), QString::fromUtf8("\u219243\u00B0")) << "it goes there";
  const QImage image = slider_.slider()->grab().toImage();
  int marked = 0;
  for (int x = 0; x < image.width(); ++x) {
    if (image.pixelColor(x, 2) == QColor("#4caf50")) {
      ++marked;
      EXPECT_NEAR(x, image.width() / 4, image.width() / 20);
    }
  }
  EXPECT_EQ(marked, 3);
  slider_.measure(0.74);
  EXPECT_EQ(text(), QString::fromUtf8("42\u00B0")) << "it is there";
  slider_.measure(0.737);
  EXPECT_EQ(slider_.slider()->value(), 740) << "the sensor is no finer";
  slider_.slider()->setValue(742);
  EXPECT_EQ(text(), QString::fromUtf8("\u219243\u00B0"));
  slider_.measure(0.74);
  EXPECT_EQ(text(), QString::fromUtf8("42\u00B0")) << "it was there already";
}

TEST_F(JointSliderTest, CommandsItsJointAndWaitsUntilItHasArrived) {
  EXPECT_EQ(text(), "?");
  slider_.measure(0.4);
  slider_.slider()->setValue(1000);
  EXPECT_EQ(moved_, JointPositions({{"head_pan", 1.0}}));
  for (const double way : {0.6, 0.95}) {
    slider_.measure(way);
    EXPECT_EQ(slider_.slider()->value(), 1000) << "the joint is on its way";
  }
  slider_.measure(0.99);
  slider_.measure(0.7);
  EXPECT_EQ(slider_.slider()->value(), 700) << "it has been there, and somebody else has moved it";
  slider_.slider()->setValue(100);
  slider_.measure(0.4);
  EXPECT_EQ(slider_.slider()->value(), 100) << "it is on its way back";
}

TEST_F(JointSliderTest, FollowsAJointThatDoesNotArriveAfterSomeTime) {
  slider_.measure(0.4);
  slider_.slider()->setValue(1000);
  EXPECT_TRUE(QTest::qWaitFor(
      [this] {
        slider_.measure(0.6);
        return slider_.slider()->value() == 600;
      },
      20000));
  slider_.slider()->setValue(1000);
  slider_.measure(0.6);
  EXPECT_EQ(slider_.slider()->value(), 1000) << "it waits again after each command";
}

TEST_F(JointSliderTest, DoesNotFollowWhileItIsHeld) {
  slider_.measure(0.4);
  slider_.slider()->setSliderDown(true);
  slider_.slider()->setValue(450);
  slider_.measure(0.45);
  slider_.measure(0.2);
  EXPECT_EQ(slider_.slider()->value(), 450);
  slider_.slider()->setSliderDown(false);
  slider_.measure(0.449);
  slider_.measure(0.2);
  EXPECT_EQ(slider_.slider()->value(), 200);
}

TEST_F(JointSliderTest, TheWheelDoesNotMoveTheRobot) {
  slider_.measure(0.4);
  turnWheel(slider_.slider());
  EXPECT_EQ(moved_, JointPositions());
}

}  // namespace
}  // namespace aibo_driver::remote_control

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  ::testing::InitGoogleMock(&argc, argv);
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
