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
#include <set>

namespace aibo_driver::remote_control {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// In rad/s: a speed for commands that must have one. The driver limits it.
constexpr double kAnySpeed = 20;

/// The connection from this window to the robot.
struct RobotConnection {
  enum class State {
    kNoMaster,      ///< the ROS master does not answer, and no driver is heard
    kNoDriver,      ///< no driver is heard in the namespace
    kWaiting,       ///< the namespace is new, and nothing has been heard from its driver yet
    kDisconnected,  ///< the driver has no connection to the robot
    kConnecting,
    kConnected,
    kPlayback  ///< a recording is played, and nobody obeys
  };

  State state = State::kNoDriver;
  QString name_space;          ///< such as "/aibo"; empty if none was chosen and none was found
  QString robot;               ///< the robot's design, such as "ERS-7"; empty while unknown
  QString address;             ///< host:port; empty while unknown
  int protocol_version = 0;    ///< 0 while not connected
  bool master_answers = true;  ///< without the ROS master, programs cannot find each other
  QString text;                ///< all of this in one line, for people

  bool hasDriver() const { return state != State::kNoMaster && state != State::kNoDriver && state != State::kWaiting; }
  bool isConnected() const { return state == State::kConnected; }
  bool isPlayback() const { return state == State::kPlayback; }

  /// True if the messages are about a robot, now or when they were recorded.
  bool hasRobot() const { return isConnected() || isPlayback(); }
};

/// What the robot can do now, as far as the driver reports it.
struct RobotCondition {
  enum class Motors { kNotKnown, kOff, kOn };
  enum class Posture { kNotKnown, kStanding, kSitting, kLying, kWalking, kFallen, kCarried };

  Motors motors = Motors::kNotKnown;
  Posture posture = Posture::kNotKnown;
  bool is_stopped = false;  ///< until it is released, only rest moves the robot
  QString stopped_by;       ///< the node that called stop
};

/// How well pictures come. A value that is not known is NaN.
struct LinkFigures {
  double pictures_per_second = kUnknown;
  double age = kUnknown;   ///< s
  double lost = kUnknown;  ///< 0..1
};

/// A setting of the driver that can be changed while it runs: a number, or one of some values.
struct Setting {
  QString name;  ///< the name of the parameter
  QString description;
  QVariant lowest;                            ///< an int or a double
  QVariant highest;                           ///< of the same type as `lowest`
  QVector<QPair<QString, QVariant>> choices;  ///< texts and values; empty for a number
};

/// The measurement of a range finder.
struct Distance {
  QString name;         ///< near, far or chest
  double metres = 0;    ///< may be infinite: nothing is within reach, or something is too near to be measured
  double farthest = 1;  ///< m, the farthest distance that it can measure
};

/// Parts of the robot's data that are received only while somebody looks at them, which saves processor time. The
/// robot's microphones are open only while somebody listens.
enum class Part { kPictures, kJoints, kSensors, kMicrophones };

using JointPositions = QMap<QString, double>;  ///< rad, by the joint's name
using SettingValues = QMap<QString, QVariant>;
using LedIntensities = QMap<QString, double>;  ///< 0..1, by the LED's name

/// The robot, as the window sees it. What is known about the robot comes as signals. Its functions tell it what to do.
///
/// No function waits. The effect of a function shows in the signals, and the answer of a service comes with answered().
/// All signals come on the thread of the object, which is the window's. A wish that cannot be fulfilled, for example
/// because there is no connection, gets an answer, too.
class Robot : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Uses the driver in this namespace from now on.
  /// @param name_space such as "/aibo"; empty means the first driver that is found
  virtual void useDriver(const QString& name_space) = 0;

  /// Says which parts somebody looks at. At first, nobody looks at any.
  virtual void show(const std::set<Part>& parts) = 0;

  /// Immediately stops everything that moves, and holds it until release() or rest. It waits for no other call.
  virtual void stop() = 0;

  /// Lets the robot move again after a stop.
  virtual void release() = 0;

  /// @param folder the folder on this machine in which the picture is saved
  virtual void takePicture(const QString& folder) = 0;
  virtual void setStreaming(bool on) = 0;
  virtual void setMotors(bool on) = 0;

  /// @param posture stand, sit or rest
  virtual void takePosture(const QString& posture) = 0;
  virtual void listMotions() = 0;

  /// @param repetitions 1 or more
  virtual void playMotion(const QString& name, int repetitions) = 0;

  /// Stores a motion on the robot's memory stick. It replaces a motion of the same name.
  /// @param motion the bytes of a motion file
  virtual void uploadMotion(const QString& name, const QByteArray& motion) = 0;

  /// Stops all motions that are playing.
  virtual void stopMotions() = 0;
  virtual void changeSetting(const QString& name, const QVariant& value) = 0;

  /// @param names names of LEDs or groups
  /// @param intensity 0..1
  virtual void setLeds(const QStringList& names, double intensity) = 0;
  virtual void flickEars(bool left, bool right) = 0;
  virtual void moveJoints(const JointPositions& positions) = 0;

  /// Speaks a text, in English.
  virtual void say(const QString& text) = 0;

  /// Ends the speech or other sound that plays.
  virtual void stopSound() = 0;

  /// Makes the robot walk. Call this several times a second, because the robot stops soon after the last call.
  /// @param forward m/s
  /// @param left m/s
  /// @param turn rad/s, counterclockwise
  virtual void walk(double forward, double left, double turn) = 0;

  /// Turns the head so that this place of the newest picture moves to its middle.
  /// @param place the place, 0..1 from left to right and from top to bottom
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

  /// @param path the path of the file in which the picture was saved
  void pictureTaken(const QImage& picture, const QString& path);

  /// @param text what moves the robot, in one line
  void movementChanged(const QString& text);
  void motionsListed(const QStringList& names);
  void motionUploaded(const QString& name);
  void settingsDescribed(const QVector<aibo_driver::remote_control::Setting>& settings);

  /// The values of all settings that are in force.
  void settingsChanged(const aibo_driver::remote_control::SettingValues& values);
  void jointsMeasured(const aibo_driver::remote_control::JointPositions& positions);

  /// The places that are touched now, in the words of aibo_driver/Touch.
  void touched(const QStringList& places);
  void distanceMeasured(const aibo_driver::remote_control::Distance& distance);

  /// @param level the level of what was heard lately, in dB; 0 is the loudest
  void heard(double level);
  void ledsChanged(const aibo_driver::remote_control::LedIntensities& intensities);

  /// Emitted when the robot refuses something that this window moves, such as a walk over an edge. This is no error.
  /// @param text what the robot refuses, and why
  void hinted(const QString& text);

  /// Emitted when a call has ended or was refused, or when something that this window moves did not arrive.
  /// @param text what was asked for, and its result
  void answered(bool success, const QString& text);
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ROBOT_H
