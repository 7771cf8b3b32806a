// Whatever another driver has said and the user has done with it: for the next driver, the window is as a fresh one.
#include <gmock/gmock.h>

#include <QAbstractButton>
#include <QApplication>
#include <QBuffer>
#include <QCheckBox>
#include <QComboBox>
#include <QCryptographicHash>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QtTest/QTest>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "remote_control/axis_pad.h"
#include "remote_control/connection_bar.h"
#include "remote_control/joint_slider.h"
#include "remote_control/page.h"
#include "remote_control/picture_view.h"
#include "remote_control/remote_control.h"
#include "unit/remote_control/fake_robot.h"

namespace aibo_driver::remote_control {
namespace {

using State = RobotConnection::State;
using Posture = RobotCondition::Posture;

constexpr const char* kPages[] = {"Move", "Camera", "Motions", "Joints", "Lights", "Sensors", "Sound"};

/// A window, its user, and a robot that says things.
class UsedWindow {
 public:
  UsedWindow() : window_(robot) {
    window_.setFolder("/pictures");
    window_.resize(480, 700);
    window_.show();
    window_.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window_));
    Q_EMIT robot.driversFound({"/anna", "/rex"});
  }

  template <typename Widget>
  Widget* find(const QString& name = "") {
    auto* widget = window_.findChild<Widget*>(name);
    if (widget == nullptr) {
      throw std::runtime_error("there is no " + name.toStdString());
    }
    return widget;
  }

  void open(const QString& page) { find<QTabWidget>()->setCurrentWidget(find<Page>(page)); }

  void connectTo(const QString& name_space, int version = 2, const QString& design = "ERS-7",
                 State state = State::kConnected) {
    RobotConnection connection;
    connection.state = state;
    connection.name_space = name_space;
    connection.robot = version == 2 ? design : "";
    connection.address = "robot:54321";
    connection.protocol_version = version;
    connection.text = "as the driver in " + name_space + " says";
    Q_EMIT robot.connectionChanged(connection);
  }

  /// As RosRobot does it.
  void useNextDriver() {
    connectTo("/rex", 0, "", State::kWaiting);
    Q_EMIT robot.conditionChanged({});
    Q_EMIT robot.streamingChanged(false);
    Q_EMIT robot.movementChanged("", false);
    Q_EMIT robot.ledsChanged({});
    Q_EMIT robot.settingsDescribed({});
    Q_EMIT robot.settingsChanged({});
  }

  /// What a driver says only sometimes.
  void sayMuch() {
    Q_EMIT robot.settingsDescribed({{"gain", "the gain", Setting::Kind::kChoice, 0, 0, {{"low", 1}, {"mid", 2}}},
                                    {"jpeg_quality", "how good", Setting::Kind::kInteger, 1, 100, {}},
                                    {"auto_exposure", "by itself", Setting::Kind::kSwitch, 0, 0, {}},
                                    {"speed_scale", "how fast", Setting::Kind::kNumber, 0.1, 1, {}}});
    Q_EMIT robot.settingsChanged({{"gain", 2}, {"jpeg_quality", 33}, {"auto_exposure", true}, {"speed_scale", 0.4}});
    RobotCondition condition;
    condition.motors = RobotCondition::Motors::kOff;
    condition.posture = Posture::kFallen;
    condition.is_stopped = true;
    condition.stopped_by = "/anna/gamepad";
    Q_EMIT robot.conditionChanged(condition);
    Q_EMIT robot.linkMeasured({29.9, 0.012, 0.034});
    Q_EMIT robot.batteryMeasured(0.1, 39);
    QImage picture(416, 320, QImage::Format_RGB32);
    picture.fill(Qt::red);
    Q_EMIT robot.streamingChanged(true);
    Q_EMIT robot.pictureArrived(picture);
    Q_EMIT robot.pictureTaken(picture, "/pictures/1.jpg");
    Q_EMIT robot.movementChanged("moved by /anna (walk); ended: NOD.MTN", true);
    Q_EMIT robot.motionsListed({"NOD.MTN", "SIT.MTN"});
    LedIntensities leds;
    for (int led = 1; led <= 14; ++led) {
      leds["face_" + QString::number(led)] = led / 14.0;
    }
    Q_EMIT robot.ledsChanged(leds);
    Q_EMIT robot.answered(false, "walk: too far");
  }

  void measureMuch() {
    Q_EMIT robot.jointsMeasured({{"head_pan", 0.8}, {"head_tilt", 0.5}, {"left_hind_knee", 0.7}, {"tail_pan", -0.4}});
    Q_EMIT robot.touched({"head", "back_rear", "paw_left_hind"});
    Q_EMIT robot.distanceMeasured({"near", 0.1, 0.5});
    Q_EMIT robot.distanceMeasured({"chest", 0.15, 0.9});
    Q_EMIT robot.heard(-3);
  }

  void measureLittle() {
    Q_EMIT robot.jointsMeasured({{"head_pan", 0.802}, {"head_tilt", -0.1}, {"left_front_knee", 0.3}});
    Q_EMIT robot.touched({"chin"});
    Q_EMIT robot.distanceMeasured({"near", std::numeric_limits<double>::infinity(), 0.5});
    Q_EMIT robot.heard(-30);
  }

  /// What the next driver says, and says only once; in part the same.
  void sayLittle() {
    Q_EMIT robot.settingsDescribed({{"jpeg_quality", "how good", Setting::Kind::kInteger, 1, 100, {}},
                                    {"gain", "the gain", Setting::Kind::kChoice, 0, 0, {{"low", 1}, {"high", 3}}}});
    Q_EMIT robot.settingsChanged({{"gain", 3}});
    RobotCondition condition;
    condition.posture = Posture::kStanding;
    Q_EMIT robot.conditionChanged(condition);
    Q_EMIT robot.linkMeasured({7, kUnknown, 0});
    Q_EMIT robot.batteryMeasured(0.9, kUnknown);
    QImage picture(208, 160, QImage::Format_RGB32);
    picture.fill(Qt::blue);
    Q_EMIT robot.streamingChanged(true);
    Q_EMIT robot.pictureArrived(picture);
    Q_EMIT robot.pictureTaken(picture, "/pictures/2.jpg");
    Q_EMIT robot.movementChanged("moved by /rex", false);
    Q_EMIT robot.motionsListed({"SIT.MTN"});
    Q_EMIT robot.ledsChanged({{"face_2", 0.5}});
    Q_EMIT robot.answered(true, "sit: sits");
  }

  /// The user's own entries are kept for the next driver; without them, both windows can be compared.
  void tidyUp() {
    find<QCheckBox>("listen")->setChecked(false);
    find<QLineEdit>("motion_name")->clear();
    find<QSpinBox>()->setValue(1);
    QImage picture(208, 160, QImage::Format_RGB32);
    picture.fill(Qt::yellow);
    Q_EMIT robot.pictureTaken(picture, "/pictures/0.jpg");
    open("Move");
    if (QWidget* const focus = window_.focusWidget()) {
      focus->clearFocus();
    }
    robot.take();
  }

  /// All that can be seen, page by page, and what has been wished meanwhile.
  QStringList look() {
    settle();
    QStringList seen = robot.take();
    for (QWidget* part : {static_cast<QWidget*>(find<ConnectionBar>()), static_cast<QWidget*>(find<PictureView>())}) {
      seen.append(part->metaObject()->className() + pixelsOf(part));
    }
    for (const char* page : kPages) {
      open(page);
      settle();
      seen.append(textsOf(find<Page>(page)));
      for (auto* slider : find<Page>(page)->findChildren<MarkedSlider*>()) {
        seen.append(slider->parentWidget()->objectName() + pixelsOf(slider));
      }
    }
    seen.append(textsOf(&window_));
    for (const auto* pad : window_.findChildren<AxisPad*>()) {
      const QPointF place = pad->measured().value_or(QPointF(9, 9));
      seen.append(pad->objectName() + QString(" %1 %2").arg(place.x()).arg(place.y()));
    }
    open("Move");
    return seen + robot.take();
  }

  /// Says this, and then what is measured with each page open, because it goes only to what is visible.
  void say(void (UsedWindow::*what)()) {
    (this->*what)();
    for (const char* page : kPages) {
      open(page);
      (what == &UsedWindow::sayMuch) ? measureMuch() : measureLittle();
    }
  }

  /// What each button wishes for; all of them twice.
  QStringList clickEverything() {
    QStringList answers;
    for (int round = 0; round < 2; ++round) {
      for (const char* page : kPages) {
        open(page);
        robot.take();
        for (auto* button : find<Page>(page)->findChildren<QAbstractButton*>()) {
          if (button->objectName() != "thumbnail" && button->objectName() != "folder") {
            button->click();
            answers.append(button->objectName() + ": " + robot.take().join("; "));
          }
        }
      }
    }
    for (const char* name : {"take_picture", "stream", "stop"}) {
      find<QAbstractButton>(name)->click();
      answers.append(name + (": " + robot.take().join("; ")));
    }
    return answers;
  }

  void press(const QString& pad) { QTest::mousePress(find<QWidget>(pad), Qt::LeftButton, {}, QPoint(20, 30)); }

  void drag(const QString& joint, int value) { find<JointSlider>(joint)->findChild<QSlider*>()->setValue(value); }

  FakeRobot robot;

 private:
  /// Lets Qt delete and lay out everything.
  static void settle() {
    for (int round = 0; round < 4; ++round) {
      QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
      QCoreApplication::sendPostedEvents();
    }
  }

  static QString pixelsOf(QWidget* widget) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    widget->grab().save(&buffer, "BMP");
    return " looks like " + QCryptographicHash::hash(bytes, QCryptographicHash::Md5).toHex();
  }

  static QStringList textsOf(QWidget* top) {
    QStringList texts;
    for (const auto* widget : top->findChildren<QWidget*>()) {
      const auto* label = qobject_cast<const QLabel*>(widget);
      if (widget->objectName().startsWith("qt_") || widget->objectName() == "status" ||
          (label != nullptr && label->text().isEmpty())) {
        continue;  // the status begins with the time
      }
      QString text = QString(widget->metaObject()->className()) + " " + widget->objectName();
      text += widget->isEnabled() ? " enabled" : " disabled";
      text += widget->isHidden() ? " hidden" : "";
      for (const char* property : {"text", "value", "minimum", "maximum", "checked", "currentText", "format", "toolTip",
                                   "styleSheet", "title"}) {
        text += QString(" %1=%2").arg(property, widget->property(property).toString());
      }
      if (const auto* list = qobject_cast<const QListWidget*>(widget)) {
        for (int i = 0; i < list->count(); ++i) {
          text += " " + list->item(i)->text();
        }
      } else if (const auto* choice = qobject_cast<const QComboBox*>(widget)) {
        for (int i = 0; i < choice->count(); ++i) {
          text += " " + choice->itemText(i) + "=" + choice->itemData(i).toString();
        }
      } else if (const auto* bar = qobject_cast<const QProgressBar*>(widget);
                 bar != nullptr && bar->value() > bar->minimum()) {
        text += " in " + widget->palette().color(QPalette::Highlight).name();
      }
      text += widget->property("touched").toBool() ? " touched" : "";
      texts.append(text);
    }
    texts.sort();  // widgets that were made later may be in another order
    return texts;
  }

  RemoteControl window_;
};

using History = std::pair<const char*, std::function<void(UsedWindow&)>>;

const std::vector<History> kHistories = {
    {"much that was said",
     [](UsedWindow& use) {
       use.connectTo("/anna");
       use.say(&UsedWindow::sayMuch);
     }},
    {"an ERS-210",
     [](UsedWindow& use) {
       use.connectTo("/anna", 2, "ERS-210");
       use.say(&UsedWindow::sayMuch);
     }},
    {"a robot of version 1",
     [](UsedWindow& use) {
       use.connectTo("/anna", 1);
       use.say(&UsedWindow::sayMuch);
     }},
    {"a playback",
     [](UsedWindow& use) {
       use.connectTo("/anna", 2, "ERS-7", State::kPlayback);
       use.say(&UsedWindow::sayMuch);
     }},
    {"a lost connection",
     [](UsedWindow& use) {
       use.connectTo("/anna");
       use.say(&UsedWindow::sayMuch);
       use.connectTo("/anna", 2, "ERS-7", State::kDisconnected);
       use.say(&UsedWindow::sayMuch);  // it was on its way
     }},
    {"a driver that fell silent, and clicks",
     [](UsedWindow& use) {
       use.connectTo("/anna");
       use.say(&UsedWindow::sayLittle);
       use.clickEverything();
       use.connectTo("/anna", 2, "ERS-7", State::kNoDriver);
     }},
    {"joints that have not arrived, and held pads",
     [](UsedWindow& use) {
       use.connectTo("/anna");
       use.say(&UsedWindow::sayLittle);
       use.open("Joints");
       use.drag("head_pan", -600);
       use.drag("left_front_knee", 900);
       use.open("Move");
       use.press("head_pad");
       use.press("drive_pad");
     }},
    {"a microphone that was listened to",
     [](UsedWindow& use) {
       use.connectTo("/anna");
       use.open("Sound");
       use.find<QCheckBox>("listen")->setChecked(true);
       use.sayMuch();
       use.measureMuch();
     }},
};

/// What is seen, stage by stage, with the next driver.
QStringList seenAfter(const std::function<void(UsedWindow&)>& history) {
  UsedWindow use;
  history(use);
  use.useNextDriver();
  use.tidyUp();
  use.connectTo("/rex");
  QStringList seen = use.look();
  use.find<QCheckBox>("listen")->setChecked(true);
  use.say(&UsedWindow::sayLittle);
  seen += use.look();
  seen += use.clickEverything();
  use.connectTo("/rex", 2, "ERS-7", State::kDisconnected);
  return seen + use.look();
}

TEST(WindowHistory, ForTheNextDriverTheWindowIsAsAFreshOne) {
  const QStringList fresh = seenAfter([](UsedWindow& /*use*/) {});
  for (const auto& [name, history] : kHistories) {
    const QStringList seen = seenAfter(history);
    ASSERT_EQ(seen.size(), fresh.size()) << name;
    for (int i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].toStdString(), fresh[i].toStdString()) << "after " << name;
    }
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
