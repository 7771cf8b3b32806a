// The window of the remote control with a running driver and a simulated robot, without a display.

#include <aibo_driver/Connection.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/PointStamped.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Bool.h>

#include <QAbstractButton>
#include <QApplication>
#include <QDir>
#include <QLabel>
#include <QListWidget>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QThread>
#include <QtTest/QTest>
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "remote_control/axis_pad.h"
#include "remote_control/joint_slider.h"
#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using aibo_driver::remote_control::AxisPad;
using aibo_driver::remote_control::JointSlider;
using aibo_driver::remote_control::PictureView;
using aibo_driver::remote_control::RemoteControl;
using aibo_driver::remote_control::RosRobot;
using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TemporaryFolder;
using test_support::TopicListener;

constexpr int kTimeout = 30000;  // ms; only a failing test waits this long

// A busy computer may be silent for longer than a robot.
const std::vector<std::string> kPatient{"_read_timeout:=20"};

/// The window, and somebody who uses it.
class User {
 public:
  explicit User(const std::string& name_space) : window(robot) {
    window.resize(480, 700);
    window.useDriver(QString::fromStdString(name_space));
    window.show();
    window.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window));
  }

  bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kTimeout); }

  template <typename Widget>
  Widget* find(const QString& name) {
    return window.findChild<Widget*>(name);
  }

  void open(const QString& page) { find<QTabWidget>("")->setCurrentWidget(find<QWidget>(page)); }

  QString textOf(const QString& label) { return find<QLabel>(label)->text(); }

  bool waitForText(const QString& label, const QString& part) {
    return waitFor([=] { return textOf(label).contains(part); });
  }

  bool waitForConnection() {
    return waitFor([this] { return find<QWidget>("Play")->isEnabled(); });
  }

  // Clicks, and waits for the answer.
  bool click(const QString& button, const QString& answer) {
    QStringList answers;
    const auto listening = QObject::connect(&robot, &RosRobot::answered, &window,
                                            [&answers](bool, const QString& text) { answers.append(text); });
    EXPECT_TRUE(find<QAbstractButton>(button)->isEnabled()) << find<QWidget>(button)->toolTip().toStdString();
    find<QAbstractButton>(button)->click();
    const bool came = waitFor([&] { return !answers.filter(answer).empty(); });
    QObject::disconnect(listening);
    EXPECT_TRUE(came) << answers.join("; ").toStdString();
    return came;
  }

  RosRobot robot;
  RemoteControl window;
};

class RemoteControlRosTest : public ::testing::Test {
 protected:
  explicit RemoteControlRosTest(const std::string& name_space = "/remote")
      : driver_(std::make_unique<DriverProcess>(name_space, simulated_.port(), kPatient)), user_(name_space) {
    EXPECT_TRUE(user_.waitForConnection()) << user_.textOf("connection").toStdString();
  }

  SimulatedRobot simulated_;
  std::unique_ptr<DriverProcess> driver_;
  User user_;
};

TEST_F(RemoteControlRosTest, ShowsTheRobotsStateAndPictures) {
  EXPECT_TRUE(user_.waitForText("connection", "ERS-7"));
  EXPECT_TRUE(user_.waitForText("battery", "Battery"));
  EXPECT_TRUE(user_.waitForText("link", "pictures/s"));
  int pictures = 0;
  QObject::connect(&user_.robot, &RosRobot::pictureArrived, [&pictures](const QImage& picture) {
    EXPECT_EQ(picture.size(), QSize(208, 160));
    ++pictures;
  });
  EXPECT_TRUE(user_.waitFor([&pictures] { return pictures >= 3; }));
}

TEST_F(RemoteControlRosTest, TakesAPictureAndSavesIt) {
  const TemporaryFolder folder;
  user_.window.setFolder(QString::fromStdString(folder.path().string()));
  EXPECT_TRUE(user_.click("take_picture", "take picture: "));
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QWidget>("thumbnail")->isEnabled(); }));
  const QImage saved(user_.textOf("path"));
  EXPECT_EQ(saved.size(), QSize(208, 160));
  EXPECT_TRUE(user_.textOf("path").startsWith(QString::fromStdString(folder.path().string())));
}

TEST_F(RemoteControlRosTest, APictureThatCannotBeSavedSaysWhy) {
  user_.window.setFolder("/proc/no/such/folder");
  EXPECT_TRUE(user_.click("take_picture", "not saved in /proc/no/such/folder"));
}

TEST_F(RemoteControlRosTest, SwitchesTheStreamAndShowsIt) {
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QAbstractButton>("stream")->text() == "Stop stream"; }));
  EXPECT_TRUE(user_.click("stream", "stream off: "));
  EXPECT_TRUE(user_.waitFor([this] { return user_.find<QAbstractButton>("stream")->text() == "Start stream"; }));
}

TEST_F(RemoteControlRosTest, AnswersOfPosturesMotorsStopAndReleaseAreRepeated) {
  const auto shows = [this](const QString& text) {
    return user_.waitFor([this, text] { return user_.find<QAbstractButton>("stop")->text() == text; });
  };
  EXPECT_TRUE(user_.click("Sit", "sit: "));
  EXPECT_TRUE(user_.click("stop", "stop: "));
  EXPECT_TRUE(shows("Release"));
  EXPECT_FALSE(user_.find<QWidget>("head_pad")->isEnabled());
  QTest::qWait(1100);  // sooner it stops once more
  EXPECT_TRUE(user_.click("stop", "release: "));
  EXPECT_TRUE(shows("STOP"));
  EXPECT_TRUE(user_.find<QWidget>("head_pad")->isEnabled());
  EXPECT_TRUE(user_.click("Motors off", "motors off: "));
  EXPECT_TRUE(user_.click("Motors on", "motors on: "));
}

TEST_F(RemoteControlRosTest, PlaysAMotionAndShowsIt) {
  user_.open("Motions");
  auto* list = user_.find<QListWidget>("motions");
  ASSERT_TRUE(user_.waitFor([list] { return !list->findItems("NOD.MTN", Qt::MatchExactly).empty(); }));
  EXPECT_EQ(user_.textOf("status"), "Nothing has been asked of the robot yet.");
  list->setCurrentItem(list->findItems("NOD.MTN", Qt::MatchExactly).front());
  user_.find<QSpinBox>("")->setValue(50);
  EXPECT_TRUE(user_.click("Play", "play NOD.MTN: "));
  EXPECT_TRUE(user_.waitForText("movement", "NOD.MTN"));
  EXPECT_TRUE(user_.click("Stop motions", "stop motions: "));
}

TEST_F(RemoteControlRosTest, MovesTheHeadAndAJoint) {
  TopicListener<sensor_msgs::JointState> states("/remote/joint_states");
  const auto is_at = [&states](const std::string& joint, double position) {
    return states.waitFor(
               [&](const sensor_msgs::JointState& state) {
                 for (std::size_t i = 0; i < state.name.size(); ++i) {
                   if (state.name[i] == joint && std::abs(state.position[i] - position) < 0.05) {
                     return true;
                   }
                 }
                 return false;
               },
               std::chrono::milliseconds(kTimeout)) != nullptr;
  };
  auto* pad = user_.find<AxisPad>("head_pad");
  const QPoint left(pad->width() / 2 - std::min(pad->width(), pad->height()) / 4, pad->height() / 2);
  EXPECT_TRUE(user_.waitFor([&] {  // the driver may not have subscribed to the window's topics yet
    QTest::mouseClick(pad, Qt::LeftButton, {}, left);
    return user_.textOf("movement").contains("head_pan");
  }));
  EXPECT_TRUE(is_at("head_pan", 0.77));
  user_.open("Joints");
  auto* slider = user_.find<JointSlider>("tail_pan")->slider();
  ASSERT_TRUE(user_.waitFor([slider] { return slider->isEnabled(); }));
  slider->setValue(400);
  EXPECT_TRUE(is_at("tail_pan", 0.4));
}

TEST_F(RemoteControlRosTest, WalksWhileThePadIsHeld) {
  user_.open("Motions");
  ASSERT_TRUE(user_.waitForText("movement", "Now: "));
  user_.open("Move");
  auto* pad = user_.find<AxisPad>("drive_pad");
  QTest::mousePress(pad, Qt::LeftButton, {}, QPoint(pad->width() / 2, pad->height() / 4));
  EXPECT_TRUE(user_.waitForText("movement", "(walk)"));
  EXPECT_TRUE(user_.waitForText("condition", "walks"));
  QTest::mouseRelease(pad, Qt::LeftButton);
  EXPECT_TRUE(user_.waitFor([this] { return !user_.textOf("movement").contains("(walk)"); }));
}

TEST_F(RemoteControlRosTest, ChangesASetting) {
  user_.open("Camera");
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QSpinBox>("jpeg_quality") != nullptr; }));
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QSpinBox>("jpeg_quality")->value() == 85; }));
  user_.find<QSpinBox>("jpeg_quality")->setValue(60);
  EXPECT_TRUE(user_.waitForText("status", "jpeg_quality is 60")) << user_.textOf("status").toStdString();
}

TEST_F(RemoteControlRosTest, AClickIntoThePictureSaysWhereToLook) {
  TopicListener<geometry_msgs::PointStamped> look_at("/remote/look_at");
  auto* view = user_.window.findChild<PictureView*>();
  bool has_picture = false;
  QObject::connect(&user_.robot, &RosRobot::pictureArrived, [&has_picture](const QImage&) { has_picture = true; });
  ASSERT_TRUE(user_.waitFor([&has_picture] { return has_picture; }));
  EXPECT_TRUE(user_.waitFor([&] {
    QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center() + QPoint(40, 0));
    return look_at.count() > 0;
  }));
  const auto point = look_at.waitForCount(1).front();
  EXPECT_EQ(point->header.frame_id, "camera_optical_frame");
  EXPECT_GT(point->point.x, 0.05);
  EXPECT_NEAR(point->point.y, 0, 0.05);
}

TEST_F(RemoteControlRosTest, SurvivesARestartOfTheDriverAndSaysWhatIsMissingMeanwhile) {
  driver_.reset();
  EXPECT_TRUE(user_.waitForText("connection", "does not answer"));
  EXPECT_FALSE(user_.find<QWidget>("take_picture")->isEnabled());
  EXPECT_TRUE(user_.click("stop", "no answer from the service"));
  driver_ = std::make_unique<DriverProcess>("/remote", simulated_.port(), kPatient);
  EXPECT_TRUE(user_.waitForConnection());
  EXPECT_TRUE(user_.click("Motors on", "motors on: "));
}

TEST_F(RemoteControlRosTest, ARobotThatIsSwitchedOffIsShown) {
  simulated_.kill();
  EXPECT_TRUE(user_.waitFor([this] { return !user_.find<QWidget>("Play")->isEnabled(); }));
  simulated_.restart();
  EXPECT_TRUE(user_.waitForConnection());
}

// Whoever is stopped by SIGSTOP answers nobody; the window goes on.
TEST_F(RemoteControlRosTest, ADriverThatHangsDoesNotHoldUpTheWindow) {
  const auto is_touched = [this] { return user_.find<QLabel>("chin")->property("touched").toBool(); };
  user_.open("Sensors");
  simulated_.type("press chin");
  EXPECT_TRUE(user_.waitFor(is_touched));
  driver_->signal(SIGSTOP);
  QTest::mouseClick(user_.find<QAbstractButton>("Sit"), Qt::LeftButton);
  EXPECT_TRUE(user_.waitForText("connection", "does not answer"));
  EXPECT_FALSE(is_touched());
  driver_->signal(SIGCONT);
  EXPECT_TRUE(user_.waitForConnection());
  EXPECT_TRUE(user_.waitFor(is_touched)) << "the same place as before";
}

// Another node pretends to be the driver, faster than the window can show it, and with long texts.
TEST_F(RemoteControlRosTest, AFloodOfMessagesDoesNotHoldUpTheWindow) {
  constexpr int kFlood = 1000;
  ros::Publisher liar = ros::NodeHandle().advertise<aibo_driver::RobotState>("/remote/robot_state", 1);
  ASSERT_TRUE(user_.waitFor([&liar] { return liar.getNumSubscribers() > 0; }));
  int shown = 0;
  QObject::connect(&user_.robot, &RosRobot::conditionChanged, [&shown](const auto&) { ++shown; });
  for (int i = 0; i < kFlood; ++i) {  // meanwhile, the window does something else
    aibo_driver::RobotState lie;
    lie.stopped = 1;
    lie.stopped_by = std::to_string(i) + std::string(10'000, 'x') + "\x1b";
    liar.publish(lie);
    QThread::msleep(2);
  }
  ASSERT_TRUE(user_.waitForText("condition", "stopped by " + QString::number(kFlood - 1)));
  EXPECT_LT(shown, kFlood / 3);
  EXPECT_LT(user_.textOf("condition").size(), 1000);
  EXPECT_FALSE(user_.textOf("condition").contains("\x1b"));
}

TEST(RemoteControlRos, WaitsForADriverThatHasNotBeenHeard) {
  User user("/nowhere");
  EXPECT_TRUE(user.waitForText("connection", "waiting for the driver in /nowhere"));
  EXPECT_TRUE(user.waitForText("connection", "waiting for the driver in /nowhere: is it running?"));
}

// The master may still know drivers that were killed, such as those of the tests above.
TEST(RemoteControlRos, FindsADriverByItself) {
  const SimulatedRobot simulated;
  const DriverProcess driver("/somewhere", simulated.port());
  User user("");
  EXPECT_TRUE(user.waitForConnection());
}

}  // namespace

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  ros::init(argc, argv, "remote_control_rostest", ros::init_options::AnonymousName);
  ::testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
