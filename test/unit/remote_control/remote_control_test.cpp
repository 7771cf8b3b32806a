// The window, without a display and with a robot that only records what the window asks for.
#include "remote_control/remote_control.h"

#include <gmock/gmock.h>

#include <QtTest/QTest>
#include <QtWidgets>

#include "motion_tool/motion_tool.h"
#include "remote_control/axis_pad.h"
#include "remote_control/joint_slider.h"
#include "remote_control/robot.h"
#include "support/temporary_folder.h"

namespace aibo_driver::remote_control {
namespace {

using Motors = RobotCondition::Motors;
using Posture = RobotCondition::Posture;
using State = RobotConnection::State;

/// Records what the window asks for. Tests emit its signals.
class FakeRobot : public Robot {
 public:
  /// Wishes in words, such as "play NOD.MTN 2".
  QStringList wishes;

  std::set<Part> visible;
  QByteArray uploaded;

  /// All wishes since the last call.
  QStringList take() {
    const QStringList taken = wishes;
    wishes.clear();
    return taken;
  }

  void connectIt(int protocol_version = 2, const QString& robot = "ERS-7") {
    report(State::kConnected, "connected", protocol_version == 2 ? robot : "", protocol_version);
  }

  void disconnectIt(State state, const QString& text) { report(state, text, "ERS-7", 0); }

  void useDriver(const QString& name_space) override { wishes.append("use " + name_space); }
  void show(const std::set<Part>& parts) override { visible = parts; }
  void stop() override { wishes.append("stop"); }
  void release() override { wishes.append("release"); }
  void takePicture(const QString& folder) override { wishes.append("picture " + folder); }
  void setStreaming(bool on) override { wishes.append(on ? "stream on" : "stream off"); }
  void setMotors(bool on) override { wishes.append(on ? "motors on" : "motors off"); }
  void takePosture(const QString& posture) override { wishes.append(posture); }
  void listMotions() override { wishes.append("list"); }
  void playMotion(const QString& name, int repetitions) override {
    wishes.append("play " + name + " " + QString::number(repetitions));
  }
  void uploadMotion(const QString& name, const QByteArray& motion) override {
    wishes.append("upload " + name);
    uploaded = motion;
  }
  void stopMotions() override { wishes.append("stop motions"); }
  void changeSetting(const QString& name, const QVariant& value) override {
    wishes.append(name + " " + value.toString());
  }
  void setLeds(const QStringList& names, double intensity) override {
    wishes.append(names.join(",") + " " + QString::number(intensity));
  }
  void flickEars(bool left, bool right) override { wishes.append(QString("ears %1 %2").arg(left).arg(right)); }
  void moveJoints(const JointPositions& positions) override {
    QStringList words;
    for (auto joint = positions.begin(); joint != positions.end(); ++joint) {
      words.append(joint.key() + " " + QString::number(joint.value(), 'f', 1));
    }
    wishes.append(words.join(", "));
  }
  void say(const QString& text) override { wishes.append("say " + text); }
  void stopSound() override { wishes.append("stop sound"); }
  void walk(double forward, double left, double turn) override {
    wishes.append(
        QString("walk %1 %2 %3").arg(forward + 0.0, 0, 'f', 2).arg(left + 0.0, 0, 'f', 2).arg(turn + 0.0, 0, 'f', 2));
  }
  void lookAt(const QPointF& place) override {
    wishes.append(QString("look %1 %2").arg(place.x(), 0, 'f', 1).arg(place.y(), 0, 'f', 1));
  }

 private:
  void report(State state, const QString& text, const QString& robot, int protocol_version) {
    RobotConnection connection;
    connection.state = state;
    connection.name_space = "/aibo";
    connection.robot = connection.hasDriver() ? robot : "";
    connection.address = connection.hasDriver() ? "robot:54321" : "";
    connection.protocol_version = protocol_version;
    connection.text = text;
    Q_EMIT connectionChanged(connection);
  }
};

RobotCondition conditionOf(Motors motors, Posture posture, const QString& stopped_by = "") {
  RobotCondition condition;
  condition.motors = motors;
  condition.posture = posture;
  condition.is_stopped = !stopped_by.isEmpty();
  condition.stopped_by = stopped_by;
  return condition;
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

  // What it is asked for while this place of a pad is pressed; the middle is 0, the edges are at 1.
  QStringList press(const QString& name, Qt::MouseButton button, double x, double y) {
    auto* pad = find<AxisPad>(name);
    const double half = std::min(pad->width(), pad->height()) / 2.0 - 1;
    robot_.take();
    QTest::mousePress(pad, button, {},
                      QPoint(qRound(pad->width() / 2.0 + x * half), qRound(pad->height() / 2.0 - y * half)));
    return robot_.take();
  }

  QString textOf(const QString& label) { return find<QLabel>(label)->text(); }

  FakeRobot robot_;
  RemoteControl window_;
};

TEST_F(RemoteControlTest, EachButtonAsksForWhatItSays) {
  const std::tuple<const char*, const char*, QStringList> buttons[] = {
      {"Move", "Stand", {"stand"}},
      {"Move", "Rest", {"rest"}},
      {"Move", "Motors on", {"motors on"}},
      {"Move", "Motors off", {"motors off"}},
      {"Camera", "take_picture", {"picture /pictures"}},
      {"Camera", "stream", {"stream on"}},
      {"Motions", "Stop motions", {"stop motions"}},
      {"Motions", "List again", {"list"}},
      {"Lights", "back on", {"back 1"}},
      {"Lights", "all off", {"all 0"}},
      {"Lights", "face_3", {"face_3 1"}},
      {"Lights", "Left ear", {"ears 1 0"}},
      {"Lights", "Right ear", {"ears 0 1"}},
      {"Sound", "Silence", {"stop sound"}},
  };
  robot_.connectIt();
  window_.setFolder("/pictures");
  for (const auto& [page, button, wishes] : buttons) {
    open(page);
    EXPECT_EQ(click(button), wishes) << button;
  }
}

TEST_F(RemoteControlTest, ADoubleClickPlaysAMotion) {
  robot_.connectIt();
  open("Motions");
  Q_EMIT robot_.motionsListed({"NOD.MTN", "WAG.MTN"});
  robot_.take();
  auto* motions = find<QListWidget>("motions");
  Q_EMIT motions->itemDoubleClicked(motions->item(1));
  EXPECT_EQ(robot_.take(), QStringList("play WAG.MTN 1"));
}

// What cannot be used in a state, and why. The other controls can be used.
TEST_F(RemoteControlTest, WhatCannotBeUsedNowIsDisabledAndSaysWhy) {
  const QStringList all{"Stand",  "Motors on", "Motors off", "drive_pad", "head_pad", "Play",        "motions",
                        "face_1", "Left ear",  "listen",     "Say",       "say_text", "take_picture"};
  QStringList all_and_stop = all;
  all_and_stop.append("stop");
  const std::tuple<std::function<void()>, QStringList, const char*> rows[] = {
      {[] {}, all, "no driver has been found yet"},
      {[this] { robot_.connectIt(); }, {}, ""},
      {[this] { Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOn, Posture::kCarried)); },
       {"drive_pad"},
       "the robot is carried; put it on its feet"},
      {[this] { Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOn, Posture::kFallen)); },
       {"drive_pad"},
       "the robot has fallen; put it on its feet, and click Stand"},
      {[this] { Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOff, Posture::kLying)); },
       {"drive_pad", "head_pad", "Play"},
       "the motors are off; click Stand, or Motors on"},
      {[this] { Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOff, Posture::kLying, "/pad")); },
       {"Stand", "Motors on", "drive_pad", "head_pad", "Play"},
       "/pad has stopped the robot; click Release"},
      {[this] { Q_EMIT robot_.conditionChanged({}); }, {}, ""},
      {[this] { robot_.disconnectIt(State::kDisconnected, "is the robot on?"); }, all, "is the robot on?"},
      {[this] { robot_.disconnectIt(State::kPlayback, "playback of walk.bag"); }, all_and_stop, "playback of walk.bag"},
      {[this] { robot_.connectIt(1); },
       {"Stand", "Motors on", "Motors off", "drive_pad", "motions", "listen", "Say", "say_text"},
       "version 1"},
  };
  for (const auto& [happen, disabled, why] : rows) {
    happen();
    for (const QString& name : all_and_stop) {
      const auto* control = find<QWidget>(name);
      EXPECT_EQ(control->isEnabled(), !disabled.contains(name)) << name.toStdString() << ": " << why;
      EXPECT_TRUE(control->isEnabled() || control->toolTip().contains(why)) << control->toolTip().toStdString();
    }
  }
}

TEST_F(RemoteControlTest, StopBecomesReleaseButNotForASecondClickInFright) {
  robot_.connectIt();
  const RobotCondition stopped = conditionOf(Motors::kOn, Posture::kStanding, "/gamepad");
  EXPECT_EQ(click("stop"), QStringList("stop"));
  QElapsedTimer since_stopped;
  since_stopped.start();
  Q_EMIT robot_.conditionChanged(stopped);
  EXPECT_EQ(find<QAbstractButton>("stop")->text(), "Release");
  EXPECT_TRUE(find<QAbstractButton>("stop")->styleSheet().contains("#1565c0")) << "blue";
  EXPECT_EQ(textOf("condition"), "stopped by /gamepad");
  EXPECT_TRUE(QTest::qWaitFor([this] { return click("stop") == QStringList("release"); }));
  EXPECT_GE(since_stopped.elapsed(), 1000) << "sooner it stops once more";
  QTest::keyClick(&window_, Qt::Key_Space);
  EXPECT_EQ(robot_.take(), QStringList("stop")) << "the space bar never releases";
  robot_.disconnectIt(State::kDisconnected, "gone");
  EXPECT_EQ(find<QAbstractButton>("stop")->text(), "Release") << "a stop outlives the connection";
  robot_.connectIt();
  Q_EMIT robot_.conditionChanged({});
  EXPECT_EQ(find<QAbstractButton>("stop")->text(), "STOP");
}

TEST_F(RemoteControlTest, TheSpaceBarStopsWhereverTheFocusIs) {
  robot_.connectIt();
  const auto stops = [this](QWidget* focus) {
    focus->setFocus();
    robot_.take();
    QTest::keyClick(focus, Qt::Key_Space);
    EXPECT_EQ(robot_.take(), QStringList("stop")) << focus->objectName().toStdString();
    QTest::simulateEvent(focus, true, Qt::Key_Space, Qt::NoModifier, " ", true);
    EXPECT_EQ(robot_.take(), QStringList()) << "a key that is held stops once";
  };
  open("Motions");
  for (const char* name : {"Play", "motion_name", "motions", "stop", "take_picture"}) {
    stops(find<QWidget>(name));
  }
  open("Sound");
  stops(find<QWidget>("say_text"));
  open("Camera");
  Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "", 1, 100, {}}});
  stops(find<QWidget>("jpeg_quality"));
  Q_EMIT robot_.driversFound({"/left", "/right"});
  find<QComboBox>("driver")->showPopup();
  QTest::keyClick(find<QComboBox>("driver")->view(), Qt::Key_Space);
  EXPECT_EQ(robot_.take(), QStringList("stop")) << "also in the list of a choice";
}

TEST_F(RemoteControlTest, TheRobotSaysASentenceAndTheEscapeKeyStopsIt) {
  robot_.connectIt();
  open("Sound");
  auto* text = find<QLineEdit>("say_text");
  robot_.take();
  QTest::keyClicks(text, "Good dog");
  EXPECT_EQ(robot_.take(), QStringList()) << "here the space bar writes a space";
  QTest::keyClick(text, Qt::Key_Escape);
  EXPECT_EQ(robot_.take(), QStringList("stop"));
  QTest::keyClick(text, Qt::Key_Return);
  EXPECT_EQ(robot_.take(), QStringList("say Good dog"));
}

// A hostile robot's refusals, and names of motions, settings and folders.
TEST_F(RemoteControlTest, ShowsWhatLooksLikeHtmlAsItIs) {
  const QString html = "&lt;b&gt; <img src=\"/dev/stdin\">";  // Qt takes either for HTML if it comes first
  robot_.connectIt();
  Q_EMIT robot_.movementChanged(html);
  Q_EMIT robot_.settingsDescribed({{html, html, 1, 100, {}}, {"choice", html, {}, {}, {{html, html}}}});
  window_.setFolder(html);
  Q_EMIT robot_.answered(false, html + QString(5'000'000, 'x'));
  auto* tabs = find<QTabWidget>("");
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
  }
  click("folder");
  QList<QWidget*> widgets = window_.findChildren<QWidget*>();
  EXPECT_TRUE(textOf("status").contains(html));
  EXPECT_LT(textOf("status").size(), 2000) << "of a long answer the beginning";
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

TEST_F(RemoteControlTest, PicturesGoToTheChosenFolderAndTheNewestIsShown) {
  robot_.connectIt();
  open("Camera");
  click("folder");
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr) << "STOP can be clicked meanwhile";
  Q_EMIT window_.findChild<QFileDialog*>()->fileSelected("/chosen");
  EXPECT_EQ(window_.folder(), "/chosen");
  EXPECT_EQ(click("take_picture"), QStringList("picture /chosen"));
  EXPECT_FALSE(find<QWidget>("thumbnail")->isEnabled());
  Q_EMIT robot_.pictureTaken(QImage(208, 160, QImage::Format_RGB32), "/chosen/a.jpg");
  EXPECT_EQ(textOf("path"), "/chosen/a.jpg");
  EXPECT_TRUE(textOf("status").endsWith("saved as /chosen/a.jpg")) << "on every page";
}

TEST_F(RemoteControlTest, EachPlaceOfAPadHasItsDirection) {
  const std::tuple<const char*, Qt::MouseButton, double, double, const char*> rows[] = {
      {"drive_pad", Qt::LeftButton, 0, 1, "walk 0.15 0.00 0.00"},
      {"drive_pad", Qt::LeftButton, 0, -1, "walk -0.15 0.00 0.00"},
      {"drive_pad", Qt::LeftButton, 1, 0, "walk 0.00 0.00 -1.00"},
      {"drive_pad", Qt::LeftButton, 0.05, -0.05, "walk 0.00 0.00 0.00"},
      {"drive_pad", Qt::RightButton, -1, 0, "walk 0.00 0.06 0.00"},
      {"head_pad", Qt::LeftButton, -1, 1, "head_pan 1.5, head_tilt 0.8"},
      {"head_pad", Qt::LeftButton, 1, -1, "head_pan -1.5, head_tilt -0.3"},
  };
  robot_.connectIt();
  for (const auto& [pad, button, x, y, wish] : rows) {
    EXPECT_EQ(press(pad, button, x, y), QStringList(wish));
    QTest::mouseRelease(find<QWidget>(pad), button);
  }
}

// A dead man's switch also opens when the mouse's release cannot be seen.
TEST_F(RemoteControlTest, ThePadWalksAgainAndAgainUntilItIsLetGo) {
  auto* pad = find<AxisPad>("drive_pad");
  const std::pair<const char*, std::function<void()>> ends[] = {
      {"the mouse is released", [pad] { QTest::mouseRelease(pad, Qt::LeftButton); }},
      {"its page is left", [this] { open("Camera"); }},
      {"the connection is lost", [this] { robot_.disconnectIt(State::kDisconnected, "gone"); }},
      {"the window is not active",
       [pad] {
         QEvent deactivation(QEvent::WindowDeactivate);
         QApplication::sendEvent(pad, &deactivation);
       }},
      {"another driver is chosen", [this] { window_.useDriver("/bert"); }},
      {"the space bar", [this] { QTest::keyClick(&window_, Qt::Key_Space); }},
  };
  for (const auto& [name, end] : ends) {
    robot_.connectIt();
    open("Move");
    press("drive_pad", Qt::LeftButton, 0, 1);
    EXPECT_TRUE(QTest::qWaitFor([this] { return robot_.wishes.size() >= 3; })) << "or the robot would stop";
    robot_.take();
    end();
    EXPECT_FALSE(pad->isHeld()) << name;
    EXPECT_TRUE(robot_.take().contains("walk 0.00 0.00 0.00")) << name;
    QTest::mouseRelease(pad, Qt::LeftButton);
  }
}

TEST_F(RemoteControlTest, AClickIntoThePictureLooksThere) {
  robot_.connectIt();
  auto* view = window_.findChild<PictureView*>();
  const auto look = [&](const QPointF& part) {  // of the picture
    robot_.take();
    const double scale = std::min(view->width() / 208.0, view->height() / 160.0);
    const QPoint way(qRound(208 * scale * (part.x() - 0.5)), qRound(160 * scale * (part.y() - 0.5)));
    QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center() + way);
    return robot_.take();
  };
  EXPECT_EQ(look({0.5, 0.5}), QStringList()) << "there is none yet";
  Q_EMIT robot_.streamingChanged(true);
  Q_EMIT robot_.pictureArrived(QImage(208, 160, QImage::Format_RGB32));
  EXPECT_EQ(look({0.2, 0.4}), QStringList("look 0.2 0.4"));
  Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOff, Posture::kLying));
  EXPECT_EQ(look({0.2, 0.4}), QStringList());
  EXPECT_TRUE(textOf("status").endsWith("look there: not now: the motors are off; click Stand, or Motors on"));
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
       Q_EMIT robot.settingsDescribed({{kLongWord, kLongWord, {}, {}, {{kLongWord, 1}}}});
       Q_EMIT robot.distanceMeasured({kLongWord, 0.25, 0.5});
     }},
    {"a movement", [](FakeRobot& robot) { Q_EMIT robot.movementChanged("moved by /" + kLongWord + kLongText); }},
    {"a refusal", [](FakeRobot& robot) { Q_EMIT robot.answered(false, kLongText); }},
    {"it is stopped",
     [](FakeRobot& robot) {
       Q_EMIT robot.conditionChanged(conditionOf(Motors::kOn, Posture::kStanding, "/" + kLongWord));
     }},
    {"the robot is silent", [](FakeRobot& robot) { robot.disconnectIt(State::kDisconnected, kLongText); }},
    {"a playback", [](FakeRobot& robot) { robot.disconnectIt(State::kPlayback, kLongWord); }},
    {"a robot of version 1", [](FakeRobot& robot) { robot.connectIt(1); }},
    {"a kind that nobody knows", [](FakeRobot& robot) { robot.connectIt(2, "R2D2"); }}};

// With the usual and with a doubled font, as on a screen of high resolution.
TEST(RemoteControlLayout, StopAndTheTabsStayInTheirPlacesWhateverHappens) {
  const QFont usual = QApplication::font();
  for (const int factor : {1, 2}) {
    QFont font = usual;
    font.setPointSizeF(factor * usual.pointSizeF());
    QApplication::setFont(font);
    for (const QSize& size : {QSize(0, 0), QSize(420, 600), QSize(1920, 1080)}) {
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
      EXPECT_LE(window.minimumSizeHint().height(), 500 * factor) << "in rviz on 1024x600 pixels";
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
  const std::pair<const char*, Part> pages[] = {
      {"Move", Part::kJoints}, {"Sensors", Part::kSensors}, {"Joints", Part::kJoints}, {"Sound", Part::kMicrophones}};
  robot_.connectIt();
  find<QAbstractButton>("listen")->click();
  for (const auto& [page, part] : pages) {
    open(page);
    EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, part})) << page;
  }
  window_.hide();
  EXPECT_EQ(robot_.visible, std::set<Part>());
  window_.show();
  EXPECT_EQ(robot_.visible, (std::set<Part>{Part::kPictures, Part::kMicrophones}));
  find<QAbstractButton>("listen")->click();
  EXPECT_EQ(robot_.visible, std::set<Part>{Part::kPictures}) << "the microphones are open only while the user listens";
}

TEST_F(RemoteControlTest, TheStatusRepeatsAnswersAndIsRedForThoseOfFailures) {
  const auto shows = [this](const QString& text, bool is_red) {
    EXPECT_TRUE(textOf("status").endsWith(text)) << textOf("status").toStdString();
    EXPECT_EQ(find<QLabel>("status")->toolTip(), text);
    EXPECT_EQ(find<QLabel>("status")->styleSheet().contains("color"), is_red) << text.toStdString();
  };
  Q_EMIT robot_.answered(false, "stand: the robot fell");
  shows("stand: the robot fell", true);
  Q_EMIT robot_.hinted("walk: the floor ends ahead");
  shows("walk: the floor ends ahead", false);
  Q_EMIT robot_.answered(true, "stand: the robot stands");
  shows("stand: the robot stands", false);
}

TEST_F(RemoteControlTest, TheConnectionIsShownInWordsAndFigures) {
  robot_.connectIt();
  Q_EMIT robot_.batteryMeasured(0.82, 31.4);
  Q_EMIT robot_.linkMeasured({29.96, 0.012, 0.034});
  Q_EMIT robot_.movementChanged("moved by /anna (walk); last ended: posture stand, done");
  EXPECT_EQ(textOf("connection"), "ERS-7 at robot:54321, connected (version 2)");
  EXPECT_EQ(textOf("commanded"), "/aibo") << "beside STOP";
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("Battery 82 %, 31 \u00B0C"));
  EXPECT_EQ(textOf("link"), "30.0 pictures/s, 12 ms old, 3.4 % lost");
  EXPECT_EQ(textOf("who_moves"), "moved by /anna (walk)");
  robot_.disconnectIt(State::kDisconnected, "is the robot on?");
  EXPECT_EQ(textOf("connection"), "is the robot on?");
  EXPECT_EQ(textOf("battery"), QString::fromUtf8("Battery 82 %, 31 \u00B0C")) << "the last reading stays";
  EXPECT_FALSE(find<QLabel>("battery")->isEnabled()) << "in grey";
  EXPECT_EQ(textOf("link"), "");
  RobotConnection without_master;
  without_master.state = State::kConnected;
  without_master.master_answers = false;
  Q_EMIT robot_.connectionChanged(without_master);
  EXPECT_TRUE(find<QLabel>("lamp")->styleSheet().contains("#ffb300")) << "yellow";
}

TEST_F(RemoteControlTest, TheChooserHasTheDriversThatRunAndTheOneInUse) {
  robot_.disconnectIt(State::kNoDriver, "the driver in /aibo does not answer");
  Q_EMIT robot_.driversFound({"/left", "/right"});
  auto* chooser = find<QComboBox>("driver");
  EXPECT_EQ(chooser->currentText(), "/aibo");
  robot_.take();
  Q_EMIT chooser->activated(chooser->findText("/right"));
  EXPECT_EQ(robot_.take(), QStringList("use /right"));
  EXPECT_EQ(window_.driver(), "/right");
}

TEST_F(RemoteControlTest, TheNextDriverBeginsWithNothingOfTheLastOne) {
  robot_.connectIt();
  open("Lights");
  Q_EMIT robot_.ledsChanged({{"face_3", 0.4}});
  Q_EMIT robot_.touched({"chin"});
  Q_EMIT robot_.motionsListed({"NOD.MTN"});
  Q_EMIT robot_.jointsMeasured({{"mouth", -0.2}});
  Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOff, Posture::kFallen, "/anna"));
  robot_.disconnectIt(State::kWaiting, "waiting for the driver in /rex");
  Q_EMIT robot_.conditionChanged({});  // as RosRobot does it
  Q_EMIT robot_.ledsChanged({});
  robot_.connectIt();
  EXPECT_EQ(find<QWidget>("face_3")->styleSheet(), "");
  EXPECT_FALSE(find<QLabel>("chin")->property("touched").toBool());
  EXPECT_EQ(find<QListWidget>("motions")->count(), 0);
  EXPECT_FALSE(find<JointSlider>("mouth")->slider()->isEnabled());
  EXPECT_EQ(textOf("condition"), "");
}

TEST_F(RemoteControlTest, ShowsWhatIsTouchedHowFarThingsAreAndHowLoudItIs) {
  robot_.connectIt();
  open("Sensors");
  Q_EMIT robot_.touched({"chin"});
  EXPECT_TRUE(find<QLabel>("chin")->property("touched").toBool());
  EXPECT_FALSE(find<QLabel>("head")->property("touched").toBool());
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const auto& [metres, value, words] :
       {std::make_tuple(0.25, 50, "near: 0.25 m"), std::make_tuple(kInfinite, 100, "near: nothing within reach"),
        std::make_tuple(-kInfinite, 0, "near: nearer than it can measure"),
        std::make_tuple(kUnknown, 0, "near: unknown")}) {
    Q_EMIT robot_.distanceMeasured({"near", metres, 0.5});
    EXPECT_EQ(find<QProgressBar>("range_near")->value(), value) << words;
    EXPECT_EQ(find<QProgressBar>("range_near")->format(), words);
  }
  open("Sound");
  find<QAbstractButton>("listen")->click();
  Q_EMIT robot_.heard(-20.4);
  EXPECT_EQ(find<QProgressBar>("level")->format(), "-20 dB");
  const auto redness = [this] { return find<QProgressBar>("level")->palette().color(QPalette::Highlight).red(); };
  EXPECT_LT(redness(), 100);
  Q_EMIT robot_.heard(-1);
  EXPECT_GT(redness(), 200) << "samples may be clipped";
}

TEST_F(RemoteControlTest, AnLedIsSwitchedOffOnlyIfTheRobotSaysThatItShines) {
  robot_.connectIt();
  open("Lights");
  find<QSlider>("intensity")->setValue(40);
  EXPECT_EQ(click("face_3"), QStringList("face_3 0.4"));
  Q_EMIT robot_.ledsChanged({{"face_3", 0.4}});
  EXPECT_NE(find<QWidget>("face_3")->styleSheet(), "") << "it is coloured";
  EXPECT_EQ(click("face_3"), QStringList("face_3 0"));
}

void turnWheel(QWidget* widget) {
  QWheelEvent wheel(QPointF(5, 5), QPointF(5, 5), QPoint(), QPoint(0, 120), Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(widget, &wheel);
}

TEST_F(RemoteControlTest, SettingsShowWhatIsInForceAndAskForWhatTheUserChooses) {
  robot_.connectIt();
  open("Camera");
  Q_EMIT robot_.settingsDescribed({{"jpeg_quality", "", 5, 95, {}},
                                   {"gain", "", {}, {}, {{"low", 1}, {"mid", 2}}},
                                   {"auto_exposure", "", {}, {}, {{"no", false}, {"yes", true}}}});
  robot_.take();
  Q_EMIT robot_.settingsChanged({{"jpeg_quality", 85}, {"gain", 2}, {"auto_exposure", true}, {"guard", true}});
  EXPECT_EQ(robot_.take(), QStringList()) << "what the driver says is no wish";
  EXPECT_EQ(find<QDoubleSpinBox>("jpeg_quality")->value(), 85);
  EXPECT_EQ(find<QComboBox>("auto_exposure")->currentText(), "yes");
  for (const char* name : {"jpeg_quality", "gain", "driver"}) {
    turnWheel(find<QWidget>(name));
    EXPECT_EQ(robot_.take(), QStringList()) << "whoever scrolls changes nothing: " << name;
  }
  find<QDoubleSpinBox>("jpeg_quality")->setValue(999);
  EXPECT_EQ(robot_.take(), QStringList("jpeg_quality 95"));
  Q_EMIT find<QComboBox>("gain")->activated(0);
  EXPECT_EQ(robot_.take(), QStringList("gain 1"));
  open("Move");
  EXPECT_EQ(click("guard_walks"), QStringList("guard false"));
  EXPECT_TRUE(find<QCheckBox>("guard_walks")->isChecked()) << "the window shows what the robot reports";
}

TEST_F(RemoteControlTest, EachJointHasASliderWithinTheLimitsOfItsRobot) {
  robot_.connectIt();
  open("Joints");
  const int limit_of_an_ers7 = find<JointSlider>("head_tilt")->slider()->maximum();
  robot_.connectIt(2, "ERS-210");
  EXPECT_NE(find<JointSlider>("head_tilt")->slider()->maximum(), limit_of_an_ers7);
}

/// The page Joints of an ERS-7 whose joints are all measured at 0 or at their limits.
class KeyFrameTest : public RemoteControlTest {
 protected:
  KeyFrameTest() {
    robot_.connectIt();
    open("Joints");
    Q_EMIT robot_.jointsMeasured(positions());
  }

  JointPositions positions() {
    JointPositions measured;
    for (const JointSlider* slider : window_.findChildren<JointSlider*>()) {
      measured[slider->joint()] = 0;
    }
    return measured;
  }

  // The motion that the robot would get, as text.
  QString uploadedText() {
    mtn::Motion motion;
    EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(robot_.uploaded.constData()),
                            static_cast<size_t>(robot_.uploaded.size())))
        << motion.problem();
    return QString::fromStdString(motion_tool::printTextForm(motion));
  }
};

TEST_F(KeyFrameTest, PosesBecomeAMotionThatIsUploadedAndThenPlayed) {
  EXPECT_EQ(click("Play on robot"), QStringList()) << "there is no key frame";
  find<QLineEdit>("name_of_new_motion")->setText("WAVE");
  click("Add key frame");
  find<JointSlider>("head_pan")->slider()->setValue(500);
  JointPositions moved = positions();
  moved["tail_pan"] = -0.3;
  Q_EMIT robot_.jointsMeasured(moved);
  click("Add key frame");
  click("Add key frame");
  click("Undo");
  EXPECT_EQ(textOf("new_motion"), "2 key frames, 1 s");
  find<QDoubleSpinBox>("seconds")->setValue(2);
  EXPECT_EQ(textOf("new_motion"), "2 key frames, 2 s");
  EXPECT_EQ(click("Play on robot"), QStringList("upload WAVE"));
  EXPECT_THAT(uploadedText().toStdString(), testing::HasSubstr("at 2000\n"));
  EXPECT_THAT(uploadedText().toStdString(), testing::HasSubstr("head_pan 28.")) << "where its slider has sent it";
  EXPECT_THAT(uploadedText().toStdString(), testing::HasSubstr("tail_pan -17.")) << "where it is measured";
  Q_EMIT robot_.motionUploaded("WAVE");
  EXPECT_EQ(robot_.take(), QStringList("play WAVE 1"));
  click("Clear");
  EXPECT_EQ(click("Play on robot"), QStringList());
}

TEST_F(KeyFrameTest, AStopDuringTheUploadIsTheEndOfIt) {
  click("Add key frame");
  EXPECT_EQ(click("Play on robot"), QStringList("upload POSE"));
  Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOn, Posture::kStanding, "/pad"));
  Q_EMIT robot_.conditionChanged({});
  Q_EMIT robot_.motionUploaded("POSE");
  EXPECT_EQ(robot_.take(), QStringList());
}

TEST_F(KeyFrameTest, PosesCanBeAddedWhileTheMotorsAreOffAndSavedWithoutARobot) {
  Q_EMIT robot_.conditionChanged(conditionOf(Motors::kOff, Posture::kLying));
  EXPECT_FALSE(find<JointSlider>("head_pan")->slider()->isEnabled());
  find<QAbstractButton>("Add key frame")->click();
  robot_.disconnectIt(State::kDisconnected, "the battery is empty");
  const test_support::TemporaryFolder folder;
  const std::string path = (folder.path() / "POSE").string();
  const std::tuple<const char*, const char*, const char*> rows[] = {
      {".txt", "name POSE\n", "saved as "},
      {".MTN", "OMTN", "saved as "},
      {".txt", "name POSE\n", "exists; choose another name"},
      {"/no/such/folder.txt", "", "not saved: "},
  };
  for (const auto& [ending, begin, words] : rows) {
    click("Save as...");
    EXPECT_EQ(QApplication::activeModalWidget(), nullptr) << "STOP can be clicked meanwhile";
    Q_EMIT window_.findChild<QFileDialog*>()->fileSelected(QString::fromStdString(path + ending));
    EXPECT_TRUE(textOf("new_motion").contains(words)) << textOf("new_motion").toStdString();
    QFile file(QString::fromStdString(path + ending));
    EXPECT_EQ(file.open(QIODevice::ReadOnly) && file.readAll().startsWith(begin), *begin != '\0') << ending;
  }
}

TEST(JointSliderTest, CommandsItsJointAndFollowsItAgainAfterwards) {
  JointSlider slider({"head_pan", 2, -1.5, 1.5, 3, 3, false}, "pan");
  JointPositions moved;
  QObject::connect(&slider, &JointSlider::moved,
                   [&moved](const QString& joint, double position) { moved[joint] = position; });
  const auto shows = [&slider](double measured) {  // in thousandths
    slider.measure(measured);
    return slider.slider()->value();
  };
  EXPECT_FALSE(slider.slider()->isEnabled()) << "its joint has not been measured yet";
  EXPECT_EQ(shows(0.4), 400);
  turnWheel(slider.slider());
  EXPECT_EQ(moved, JointPositions());
  slider.slider()->setValue(1000);
  EXPECT_EQ(moved, JointPositions({{"head_pan", 1.0}}));
  EXPECT_EQ(shows(0.6), 1000) << "the joint is on its way";
  shows(0.99);
  EXPECT_EQ(shows(0.7), 700) << "it has been there, and somebody else has moved it";
  QElapsedTimer since_moved;
  since_moved.start();
  slider.slider()->setValue(1000);
  EXPECT_TRUE(QTest::qWaitFor([&] { return shows(0.6) == 600; }, 20000)) << "it does not arrive";
  EXPECT_GE(since_moved.elapsed(), 2000);
  slider.slider()->setSliderDown(true);
  slider.slider()->setValue(450);
  EXPECT_EQ(shows(0.2), 450) << "it is held";
}

}  // namespace
}  // namespace aibo_driver::remote_control

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  ::testing::InitGoogleMock(&argc, argv);
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
