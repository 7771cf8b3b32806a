/// @file robot.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ROBOT_H
#define AIBO_DRIVER_REMOTE_CONTROL_ROBOT_H

#include <QImage>
#include <QMap>
#include <QObject>
#include <QPair>
#include <QPointF>
#include <QString>
#include <QStringList>
#include <QVariant>
#include <QVector>
#include <limits>

namespace aibo_driver::remote_control {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// rad/s, where a speed has to be given; the driver limits it.
constexpr double kAnySpeed = 20;

/// The way from this window to the robot.
struct RobotConnection {
  enum class State {
    kNoMaster,      ///< the ROS master does not answer, and no driver is heard
    kNoDriver,      ///< no driver is heard in the namespace
    kDisconnected,  ///< the driver has no connection to the robot
    kConnecting,
    kConnected
  };

  State state = State::kNoDriver;
  QString name_space;        ///< such as "/aibo"; empty: none is chosen and none was found
  QString robot;             ///< its design, such as "ERS-7"; empty while unknown
  QString address;           ///< host:port; empty while unknown
  int protocol_version = 0;  ///< 0 while not connected
  QString text;              ///< all of it in one line, for people

  bool hasDriver() const { return state != State::kNoMaster && state != State::kNoDriver; }
  bool isConnected() const { return state == State::kConnected; }
};

/// What the robot can do now, as far as the driver says.
struct RobotCondition {
  enum class Motors { kNotKnown, kOff, kOn };
  enum class Posture { kNotKnown, kStanding, kSitting, kLying, kWalking, kFallen, kCarried };

  Motors motors = Motors::kNotKnown;
  Posture posture = Posture::kNotKnown;
  bool is_stopped = false;  ///< nothing moves it until it is released
  QString stopped_by;       ///< the node that called stop
};

/// How well pictures come; NaN where unknown.
struct LinkFigures {
  double pictures_per_second = kUnknown;
  double age = kUnknown;   ///< s
  double lost = kUnknown;  ///< 0..1
};

/// A setting of the driver that can be changed while it runs.
struct Setting {
  enum class Kind { kSwitch, kInteger, kNumber, kChoice };

  QString name;  ///< of the parameter
  QString description;
  Kind kind = Kind::kInteger;
  double lowest = 0;
  double highest = 0;
  QVector<QPair<QString, QVariant>> choices;  ///< text and value
};

/// What a range finder measures.
struct Distance {
  QString name;         ///< near, far or chest
  double metres = 0;    ///< may be infinite: nothing is within reach, or all is nearer than it can measure
  double farthest = 1;  ///< m, that it can measure
};

/// What the robot tells only while somebody looks at it, to save processor time.
enum class Part { kPictures, kJoints, kSensors };

using JointPositions = QMap<QString, double>;  ///< rad, by name
using SettingValues = QMap<QString, QVariant>;
using LedIntensities = QMap<QString, double>;  ///< 0..1, by name of the LED

/// The robot, as the window sees it: what is known of it comes as signals, and what somebody wants of it are functions.
///
/// No function waits. What a function asked for shows in the signals, and the answer of a service in answered(). All
/// signals come on the thread of the object, which is the window's. A wish that cannot be fulfilled, for example
/// because there is no connection, is answered as well.
class Robot : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Uses the driver in this namespace from now on.
  /// @param name_space such as "/aibo"; empty: the first one that is found
  virtual void useDriver(const QString& name_space) = 0;

  /// Whether somebody looks at a part; at first at none.
  virtual void show(Part part, bool visible) = 0;

  /// Holds everything that moves, at once and until release(). Waits for no other call.
  virtual void stop() = 0;

  /// Lets the robot move again after a stop.
  virtual void release() = 0;

  /// @param folder on this machine in which the picture is saved
  virtual void takePicture(const QString& folder) = 0;
  virtual void setStreaming(bool on) = 0;
  virtual void setMotors(bool on) = 0;

  /// @param posture stand, sit or rest
  virtual void takePosture(const QString& posture) = 0;
  virtual void listMotions() = 0;

  /// @param repetitions 1 or more
  virtual void playMotion(const QString& name, int repetitions) = 0;

  /// Stops all motions that are played.
  virtual void stopMotions() = 0;
  virtual void changeSetting(const QString& name, const QVariant& value) = 0;

  /// @param names LEDs or groups
  /// @param intensity 0..1
  virtual void setLeds(const QStringList& names, double intensity) = 0;
  virtual void flickEars(bool left, bool right) = 0;
  virtual void moveJoints(const JointPositions& positions) = 0;

  /// To be repeated several times a second; the robot stops soon after the last one.
  /// @param forward m/s
  /// @param left m/s
  /// @param turn rad/s, counterclockwise
  virtual void walk(double forward, double left, double turn) = 0;

  /// Turns the head so that this place of the newest picture gets into its middle.
  /// @param place 0..1 from left to right, and from top to bottom
  virtual void lookAt(const QPointF& place) = 0;

 Q_SIGNALS:
  void driversFound(const QStringList& name_spaces);
  void connectionChanged(const aibo_driver::remote_control::RobotConnection& connection);
  void conditionChanged(const aibo_driver::remote_control::RobotCondition& condition);
  void linkMeasured(const aibo_driver::remote_control::LinkFigures& figures);

  /// @param charge 0..1
  /// @param temperature degrees Celsius
  void batteryMeasured(double charge, double temperature);
  void pictureArrived(const QImage& picture);
  void streamingChanged(bool on);

  /// @param path of the file in which it was saved
  void pictureTaken(const QImage& picture, const QString& path);

  /// @param text what moves the robot, in a line
  /// @param motion_plays whether one of them is a motion
  void movementChanged(const QString& text, bool motion_plays);
  void motionsListed(const QStringList& names);
  void settingsDescribed(const QVector<aibo_driver::remote_control::Setting>& settings);

  /// All that are in force.
  void settingsChanged(const aibo_driver::remote_control::SettingValues& values);
  void jointsMeasured(const aibo_driver::remote_control::JointPositions& positions);

  /// What is touched now, in words of aibo_driver/Touch.
  void touched(const QStringList& places);
  void distanceMeasured(const aibo_driver::remote_control::Distance& distance);
  void ledsChanged(const aibo_driver::remote_control::LedIntensities& intensities);

  /// A call has ended, or was refused, or something that this window moves did not arrive.
  /// @param text what was asked and what came of it
  void answered(bool success, const QString& text);
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ROBOT_H
