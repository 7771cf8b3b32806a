// aibo_remote_control: the panel of rviz as a window of its own.

#include <ros/init.h>
#include <ros/this_node.h>

#include <QApplication>
#include <QMainWindow>
#include <QScreen>
#include <QTimer>
#include <cstdio>
#include <cstdlib>

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
  RosRobot robot;
  QMainWindow window;
  window.setWindowTitle("Aibo");
  window.resize(QSize(480, 780).boundedTo(QGuiApplication::primaryScreen()->availableSize()));
  auto* control = new RemoteControl(robot);
  const QString name_space = QString::fromStdString(ros::this_node::getNamespace());
  control->useDriver(name_space == "/" ? QString() : name_space);
  window.setCentralWidget(control);
  window.show();
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, application, [] {
    if (ros::isShuttingDown()) {
      QApplication::quit();
    }
  });
  constexpr int kLookForCtrlC = 100;  // ms
  timer.start(kLookForCtrlC);
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::node::init(argc, argv, "aibo_remote_control", ros::init_options::AnonymousName);
  const QtMessageHandler usual_handler = qInstallMessageHandler(endWithoutDisplay);
  QApplication application(argc, argv);
  qInstallMessageHandler(usual_handler);
  const int status = showWindow(&application);
  ros::shutdown();  // also waits until a shutdown by Ctrl-C has ended
  return status;
}
