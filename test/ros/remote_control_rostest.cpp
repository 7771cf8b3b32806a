// The window of the remote control with a running driver and a simulated robot, without a display.

#include <aibo_driver/Connection.h>
#include <aibo_driver/Ears.h>
#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/PlaySound.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/Sound.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/Touch.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <rviz/panel.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_loader.hpp>

#include <QAbstractButton>
#include <QApplication>
#include <QBuffer>
#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QLabel>
#include <QLayout>
#include <QListWidget>
#include <QPainter>
#include <QRegularExpression>
#include <QScreen>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QThread>
#include <QTimer>
#include <QUrl>
#include <QtTest/QTest>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "node/xmlrpc_peer.h"
#include "remote_control/axis_pad.h"
#include "remote_control/joint_slider.h"
#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"
#include "remote_control/service_calls.h"
#include "support/process.h"
#include "support/proxy/fault_proxy.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::EndedMovement;
using aibo_driver::LinkQuality;
using aibo_driver::ListMotions;
using aibo_driver::LookAtResult;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::RobotState;
using aibo_driver::TakePicture;
using aibo_driver::Touch;
using aibo_driver::remote_control::AxisPad;
using aibo_driver::remote_control::JointSlider;
using aibo_driver::remote_control::Part;
using aibo_driver::remote_control::RemoteControl;
using aibo_driver::remote_control::RobotConnection;
using aibo_driver::remote_control::RosRobot;
using test_support::DriverProcess;
using test_support::FaultProxy;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::SimulatedRobot;
using test_support::TemporaryFolder;
using test_support::TopicListener;
using ::testing::ElementsAre;

FaultProxy* master = nullptr;  ///< between the windows of this process and the ROS master

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

  // The next test's robot is not stopped.
  ~RemoteControlRosTest() override {
    driver_.reset();
    ros::param::del("/remote/stopped_by");
  }

  SimulatedRobot simulated_;
  std::unique_ptr<DriverProcess> driver_;
  User user_;
};

TEST_F(RemoteControlRosTest, ShowsTheRobotsStateAndPictures) {
  EXPECT_TRUE(user_.waitForText("connection", QString("ERS-7 at 127.0.0.1:%1, connected").arg(simulated_.port())));
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
  user_.window.setFolder(QString::fromStdString(folder.path().string()) + "/new");
  EXPECT_TRUE(user_.click("take_picture", "take picture: "));
  ASSERT_TRUE(user_.waitFor([this] { return user_.find<QWidget>("thumbnail")->isEnabled(); }));
  const QImage saved(user_.textOf("path"));
  EXPECT_EQ(saved.size(), QSize(208, 160));
  EXPECT_TRUE(user_.textOf("path").startsWith(QString::fromStdString(folder.path().string()) + "/new/aibo_"));
}

TEST_F(RemoteControlRosTest, APictureThatCannotBeSavedSaysWhy) {
  user_.window.setFolder("/proc/no/such/folder");
  EXPECT_TRUE(user_.click("take_picture", "not saved in /proc/no/such/folder"));
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
  auto* pad = user_.find<AxisPad>("drive_pad");
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

TEST_F(RemoteControlRosTest, SurvivesARestartOfTheDriverAndSaysWhatIsMissingMeanwhile) {
  driver_.reset();
  EXPECT_TRUE(user_.waitForText("connection", "does not answer"));
  EXPECT_FALSE(user_.find<QWidget>("take_picture")->isEnabled());
  EXPECT_TRUE(user_.click("stop", "no answer from the service"));
  driver_ = std::make_unique<DriverProcess>("/remote", simulated_.port(), kPatient);
  EXPECT_TRUE(user_.waitForConnection());
  EXPECT_TRUE(user_.click("Motors on", "motors on: "));
  EXPECT_TRUE(user_.click("stop", "stop: The robot holds"));
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
  master->setWelcome(test_support::Welcome::kReset);
  master->endConnections(test_support::Action::kReset);
  EXPECT_TRUE(user.waitForText("connection", "the ROS master does not answer: is roscore running?"));
  master->heal();
}

// The master may still know drivers that were killed, such as those of the tests above.
TEST(RemoteControlRos, FindsADriverByItself) {
  const SimulatedRobot simulated;
  const DriverProcess driver("/somewhere", simulated.port());
  User user("");
  EXPECT_TRUE(user.waitForConnection());
  user.window.useDriver("/elsewhere");
  EXPECT_TRUE(user.waitFor([&] { return user.find<QComboBox>("driver")->currentText() == "/elsewhere"; }));
  EXPECT_GE(user.find<QComboBox>("driver")->findText("/somewhere"), 0) << "it can be chosen again";
}

TEST(RemoteControlRos, SaysThatTheMasterDoesNotAnswerAndGoesOnWhenItDoes) {
  const ros::Publisher driver = ros::NodeHandle("/later").advertise<Connection>("connection", 1, true);
  Connection heard;
  heard.text = "the robot is off";
  driver.publish(heard);
  master->setWelcome(test_support::Welcome::kReset);
  master->endConnections(test_support::Action::kReset);
  User user("/later");
  EXPECT_TRUE(user.waitForText("connection", "the ROS master does not answer: is roscore running?"));
  master->heal();
  EXPECT_TRUE(user.waitForText("connection", "the robot is off"));
}

// What passes between the window and a driver, which is a fake, and without a window.

constexpr const char* kTold = "/told";

class ToldTest : public ::testing::Test {
 protected:
  ToldTest() {
    QObject::connect(&robot_, &RosRobot::connectionChanged,
                     [this](const auto& now) { note("connection " + now.text); });
    QObject::connect(&robot_, &RosRobot::conditionChanged, [this](const auto& now) {
      note(QString("condition %1 %2 ").arg(int(now.motors)).arg(int(now.posture)) +
           (now.is_stopped ? "stopped by " : "") + now.stopped_by);
    });
    QObject::connect(&robot_, &RosRobot::linkMeasured, [this](const auto& link) {
      note(QString("link %1 %2 %3").arg(link.pictures_per_second).arg(link.age).arg(link.lost));
    });
    QObject::connect(&robot_, &RosRobot::batteryMeasured, [this](double charge, double temperature) {
      note(QString("battery %1 %2").arg(charge).arg(temperature));
    });
    QObject::connect(&robot_, &RosRobot::streamingChanged, [this](bool on) { note(on ? "streams" : "streams not"); });
    QObject::connect(&robot_, &RosRobot::movementChanged,
                     [this](const QString& text, bool plays) { note(text + (plays ? ", plays" : ", plays not")); });
    QObject::connect(&robot_, &RosRobot::ledsChanged, [this](const auto& leds) { note("leds" + list(leds)); });
    QObject::connect(&robot_, &RosRobot::jointsMeasured, [this](const auto& joints) { note("joints" + list(joints)); });
    QObject::connect(&robot_, &RosRobot::touched, [this](const auto& places) { note("touched " + places.join(",")); });
    QObject::connect(&robot_, &RosRobot::distanceMeasured, [this](const auto& distance) {
      note(QString("%1 %2 %3").arg(distance.name).arg(distance.metres).arg(distance.farthest));
    });
    QObject::connect(&robot_, &RosRobot::heard, [this](double level) { note(QString("level %1").arg(qRound(level))); });
    QObject::connect(&robot_, &RosRobot::pictureArrived, [this](const QImage& picture) {
      const QColor first = picture.pixelColor(2, 2);
      const QColor last = picture.pixelColor(picture.width() - 3, picture.height() - 3);
      note(QString("picture %1x%2 ").arg(picture.width()).arg(picture.height()) + (first.red() > 200 ? "red " : "") +
           (first.blue() < 50 ? "" : "blue ") + (last.red() < 50 ? "" : "red ") + (last.blue() > 200 ? "blue" : ""));
    });
    QObject::connect(&robot_, &RosRobot::motionsListed, [this](const auto& names) { note("has " + names.join(",")); });
    QObject::connect(&robot_, &RosRobot::answered,
                     [this](bool success, const QString& text) { note((success ? "yes, " : "no, ") + text); });
    QObject::connect(&robot_, &RosRobot::hinted, [this](const QString& text) { note("hint, " + text); });
    QObject::connect(&robot_, &RosRobot::driversFound, [this](const auto& drivers) { found_ = drivers; });
    connect("connected");
    QObject::connect(&heartbeat_, &QTimer::timeout,
                     [this] { publisherOf<LinkQuality>("link_quality").publish(link_); });
    heartbeat_.start(500);  // otherwise the driver would be given up
    robot_.useDriver(kTold);
    EXPECT_TRUE(hears("connection connected"));
  }

  void connect(const QString& text, std::uint8_t state = Connection::CONNECTED) {
    Connection connection;
    connection.state = state;
    connection.robot = "ERS-210";
    connection.host = "fe80::7";
    connection.port = 54399;
    connection.protocol_version = 1;
    connection.text = text.toStdString();
    tell("connection", connection);
  }

  // One half is red, the other half is blue.
  static sensor_msgs::CompressedImage picture(std::uint32_t seconds = 5) {
    QImage image(104, 80, QImage::Format_RGB32);
    image.fill(Qt::red);
    QPainter(&image).fillRect(52, 0, 52, 80, Qt::blue);
    QByteArray bytes;
    QBuffer buffer(&bytes);
    EXPECT_TRUE(image.save(&buffer, "JPG", 95));
    sensor_msgs::CompressedImage message;
    message.header.stamp = ros::Time(seconds, 250'000'000);
    message.data.assign(bytes.begin(), bytes.end());
    return message;
  }

  // What is latched waits for a subscriber.
  template <typename Message>
  void tell(const std::string& topic, const Message& message) {
    publisherOf<Message>(topic).publish(message);
  }

  template <typename Message>
  ros::Publisher& publisherOf(const std::string& topic) {
    ros::Publisher& publisher = publishers_[topic];
    if (!publisher) {
      publisher = ros::NodeHandle(kTold).advertise<Message>(topic, 10, true);
    }
    return publisher;
  }

  template <typename Service>
  void serve(const std::string& name, const std::function<QString(const typename Service::Request&)>& describe) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> answer = [=](Request& request, Response& response) {
      const std::lock_guard<std::mutex> lock(mutex_);
      asked_.append(describe(request));
      response.success = may_;
      response.message = may_ ? "well" : "never";
      if constexpr (std::is_same_v<Service, TakePicture>) {
        response.image = may_ ? picture() : response.image;
      } else if constexpr (std::is_same_v<Service, ListMotions>) {
        response.names = {"NOD.MTN", "WAG.MTN"};
        response.names.resize(may_ ? 2 : 0);
      }
      return true;
    };
    services_.push_back(ros::NodeHandle(kTold).advertiseService(name, answer));
  }

  // Tells it again until the driver has heard it, because the driver may not be connected yet.
  template <typename Message>
  typename Message::ConstPtr commands(const std::string& topic, const std::function<void()>& tell) {
    TopicListener<Message> listener(kTold + ("/" + topic));
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          tell();
          return listener.count() > 0;
        },
        kTimeout))
        << topic;
    return listener.count() > 0 ? listener.waitForCount(1).front() : boost::make_shared<Message>();
  }

  void note(const QString& text) {
    if (notes_.isEmpty() || text != notes_.last()) {
      notes_.append(text);
    }
  }

  static QString list(const QMap<QString, double>& values) {
    QString text;
    for (auto value = values.begin(); value != values.end(); ++value) {
      text += QString(" %1=%2").arg(value.key()).arg(value.value());
    }
    return text;
  }

  bool hears(const QString& text) {
    const bool came = QTest::qWaitFor([&] { return notes_.contains(text); }, kTimeout);
    EXPECT_TRUE(came) << text.toStdString() << " is not in\n" << notes_.join("\n").toStdString();
    return came;
  }

  // What the driver's service was asked, and what the window answers.
  void expectAsked(const QString& asked, const QString& answer) {
    EXPECT_TRUE(hears(answer));
    notes_.clear();
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_EQ(asked_, QStringList(asked));
    asked_.clear();
  }

  LinkQuality link_;
  QStringList notes_;
  QStringList found_;  ///< drivers
  std::mutex mutex_;   ///< of what services use, which have a thread of their own
  QStringList asked_;
  bool may_ = true;
  std::map<std::string, ros::Publisher> publishers_;
  std::vector<ros::ServiceServer> services_;
  RosRobot robot_;
  QTimer heartbeat_;
};

TEST_F(ToldTest, TheWindowHearsWhatTheDriverSays) {
  for (int posture = 0; posture <= RobotState::CARRIED; ++posture) {
    RobotState state;
    state.motors = static_cast<std::uint8_t>(posture % 3);
    state.posture = static_cast<std::uint8_t>(posture);
    state.stopped = static_cast<std::uint8_t>(posture % 2);
    state.stopped_by = "/anna_" + std::to_string(posture);
    tell("robot_state", state);
    EXPECT_TRUE(hears(QString("condition %1 %2 ").arg(posture % 3).arg(posture) +
                      (posture % 2 == 1 ? "stopped by " : "") + QString("/anna_%1").arg(posture)));
  }
  link_.pictures_per_second = 12.5F;
  link_.age = 0.25F;
  link_.lost = 0.125F;
  EXPECT_TRUE(hears("link 12.5 0.25 0.125"));
  sensor_msgs::BatteryState battery;
  battery.percentage = 0.75F;
  battery.temperature = 38.5F;
  tell("battery", battery);
  EXPECT_TRUE(hears("battery 0.75 38.5"));
  std_msgs::Bool streams;
  streams.data = 1;
  tell("streaming", streams);
  EXPECT_TRUE(hears("streams"));
  aibo_driver::LedStates leds;
  leds.names = {"face_1", "back", "torn"};
  leds.intensities = {0.25F, 0.75F};
  tell("led_states", leds);
  EXPECT_TRUE(hears("leds back=0.75 face_1=0.25"));
  using State = RobotConnection::State;
  RobotConnection seen;
  QObject::connect(&robot_, &RosRobot::connectionChanged, [&seen](const RobotConnection& now) { seen = now; });
  for (const auto& [told, state] : {std::pair<int, State>(Connection::CONNECTING, State::kConnecting),
                                    {Connection::PLAYBACK, State::kPlayback},
                                    {Connection::DISCONNECTED, State::kDisconnected}}) {
    connect(QString("state %1").arg(told), static_cast<std::uint8_t>(told));
    EXPECT_TRUE(hears(QString("connection state %1").arg(told)));
    EXPECT_EQ(seen.state, state) << told;
    EXPECT_EQ(seen.protocol_version, 1);
    EXPECT_EQ(QStringList({seen.name_space, seen.robot, seen.address}),
              QStringList({kTold, "ERS-210", "[fe80::7]:54399"}));
  }
}

TEST_F(ToldTest, ANewConnectionIsShownBeforeTheNextSearchForDrivers) {
  int changes = 0;
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const auto begin = std::chrono::steady_clock::now();
        const QString text = QString("change %1").arg(++changes);
        connect(text);
        return hears("connection " + text) && std::chrono::steady_clock::now() - begin < std::chrono::seconds(1);
      },
      kTimeout))
      << "a search comes every 2 s";
}

TEST_F(ToldTest, AnotherDriverBeginsWithNothing) {
  RobotState state;
  state.stopped_by = "/anna";
  tell("robot_state", state);
  EXPECT_TRUE(hears("condition 0 0 /anna"));
  std_msgs::Bool streams;
  streams.data = 1;
  tell("streaming", streams);
  EXPECT_TRUE(hears("streams"));
  aibo_driver::LedStates leds;
  leds.names = {"back"};
  leds.intensities = {0.5F};
  tell("led_states", leds);
  EXPECT_TRUE(hears("leds back=0.5"));
  MotionState motion;
  motion.text = "walks";
  tell("motion_state", motion);
  EXPECT_TRUE(hears("walks, plays not"));
  const ros::Publisher other = ros::NodeHandle("/told_too").advertise<Connection>("connection", 1, true);
  Connection paused;
  paused.text = "a playback, paused";
  other.publish(paused);
  EXPECT_TRUE(QTest::qWaitFor([this] { return found_.contains("/told_too"); }, kTimeout)) << "also if it starts later";
  notes_.clear();
  state.stopped_by = "/bert";
  tell("robot_state", state);
  EXPECT_TRUE(TopicListener<RobotState>(std::string(kTold) + "/robot_state").waitFor([](const RobotState& each) {
    return each.stopped_by == "/bert";
  }));
  robot_.useDriver("/told_too");
  // Until the topic is dropped, this thread does not see the message, which waits for it.
  for (int i = 0; i < 3000 && publishers_["robot_state"].getNumSubscribers() > 0; ++i) {
    ros::WallDuration(0.01).sleep();
  }
  EXPECT_EQ(publishers_["robot_state"].getNumSubscribers(), 0U);
  EXPECT_TRUE(hears("connection waiting for the driver in /told_too"));
  EXPECT_TRUE(hears("connection a playback, paused")) << "it says nothing else";
  notes_ = notes_.filter(QRegularExpression("^(?!link)"));
  EXPECT_EQ(notes_, QStringList({"connection waiting for the driver in /told_too", "condition 0 0 ", "streams not",
                                 ", plays not", "leds", "connection a playback, paused"}));
}

TEST_F(ToldTest, ADriverThatFallsSilentStaysThoughThereIsAnother) {
  const ros::Publisher other = ros::NodeHandle("/told_next").advertise<Connection>("connection", 1, true);
  other.publish(Connection());
  EXPECT_TRUE(QTest::qWaitFor([this] { return found_.contains("/told_next"); }, kTimeout));
  robot_.useDriver("");
  heartbeat_.stop();
  EXPECT_TRUE(hears("connection the driver in /told does not answer: is it running?"));
  robot_.stop();
  EXPECT_TRUE(hears("no, stop: no answer from the service /told/stop: are the driver and the ROS master running?"));
  connect("it speaks again");
  EXPECT_TRUE(hears("connection it speaks again"));
}

TEST_F(ToldTest, AMovementThatFailsIsAComplaintOfTheWindowThatWantedIt) {
  MotionState state;
  state.text = "walks";
  const auto end = [&state](const std::string& source, const std::string& reason,
                            std::uint8_t how = EndedMovement::FELL) {
    EndedMovement& ended = state.ended.emplace_back();
    ended.movement.kind = Movement::WALK;
    ended.movement.source = source;
    ended.how = how;
    ended.reason = reason;
  };
  end(ros::this_node::getName(), "before");
  tell("motion_state", state);
  EXPECT_TRUE(hears("walks, plays not"));
  end("/anna", "of anna");
  end(ros::this_node::getName(), "", EndedMovement::DONE);
  end(ros::this_node::getName(), "it fell");
  end(ros::this_node::getName(), "the floor ends ahead", EndedMovement::REFUSED);
  state.movements.resize(2);
  state.movements[1].kind = Movement::MOTION;
  tell("motion_state", state);
  EXPECT_TRUE(hears("walks, plays"));
  EXPECT_TRUE(hears("no, walk: it fell"));
  EXPECT_TRUE(hears("hint, walk: the floor ends ahead")) << "a robot that refuses is not broken";
  EXPECT_EQ(notes_.filter("no, ").size(), 1) << notes_.join("; ").toStdString();

  robot_.useDriver("/told_too");
  EXPECT_TRUE(hears("connection waiting for the driver in /told_too"));
  notes_.clear();
  robot_.useDriver(kTold);
  EXPECT_TRUE(hears("walks, plays"));
  end(ros::this_node::getName(), "it fell again");
  tell("motion_state", state);
  EXPECT_TRUE(hears("no, walk: it fell again"));
  EXPECT_EQ(notes_.filter("no, ").size(), 1) << "the first one was told before: " << notes_.join("; ").toStdString();
}

TEST_F(ToldTest, TheFirstMovementOfADriverThatFailsIsAComplaint) {
  MotionState state;
  state.text = "rests";
  tell("motion_state", state);
  EXPECT_TRUE(hears("rests, plays not"));
  EndedMovement& ended = state.ended.emplace_back();
  ended.movement.kind = Movement::WALK;
  ended.movement.source = ros::this_node::getName();
  ended.how = EndedMovement::FELL;
  ended.reason = "it fell";
  tell("motion_state", state);
  EXPECT_TRUE(hears("no, walk: it fell"));
}

TEST_F(ToldTest, TheWindowHearsOfSensorsAndPicturesWhileSomebodyLooks) {
  const auto show = [this](bool looks) {
    for (const Part part : {Part::kSensors, Part::kJoints, Part::kMicrophones, Part::kPictures}) {
      robot_.show(part, looks);
    }
  };
  // If roscpp advertises a topic in one thread while another one subscribes to it, it may link the two twice.
  publisherOf<aibo_driver::Sound>("microphone");
  publisherOf<Touch>("touch");
  for (const char* name : {"near", "far", "chest", "head"}) {
    publisherOf<sensor_msgs::Range>(std::string("range/") + name);
  }
  publisherOf<sensor_msgs::JointState>("joint_states");
  publisherOf<sensor_msgs::CompressedImage>("camera/image_raw/compressed");
  robot_.show(Part::kMicrophones, true);  // alone
  const auto sound = [this](std::int16_t sample) {
    aibo_driver::Sound heard;
    heard.samples.assign(1000, sample);
    tell("microphone", heard);
  };
  sound(16384);
  EXPECT_TRUE(hears("level -6"));
  show(true);
  const std::pair<const char*, std::uint8_t Touch::*> places[] = {{"paw_left_front", &Touch::paw_left_front},
                                                                  {"paw_left_hind", &Touch::paw_left_hind},
                                                                  {"paw_right_front", &Touch::paw_right_front},
                                                                  {"paw_right_hind", &Touch::paw_right_hind},
                                                                  {"chin", &Touch::chin},
                                                                  {"head", &Touch::head},
                                                                  {"back_front", &Touch::back_front},
                                                                  {"back_middle", &Touch::back_middle},
                                                                  {"back_rear", &Touch::back_rear}};
  for (const auto& [name, place] : places) {
    Touch touch;
    touch.*place = 1;
    tell("touch", touch);
    EXPECT_TRUE(hears(QString("touched ") + name));
  }
  Touch tap;
  tap.chin = tap.head = 1;
  tell("touch", tap);
  tell("touch", Touch());
  EXPECT_TRUE(hears("touched chin,head")) << "however short it is";
  EXPECT_TRUE(hears("touched "));
  sensor_msgs::Range range;
  for (const char* name : {"near", "far", "chest", "head"}) {
    range.range += 0.25F;
    range.max_range += 1.5F;
    tell(std::string("range/") + name, range);
    EXPECT_TRUE(hears(QString("%1 %2 %3").arg(name).arg(range.range).arg(range.max_range)));
  }
  sensor_msgs::JointState joints;
  joints.name = {"mouth", "torn"};
  joints.position = {-0.25};
  tell("joint_states", joints);
  EXPECT_TRUE(hears("joints mouth=-0.25"));
  joints.name = {"head_pan"};
  joints.position = {0.5};
  tell("joint_states", joints);
  joints.name = {"tail_pan"};
  tell("joint_states", joints);
  EXPECT_TRUE(hears("joints head_pan=0.5 mouth=-0.25 tail_pan=0.5"))
      << "a robot of version 1 measures one after the other";
  joints.name.clear();
  for (int i = 0; i < 100; ++i) {
    joints.name.push_back("made_up_" + std::to_string(i));
  }
  joints.position.assign(100, 0);
  tell("joint_states", joints);
  joints.name = {"mouth"};
  tell("joint_states", joints);
  EXPECT_TRUE(hears("joints mouth=0")) << "not all joints that somebody has made up";
  sensor_msgs::CompressedImage damaged;
  damaged.data = {0xFF, 0xD8};
  tell("camera/image_raw/compressed", damaged);
  const sensor_msgs::CompressedImage good = picture();
  for (int i = 0; i < 20; ++i) {  // meanwhile, the window does something else
    tell("camera/image_raw/compressed", good);
    QThread::msleep(2);
  }
  EXPECT_TRUE(hears("picture 104x80 red blue"));
  sound(8192);
  EXPECT_TRUE(hears("level -12"));
  EXPECT_EQ(notes_.filter("picture").size(), notes_.count("picture 104x80 red blue"))
      << "none is empty: " << notes_.join("; ").toStdString();
  EXPECT_EQ(notes_.filter("level").size(), 2) << "silence is not heard";
  EXPECT_EQ(notes_.count("joints mouth=0"), 1) << "they have not been measured again";
  publisherOf<sensor_msgs::CameraInfo>("camera/camera_info");
  const auto is_heard = [this](std::uint32_t listeners) {
    for (const char* topic : {"touch", "range/near", "range/far", "range/chest", "range/head", "joint_states",
                              "microphone", "camera/image_raw/compressed", "camera/camera_info"}) {
      EXPECT_TRUE(QTest::qWaitFor([&] { return publishers_[topic].getNumSubscribers() == listeners; }, kTimeout))
          << topic;
    }
  };
  is_heard(1);
  show(false);
  is_heard(0);
  show(true);
  is_heard(1);
}

TEST_F(ToldTest, TheDriverHearsWhatTheWindowWants) {
  const auto leds = commands<aibo_driver::Leds>("leds", [this] { robot_.setLeds({"face_1", "back"}, 0.25); });
  EXPECT_THAT(leds->names, ElementsAre("face_1", "back"));
  EXPECT_THAT(leds->intensities, ElementsAre(0.25F));
  const auto ears = commands<aibo_driver::Ears>("ears", [this] { robot_.flickEars(false, true); });
  EXPECT_TRUE(!ears->left && ears->right);
  const auto twist = commands<geometry_msgs::Twist>("cmd_vel", [this] { robot_.walk(0.1, 0.2, -0.3); });
  EXPECT_EQ(twist->linear.x, 0.1);
  EXPECT_EQ(twist->linear.y, 0.2);
  EXPECT_EQ(twist->angular.z, -0.3);
  const auto joints = commands<sensor_msgs::JointState>("joint_command", [this] {
    robot_.moveJoints({{"head_pan", 0.5}, {"mouth", -0.25}, {"tail_pan", 0.75}});
  });
  EXPECT_THAT(joints->name, ElementsAre("head_pan", "mouth", "tail_pan"));
  EXPECT_THAT(joints->position, ElementsAre(0.5, -0.25, 0.75));
  EXPECT_THAT(joints->velocity, ::testing::IsEmpty()) << "as fast as the driver allows";
  EXPECT_FALSE(joints->header.stamp.isZero());
  EXPECT_EQ(notes_.filter("no, ").size(), 0) << notes_.join("; ").toStdString();

  connect("the robot is off", Connection::DISCONNECTED);
  EXPECT_TRUE(hears("connection the robot is off"));
  robot_.setLeds({"back"}, 1);
  EXPECT_TRUE(hears("no, LEDs: the robot is off"));
  robot_.walk(0.1, 0, 0);
  EXPECT_TRUE(hears("no, walk: the robot is off"));
  robot_.lookAt({0.5, 0.5});
  EXPECT_TRUE(hears("no, look there: the robot is off"));
  const auto end = commands<geometry_msgs::Twist>("cmd_vel", [this] { robot_.walk(0, 0, 0); });
  EXPECT_EQ(end->linear.x, 0) << "the end of a walk is always sent";
}

TEST_F(ToldTest, ServicesGetWhatTheWindowWantsAndTheirAnswersAreToldInItsWords) {
  using aibo_driver::PlayMotion;
  const auto switch_to = [](const char* name) {
    return [name](const std_srvs::SetBool::Request& request) { return name + QString(request.data ? " on" : " off"); };
  };
  serve<std_srvs::Trigger>("rest", [](const auto&) { return QString("rest"); });
  serve<std_srvs::SetBool>("motors", switch_to("motors"));
  serve<std_srvs::SetBool>("set_streaming", switch_to("stream"));
  serve<aibo_driver::Say>("say", [](const auto& request) { return "say " + QString::fromStdString(request.text); });
  serve<aibo_driver::PlaySound>("play_sound", [](const auto& request) { return QString(request.stop ? "hush" : "?"); });
  serve<PlayMotion>("play_motion", [](const PlayMotion::Request& request) {
    return QString("%1 %2").arg(request.name.c_str()).arg(request.repetitions);
  });
  serve<aibo_driver::StopMotion>("stop_motion",
                                 [](const auto& request) { return "end " + QString(request.name.c_str()); });
  robot_.takePosture("rest");
  expectAsked("rest", "yes, rest: well");
  robot_.setMotors(true);
  expectAsked("motors on", "yes, motors on: well");
  robot_.setStreaming(true);
  expectAsked("stream on", "yes, stream on: well");
  robot_.say("Good dog");
  expectAsked("say Good dog", "yes, say: well");
  robot_.stopSound();
  expectAsked("hush", "yes, stop sound: well");
  robot_.playMotion("NOD.MTN", 3);
  expectAsked("NOD.MTN 3", "yes, play NOD.MTN: well");
  robot_.stopMotions();
  expectAsked("end ", "yes, stop motions: well");
  may_ = false;
  robot_.setMotors(false);
  expectAsked("motors off", "no, motors off: never");
  {
    const std::lock_guard<std::mutex> driver_is_busy(mutex_);
    robot_.takePosture("rest");
    robot_.takePosture("rest");
    EXPECT_TRUE(hears("no, rest: the last call has not been answered yet"));
  }
  expectAsked("rest", "no, rest: never");
}

TEST(RemoteControlRos, BeforeADriverIsFoundEachWishIsAnsweredWithThat) {
  RosRobot robot;
  QStringList answers;
  QObject::connect(&robot, &RosRobot::answered, [&answers](bool success, const QString& text) {
    EXPECT_FALSE(success) << text.toStdString();
    answers.append(text);
  });
  robot.stop();
  robot.setLeds({"back"}, 1);
  robot.walk(0, 0, 0);
  EXPECT_TRUE(QTest::qWaitFor([&answers] { return answers.size() == 2; }, kTimeout));
  EXPECT_EQ(answers, QStringList({"stop: no driver has been found yet", "LEDs: no driver has been found yet"}));
}

TEST_F(ToldTest, SettingsAreThoseOfTheNodeThatDrives) {
  using dynamic_reconfigure::Config;
  using dynamic_reconfigure::Reconfigure;
  int descriptions = 0;
  QObject::connect(&robot_, &RosRobot::settingsDescribed, [&](const auto& settings) {
    ++descriptions;
    EXPECT_LE(settings.size(), 1);
    note("describes " + settings.value(0).name);
  });
  QObject::connect(&robot_, &RosRobot::settingsChanged, [this](const auto& values) {
    note("set " + QStringList(values.keys()).join(",") + " " + values.value("gain").toString());
  });
  const auto config = [](int gain) {
    Config values;
    values.ints.resize(2);
    values.ints[0].name = "balance";
    values.ints[1].name = "gain";
    values.ints[1].value = gain;
    return values;
  };
  dynamic_reconfigure::ConfigDescription description;
  description.groups.resize(1);
  description.groups[0].parameters.resize(1);
  description.groups[0].parameters[0].name = "gain";
  description.groups[0].parameters[0].type = "int";
  description.min = config(1);
  description.max = config(9);
  description.dflt = config(4);
  ros::NodeHandle(kTold).setParam("driver/telemetry_rate", 31.25);  // only a driver has this setting
  tell("driver/parameter_descriptions", description);
  tell("driver/parameter_updates", config(5));
  EXPECT_TRUE(hears("describes gain"));
  EXPECT_TRUE(hears("set balance,gain 5"));
  robot_.show(Part::kSensors, true);
  tell("touch", Touch());
  EXPECT_TRUE(hears("touched "));
  const boost::function<bool(Reconfigure::Request&, Reconfigure::Response&)> answer = [&](auto& asked, auto& response) {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_EQ(asked.config.ints.size(), 1U);
    response.config = config(asked.config.ints.at(0).value - 1);
    return true;
  };
  services_.push_back(ros::NodeHandle(kTold).advertiseService("driver/set_parameters", answer));
  robot_.changeSetting("gain", 9);
  EXPECT_TRUE(hears("set balance,gain 8")) << "the driver's word counts";
  EXPECT_TRUE(hears("yes, gain is 8"));
  EXPECT_EQ(descriptions, 1) << "a form that is made again loses what the user writes";
  ros::NodeHandle(kTold).deleteParam("driver/telemetry_rate");
  ros::NodeHandle(kTold).setParam("nodelet/telemetry_rate", 31.25);
  tell("nodelet/parameter_updates", config(3));
  EXPECT_TRUE(hears("set balance,gain 3")) << "the driver has come back under another name";
  services_.push_back(ros::NodeHandle(kTold).advertiseService("nodelet/set_parameters", answer));
  serve<ListMotions>("list_motions", [](const auto&) { return QString(); });
  {
    const std::lock_guard<std::mutex> driver_is_busy(mutex_);
    robot_.listMotions();
    robot_.changeSetting("gain", 7);
    robot_.useDriver("/told_too");
    EXPECT_TRUE(hears("describes "));
    EXPECT_TRUE(hears("set  "));
    notes_.clear();
  }
  EXPECT_TRUE(hears("yes, gain is 6"));
  EXPECT_EQ(notes_.filter("set "), QStringList()) << "these are not the settings of the driver in use";
  EXPECT_EQ(notes_.filter("has "), QStringList()) << "nor its motions";
}

TEST_F(ToldTest, AFailureBringsNoPictureAndLeavesTheListOfMotions) {
  const TemporaryFolder folder;
  const QDateTime begin = QDateTime::currentDateTime();
  const auto ask = [&] {
    robot_.takePicture(QString::fromStdString(folder.path().string()));
    robot_.listMotions();
  };
  int taken = 0;
  QObject::connect(&robot_, &RosRobot::pictureTaken, [&](const QImage& image) {
    ++taken;
    note(QString("taken %1").arg(image.width()));
  });
  serve<TakePicture>("take_picture", [](const auto&) { return QString(); });
  serve<ListMotions>("list_motions", [](const auto&) { return QString(); });
  may_ = false;
  ask();
  EXPECT_TRUE(hears("no, take picture: never"));
  EXPECT_TRUE(hears("no, list motions: never"));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    may_ = true;
  }
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        ask();  // again, because the first calls may not be quite over
        return taken >= 3 && notes_.contains("taken 104") && notes_.contains("has NOD.MTN,WAG.MTN");
      },
      kTimeout));
  const QStringList files = QDir(QString::fromStdString(folder.path().string())).entryList(QDir::Files);
  EXPECT_GE(files.size(), taken) << "each has a file of its own";
  for (const QString& file : files) {
    const QDateTime time = QDateTime::fromString(file, "'aibo_'yyyy-MM-dd_HH-mm-ss.zzz'.jpg'");
    EXPECT_TRUE(begin <= time && time <= QDateTime::currentDateTime()) << file.toStdString();
  }
  EXPECT_FALSE(notes_.contains("taken 0")) << "an empty file";
  EXPECT_FALSE(notes_.contains("has "));
}

TEST_F(ToldTest, AClickIsAPointInFrontOfTheCameraAndOnlyItsOwnResultIsTold) {
  robot_.lookAt({0.5, 0.5});
  EXPECT_TRUE(hears("no, look there: nothing is known of the camera yet"));
  robot_.show(Part::kPictures, true);
  sensor_msgs::CameraInfo camera;
  tell("camera/camera_info", camera);  // not calibrated
  EXPECT_TRUE(QTest::qWaitFor([&] { return publishers_["camera/camera_info"].getNumSubscribers() > 0; }, kTimeout));
  tell("camera/image_raw/compressed", picture());
  EXPECT_TRUE(hears("picture 104x80 red blue"));
  notes_.clear();
  robot_.lookAt({0.5, 0.5});
  EXPECT_TRUE(hears("no, look there: nothing is known of the camera yet"));
  camera.header.frame_id = "eye";
  camera.width = 208;
  camera.height = 160;
  camera.K = {200, 0, 98, 0, 100, 85, 0, 0, 1};  // the lens is not quite in the middle
  tell("camera/camera_info", camera);
  tell("camera/image_raw/compressed", picture());
  EXPECT_TRUE(hears("picture 104x80 red blue"));
  const auto point = commands<geometry_msgs::PointStamped>("look_at", [this] { robot_.lookAt({0.75, 0.25}); });
  EXPECT_EQ(point->header.frame_id, "eye");
  EXPECT_DOUBLE_EQ(point->point.x, 0.29);
  EXPECT_DOUBLE_EQ(point->point.y, -0.45);
  EXPECT_DOUBLE_EQ(point->point.z, 1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return publishers_["camera/camera_info"].getNumSubscribers() == 0; }, kTimeout))
      << "it is needed only once";
  EXPECT_EQ(point->header.stamp, picture().header.stamp) << "where the camera was then";
  LookAtResult result;
  const auto answer = [&](const std_msgs::Header& header, const std::string& message, bool success = true) {
    result.header = header;
    result.message = message;
    result.success = static_cast<std::uint8_t>(success);
    tell("look_at_result", result);
  };
  std_msgs::Header stranger = point->header;
  stranger.frame_id = "base_link";
  answer(stranger, "no point of this window");
  stranger = point->header;
  stranger.stamp = ros::Time(5);
  answer(stranger, "nor this one");
  answer(point->header, "the head turns");
  EXPECT_TRUE(hears("yes, look there: the head turns"));
  EXPECT_EQ(notes_.filter("yes, ").size(), 1) << notes_.join("; ").toStdString();
  notes_.clear();
  tell("camera/image_raw/compressed", picture(6));
  EXPECT_TRUE(hears("picture 104x80 red blue"));
  sensor_msgs::CompressedImage damaged = picture(7);
  damaged.data.resize(100);
  tell("camera/image_raw/compressed", damaged);
  tell("streaming", std_msgs::Bool());
  EXPECT_TRUE(hears("streams not")) << "the damaged picture has come, too";
  const auto next = commands<geometry_msgs::PointStamped>("look_at", [this] { robot_.lookAt({0.25, 0.75}); });
  EXPECT_DOUBLE_EQ(next->point.x, -0.23);
  EXPECT_DOUBLE_EQ(next->point.y, 0.35);
  EXPECT_EQ(next->header.stamp, picture(6).header.stamp)
      << "where the camera was when it took the picture that is shown";
  answer(point->header, "an answer to the first click");
  answer(next->header, "out of reach", false);
  EXPECT_TRUE(hears("no, look there: out of reach"));
  EXPECT_EQ(notes_.filter("yes, "), QStringList());
}

TEST(RemoteControlCalls, EndWithTheWindowEvenIfNobodyAnswers) {
  using std_srvs::Trigger;
  std::promise<void> asked;
  std::promise<void> may_answer;
  std::promise<bool> answered;
  const boost::function<bool(Trigger::Request&, Trigger::Response&)> answer = [&](auto&, auto&) {
    asked.set_value();
    answered.set_value(may_answer.get_future().wait_for(kSafetyNet) == std::future_status::ready);
    return true;
  };
  const ros::ServiceServer server = ros::NodeHandle().advertiseService("/hangs", answer);
  {
    aibo_driver::remote_control::ServiceCalls calls;
    calls.start<Trigger>("/hangs", {}, [](const Trigger::Response*) { ADD_FAILURE() << "the window is gone"; });
    ASSERT_EQ(asked.get_future().wait_for(kSafetyNet), std::future_status::ready);
  }
  may_answer.set_value();
  EXPECT_TRUE(answered.get_future().get()) << "the window waited for an answer";
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
  EXPECT_THAT(program.output(), ::testing::HasSubstr("there is no display for its window (DISPLAY is not set)"));
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
  EXPECT_GT(window.width(), screen.width() / 2);
  EXPECT_TRUE(panel->layout()->contentsMargins().isNull()) << "rviz has a margin of its own";
  window.setGeometry(40, 30, 300, 200);
  panel->initialize(nullptr);
  QCoreApplication::processEvents();
  EXPECT_EQ(window.geometry(), QRect(40, 30, 300, 200)) << "it fits already";
  const auto is_kept = [&](const QString& driver, const QString& folder) {
    rviz::Config config;
    panel->save(config);
    QString values[3];
    EXPECT_TRUE(config.mapGetString("Driver", &values[0]) && config.mapGetString("Picture Folder", &values[1]));
    EXPECT_TRUE(config.mapGetString("Class", &values[2])) << "rviz makes the panel again from it";
    EXPECT_EQ(values[2], "aibo_driver/RemoteControl");
    return values[0] == driver && values[1] == folder &&
           panel->findChild<QWidget*>("folder")->toolTip().contains("saved in " + folder + ".");
  };
  EXPECT_FALSE(is_kept("/left", "/pictures"));
  rviz::Config config;
  panel->load(config);
  EXPECT_FALSE(is_kept("/left", "/pictures"));
  config.mapSetValue("Driver", "/left");
  config.mapSetValue("Picture Folder", "/pictures");
  panel->load(config);
  EXPECT_TRUE(is_kept("/left", "/pictures"));
  int changes = 0;
  QObject::connect(panel, &rviz::Panel::configChanged, [&changes] { ++changes; });
  auto* chooser = panel->findChild<QComboBox*>("driver");
  chooser->addItem("/right");
  Q_EMIT chooser->activated(chooser->findText("/right"));
  EXPECT_EQ(changes, 1) << "rviz asks whether to save it";
  EXPECT_TRUE(is_kept("/right", "/pictures"));
}

}  // namespace

int main(int argc, char** argv) {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  const QByteArray real_master = qgetenv("ROS_MASTER_URI");
  FaultProxy proxy(QUrl(real_master).port());
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
