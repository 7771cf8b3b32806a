// aibo_remote_control: the panel of rviz as a window of its own.

#include <ros/init.h>
#include <ros/this_node.h>
#include <signal.h>

#include <QApplication>
#include <QScreen>
#include <QTimer>

#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"

int main(int argc, char** argv) {
  using namespace aibo_driver::remote_control;
  constexpr int kLookForCtrlC = 100;  // ms
  ros::init(argc, argv, "aibo_remote_control", ros::init_options::AnonymousName);
  QApplication application(argc, argv);
  RosRobot robot;
  RemoteControl window(robot);
  window.setWindowTitle("Aibo");
  window.resize(QSize(480, 780).boundedTo(QGuiApplication::primaryScreen()->availableSize()));
  const QString name_space = QString::fromStdString(ros::this_node::getNamespace());
  window.useDriver(name_space == "/" ? QString() : name_space);
  window.show();
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, &application, [&application] {
    if (ros::isShuttingDown()) {
      application.quit();
    }
  });
  timer.start(kLookForCtrlC);
  return QApplication::exec();
}
