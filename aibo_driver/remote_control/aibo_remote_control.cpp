// aibo_remote_control: the panel of rviz as a window of its own.

#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <signal.h>

#include <QApplication>
#include <QLabel>
#include <QMainWindow>
#include <QScreen>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "node/node.h"
#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"

namespace {

/// Without a display, Qt explains its plugins at length and aborts the process.
void endWithoutDisplay(QtMsgType type, const QMessageLogContext& /*context*/, const QString& text) {
  if (type != QtFatalMsg) {
    return;
  }
  const QString display = qEnvironmentVariable("DISPLAY");
  std::fprintf(stderr,
               "aibo_remote_control: there is no display for its window (DISPLAY is %s). Start it on a computer with a "
               "screen, or with ssh -X. Qt says: %s\n",
               display.isEmpty() ? "not set" : qPrintable("'" + display + "'"), qPrintable(text.section('\n', 0, 0)));
  std::fflush(stderr);
  std::_Exit(EXIT_FAILURE);
}

/// Shows the window until it is closed, or until Ctrl-C.
/// @return the exit status
int showWindow(QApplication* application) {
  using namespace aibo_driver::remote_control;
  constexpr int kLookForCtrlC = 100;  // ms
  constexpr int kQuickStart = 500;    // ms
  std::unique_ptr<RosRobot> robot;
  QMainWindow window;  // ends before the robot
  window.setWindowTitle("Aibo");
  window.resize(QSize(480, 780).boundedTo(QGuiApplication::primaryScreen()->availableSize()));
  auto* waiting = new QLabel("The ROS master at " + QString::fromStdString(ros::master::getURI()) +
                             " does not answer: is roscore running? This window waits for it.");
  waiting->setTextFormat(Qt::PlainText);
  waiting->setMargin(20);
  waiting->setWordWrap(true);
  waiting->setAlignment(Qt::AlignCenter);
  window.setCentralWidget(waiting);
  QTimer::singleShot(kQuickStart, &window, &QWidget::show);
  // ros::start() returns when the master has answered. Nothing can interrupt it if the master hangs.
  std::thread([application, &robot, &window] {
    ros::start();
    const auto use_ros = [&robot, &window] {
      if (!ros::ok()) {
        return;
      }
      robot = std::make_unique<RosRobot>();
      auto* control = new RemoteControl(*robot);
      const QString name_space = QString::fromStdString(ros::this_node::getNamespace());
      control->useDriver(name_space == "/" ? QString() : name_space);
      window.setCentralWidget(control);
      window.show();
    };
    QMetaObject::invokeMethod(application, use_ros);
  }).detach();
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, application, [application] {
    if (ros::isShuttingDown()) {
      application->quit();
    }
  });
  timer.start(kLookForCtrlC);
  const int status = QApplication::exec();
  if (!robot) {
    std::_Exit(status);  // the thread may still wait
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_remote_control", ros::init_options::AnonymousName);
  const QtMessageHandler usual_handler = qInstallMessageHandler(endWithoutDisplay);
  QApplication application(argc, argv);
  qInstallMessageHandler(usual_handler);
  const int status = showWindow(&application);
  ros::shutdown();  // also waits until that of Ctrl-C has ended
  return status;
}
