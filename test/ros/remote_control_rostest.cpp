// The window of the remote control with a running driver and a simulated robot, without a display.

#include <aibo_driver/Connection.h>
#include <aibo_driver/Ears.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Touch.h>
#include <geometry_msgs/PointStamped.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <rviz/panel.h>
#include <sensor_msgs/CompressedImage.h>
#include <pluginlib/class_loader.hpp>

#include <QtTest/QTest>
#include <QtWidgets>
#include <csignal>

#include "node/xmlrpc_peer.h"
#include "remote_control/axis_pad.h"
#include "remote_control/joint_slider.h"
#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"
#include "support/memory_stick.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::remote_control::RemoteControl;
using aibo_driver::remote_control::RosRobot;
using test_support::DriverProcess;
using test_support::kSafetyNet;
using test_support::Process;

test_support::FaultProxy* master = nullptr;  ///< between the windows of this process and the ROS master

constexpr int kTimeout = 1000 * kSafetyNet.count();  // ms

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
    EXPECT_TRUE(waitFor([&] { return find<QWidget>(button)->isEnabled(); }))
        << find<QWidget>(button)->toolTip().toStdString();
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

  // The next test's robot is not stopped.
  ~RemoteControlRosTest() override {
    driver_.reset();
    ros::param::del("/remote/stopped_by");
  }

  test_support::MemoryStick stick_{"ALLOW_UPLOAD=yes\n"};
  test_support::SimulatedRobot simulated_{{"--memory-stick", stick_.path().string()}};
  std::unique_ptr<DriverProcess> driver_;
  User user_;
};

TEST_F(RemoteControlRosTest, ShowsTheRobot) {
  EXPECT_TRUE(user_.waitForText("connection", QString("ERS-7 at 127.0.0.1:%1, connected").arg(simulated_.port())));
  EXPECT_TRUE(user_.waitForText("battery", "Battery"));
  bool has_picture = false;
  QObject::connect(&user_.robot, &RosRobot::pictureArrived, &user_.window,
                   [&has_picture](const QImage& picture) { has_picture = picture.size() == QSize(208, 160); });
  EXPECT_TRUE(user_.waitFor([&has_picture] { return has_picture; }));
  ASSERT_THAT(simulated_.type("press chin"), testing::HasSubstr("ok"));
  const ros::Publisher touch = ros::NodeHandle("/remote").advertise<aibo_driver::Touch>("touch", 1);
  user_.open("Sensors");
  EXPECT_TRUE(user_.waitFor([this] { return user_.find<QLabel>("chin")->property("touched").toBool(); }));
  EXPECT_TRUE(user_.waitFor([this] { return user_.find<QProgressBar>("range_near") != nullptr; }));
  user_.open("Sound");
  EXPECT_TRUE(user_.waitFor([&touch] { return touch.getNumSubscribers() == 0; })) << "nobody sees it";
}

TEST_F(RemoteControlRosTest, CommandsTheRobot) {
  const test_support::TemporaryFolder folder;
  user_.window.setFolder(QString::fromStdString(folder.path().string()) + "/new");
  EXPECT_TRUE(user_.click("take_picture", "take picture: "));
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QWidget>("thumbnail")->isEnabled(); }));
  EXPECT_EQ(QImage(user_.textOf("path")).size(), QSize(208, 160));

  auto* pad = user_.find<aibo_driver::remote_control::AxisPad>("drive_pad");
  QTest::mousePress(pad, Qt::LeftButton, {}, QPoint(pad->width() / 2, pad->height() / 4));
  EXPECT_TRUE(user_.waitForText("movement", "(walk)"));
  QTest::mouseRelease(pad, Qt::LeftButton);
  EXPECT_TRUE(user_.waitFor([this] { return !user_.textOf("movement").contains("(walk)"); }));

  // Again and again, because the driver may not have subscribed yet.
  user_.open("Joints");
  auto* slider = user_.find<aibo_driver::remote_control::JointSlider>("tail_pan")->slider();
  EXPECT_TRUE(user_.waitFor([&] {
    slider->setValue(slider->value() == 400 ? 300 : 400);
    return user_.textOf("movement").contains("tail_pan");
  }));
  EXPECT_TRUE(user_.waitFor([this] {  // until all joints have been measured
    user_.find<QAbstractButton>("Add key frame")->click();
    return user_.textOf("new_motion").contains("1 key frame");
  }));
  user_.open("Lights");
  EXPECT_TRUE(user_.waitFor([this] {
    const bool shines = !user_.find<QWidget>("face_3")->styleSheet().isEmpty();
    user_.find<QAbstractButton>("face_3")->click();
    return shines;
  }));
  test_support::TopicListener<aibo_driver::Ears> ears("/remote/ears");
  EXPECT_TRUE(user_.waitFor([&] {
    user_.find<QAbstractButton>("Left ear")->click();
    return ears.count() > 0;
  }));
  user_.open("Motions");
  auto* list = user_.find<QListWidget>("motions");
  ASSERT_TRUE(user_.waitFor([list] { return !list->findItems("NOD.MTN", Qt::MatchExactly).empty(); }));
  list->setCurrentItem(list->findItems("NOD.MTN", Qt::MatchExactly).front());
  user_.open("Sound");
  user_.find<QLineEdit>("say_text")->setText("hello");
  const std::tuple<const char*, const char*, const char*> buttons[] = {
      {"Move", "Sit", "sit: "},
      {"Move", "Motors on", "motors on: "},
      {"Move", "stream", "stream off: "},
      {"Joints", "Play on robot", "play POSE: POSE.MTN has begun"},
      {"Motions", "Play", "play NOD.MTN: "},
      {"Motions", "Stop motions", "stop motions: "},
      {"Sound", "Say", "say: "},
      {"Sound", "Silence", "stop sound: "},
  };
  for (const auto& [page, button, answer] : buttons) {
    user_.open(page);
    EXPECT_TRUE(user_.click(button, answer)) << button;
  }
  user_.open("Camera");
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QDoubleSpinBox>("jpeg_quality") != nullptr; }));
  user_.find<QDoubleSpinBox>("jpeg_quality")->setValue(60);
  EXPECT_TRUE(user_.waitForText("status", "jpeg_quality is 60")) << user_.textOf("status").toStdString();

  EXPECT_TRUE(user_.click("stop", "stop: "));
  EXPECT_TRUE(user_.waitFor([this] { return user_.find<QAbstractButton>("stop")->text() == "Release"; }));
}

// The camera is the nominal one.
TEST_F(RemoteControlRosTest, AClickIsAPointInFrontOfTheCameraAndOnlyItsOwnResultIsTold) {
  test_support::TopicListener<geometry_msgs::PointStamped> points("/remote/look_at");
  ros::Publisher results = ros::NodeHandle("/remote").advertise<aibo_driver::LookAtResult>("look_at_result", 10, true);
  EXPECT_TRUE(user_.waitFor([&] {  // until the camera is known
    user_.robot.lookAt({0.75, 0.25});
    return points.count() > 0;
  }));
  const auto point = points.waitForCount(1).front();
  EXPECT_EQ(point->header.frame_id, "camera_optical_frame");
  EXPECT_FALSE(point->header.stamp.isZero()) << "when the picture was taken";
  EXPECT_NEAR(point->point.x, 0.25 * 208 / 191.9, 0.01);
  EXPECT_NEAR(point->point.y, -0.25 * 160 / 191.9, 0.01);
  QObject::connect(&user_.robot, &RosRobot::answered, &user_.window,
                   [](bool, const QString& text) { EXPECT_FALSE(text.contains("no point of this window")); });
  aibo_driver::LookAtResult result;
  result.success = 1;
  result.message = "no point of this window";
  results.publish(result);
  result.message = "the head turns";
  EXPECT_TRUE(user_.waitFor([&] {  // the answer to the last click
    result.header = points.waitForCount(1).back()->header;
    results.publish(result);
    return user_.textOf("status").contains("look there: the head turns");
  }));
}

TEST_F(RemoteControlRosTest, StopsAsOftenAsItIsAskedToWhileTheMasterHangsOrIsDead) {
  const int pid = *aibo_driver::node::XmlRpcPeer::master().call("getPid", {});
  const std::pair<std::function<void()>, std::function<void()>> troubles[] = {
      {[pid] { ::kill(pid, SIGSTOP); }, [pid] { ::kill(pid, SIGCONT); }},
      {[] {
         master->setWelcome(test_support::Welcome::kReset);
         master->endConnections(test_support::Action::kClose);
       },
       [] { master->heal(); }}};
  int stops = 0;
  QObject::connect(&user_.robot, &RosRobot::answered, &user_.window, [&stops](bool success, const QString& text) {
    stops += int(success && text.startsWith("stop: The robot holds"));
  });
  user_.open("Motions");
  ASSERT_TRUE(user_.waitForText("movement", "Now: "));
  user_.open("Move");
  auto* pad = user_.find<aibo_driver::remote_control::AxisPad>("drive_pad");
  for (const auto& [begin, end] : troubles) {
    QTest::mousePress(pad, Qt::LeftButton, {}, QPoint(pad->width() / 2, pad->height() / 4));
    EXPECT_TRUE(user_.waitForText("condition", "walks"));
    begin();
    stops = 0;
    for (int press = 1; press <= 3; ++press) {
      user_.robot.stop();
      EXPECT_TRUE(user_.waitFor([&] { return stops == press; })) << user_.textOf("status").toStdString();
    }
    EXPECT_TRUE(user_.waitForText("condition", "stopped by " + QString::fromStdString(ros::this_node::getName())));
    EXPECT_FALSE(pad->isHeld());
    EXPECT_TRUE(user_.waitForText("connection", "connected (version 2); the ROS master does not answer"));
    end();
    QTest::mouseRelease(pad, Qt::LeftButton);
    EXPECT_TRUE(user_.waitFor([&] {
      user_.robot.release();
      return pad->isEnabled();
    }));
  }
}

// A process that is stopped by SIGSTOP does not answer, but the window goes on.
TEST_F(RemoteControlRosTest, GoesOnWhenTheDriverHasHungOrWasStartedAgain) {
  driver_->signal(SIGSTOP);
  QTest::mouseClick(user_.find<QAbstractButton>("Sit"), Qt::LeftButton);
  EXPECT_TRUE(user_.waitForText("connection", "does not answer"));
  EXPECT_FALSE(user_.find<QWidget>("take_picture")->isEnabled());
  driver_->signal(SIGCONT);
  EXPECT_TRUE(user_.waitForConnection());
  driver_.reset();
  EXPECT_TRUE(user_.waitForText("connection", "does not answer"));
  EXPECT_TRUE(user_.click("stop", "no answer from the service"));
  driver_ = std::make_unique<DriverProcess>("/remote", simulated_.port(), kPatient);
  EXPECT_TRUE(user_.waitForConnection());
  EXPECT_TRUE(user_.click("stop", "stop: The robot holds"));
  // Otherwise the answer could come after the end of this test, when the next driver runs.
  EXPECT_TRUE(user_.waitFor([] { return ros::param::has("/remote/stopped_by"); }));
}

// Another node pretends to be the driver, faster than the window can show it, and with texts that are long or too long.
TEST_F(RemoteControlRosTest, AFloodOfMessagesDoesNotHoldUpTheWindow) {
  constexpr int kFlood = 1000;
  ros::Publisher liar = ros::NodeHandle().advertise<aibo_driver::RobotState>("/remote/robot_state", 1);
  ASSERT_TRUE(user_.waitFor([&liar] { return liar.getNumSubscribers() > 0; }));
  int shown = 0;
  QObject::connect(&user_.robot, &RosRobot::conditionChanged, [&shown](const auto& condition) {
    ++shown;
    EXPECT_FALSE(condition.stopped_by.startsWith("too long"));
  });
  for (int i = 0; i < kFlood; ++i) {  // meanwhile, the window does something else
    aibo_driver::RobotState lie;
    lie.stopped = 1;
    lie.stopped_by =
        i % 2 == 0 ? "too long" + std::string(300'000, 'x') : std::to_string(i) + std::string(10'000, 'x') + "\x1b";
    liar.publish(lie);
    QThread::msleep(2);
  }
  ASSERT_TRUE(user_.waitForText("condition", "stopped by " + QString::number(kFlood - 1)));
  EXPECT_LT(shown, kFlood / 3);
  EXPECT_FALSE(user_.textOf("condition").contains("\x1b"));
  ros::V_string topics;
  ros::this_node::getSubscribedTopics(topics);
  EXPECT_THAT(topics, testing::Not(testing::Contains("/tf"))) << "a flood of frames freezes rviz";
}

TEST(RemoteControlRos, WaitsForADriverThatHasNotBeenHeardAndForTheMaster) {
  User user("/later");
  EXPECT_TRUE(user.waitForText("connection", "waiting for the driver in /later: is it running?"));
  master->setWelcome(test_support::Welcome::kReset);
  master->endConnections(test_support::Action::kReset);
  EXPECT_TRUE(user.waitForText("connection", "does not answer: is roscore running?"));
  master->heal();
  const ros::Publisher driver = ros::NodeHandle("/later").advertise<Connection>("connection", 1, true);
  Connection heard;
  heard.text = "the robot is off";
  heard.settings = "~lie";  // no place for settings
  driver.publish(heard);
  EXPECT_TRUE(user.waitForText("connection", "the robot is off"));
}

TEST(RemoteControlProgram, ShowsTheDriverOfItsNamespaceOrAnyUntilCtrlC) {
  for (const char* name_space : {"/window", "/"}) {
    const ros::Publisher driver = ros::NodeHandle("/window").advertise<Connection>("connection", 1, true);
    const ros::Publisher pictures =
        ros::NodeHandle("/window").advertise<sensor_msgs::CompressedImage>("camera/image_raw/compressed", 1);
    Process program({AIBO_REMOTE_CONTROL, std::string("__ns:=") + name_space}, {{"QT_QPA_PLATFORM", "offscreen"}});
    EXPECT_TRUE(QTest::qWaitFor([&driver] { return driver.getNumSubscribers() > 0; }, kTimeout)) << name_space;
    EXPECT_TRUE(QTest::qWaitFor([&pictures] { return pictures.getNumSubscribers() > 0; }, kTimeout))
        << "what nobody sees is not asked for";
    program.signal(SIGINT);
    EXPECT_EQ(program.waitForExit(kSafetyNet), 0) << program.output();
  }
}

TEST(RemoteControlProgram, SaysThatThereIsNoDisplay) {
  Process program({AIBO_REMOTE_CONTROL}, {{"QT_QPA_PLATFORM", "xcb"}, {"DISPLAY", ""}});
  EXPECT_EQ(program.waitForExit(kSafetyNet), 1);
  EXPECT_THAT(program.output(), testing::HasSubstr("there is no display for its window (DISPLAY is not set)"));
}

TEST(PanelOfRviz, KeepsDriverAndFolderAndFitsOnTheScreen) {
  pluginlib::ClassLoader<rviz::Panel> plugins("rviz", "rviz::Panel");
  QWidget window;
  const QRect screen = QGuiApplication::primaryScreen()->availableGeometry();
  window.resize(screen.size() + QSize(100, 100));
  auto* panel = plugins.createUnmanagedInstance("aibo_driver/RemoteControl");
  panel->setClassId("aibo_driver/RemoteControl");
  panel->setParent(&window);
  panel->initialize(nullptr);
  window.show();
  EXPECT_TRUE(QTest::qWaitFor([&] { return screen.contains(window.frameGeometry()); }, kTimeout));
  rviz::Config config;
  config.mapSetValue("Driver", "/left");
  config.mapSetValue("Picture Folder", "/pictures");
  panel->load(config);
  int changes = 0;
  QObject::connect(panel, &rviz::Panel::configChanged, [&changes] { ++changes; });
  auto* chooser = panel->findChild<QComboBox*>("driver");
  chooser->addItem("/right");
  Q_EMIT chooser->activated(chooser->findText("/right"));
  EXPECT_EQ(changes, 1) << "rviz asks whether to save it";
  rviz::Config saved;
  panel->save(saved);
  for (const auto& [key, expected] : {std::pair("Driver", "/right"),
                                      {"Picture Folder", "/pictures"},
                                      {"Class", "aibo_driver/RemoteControl"}}) {  // rviz makes the panel again from it
    QString value;
    EXPECT_TRUE(saved.mapGetString(key, &value)) << key;
    EXPECT_EQ(value, expected) << key;
  }
}

}  // namespace

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  const QByteArray real_master = qgetenv("ROS_MASTER_URI");
  test_support::FaultProxy proxy(QUrl(real_master).port());
  master = &proxy;
  qputenv("ROS_MASTER_URI", "http://127.0.0.1:" + QByteArray::number(proxy.port()));
  ros::init(argc, argv, "remote_control_rostest", ros::init_options::AnonymousName);
  qputenv("ROS_MASTER_URI", real_master);
  ::testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
