/// @file fake_robot.h
#ifndef TEST_UNIT_REMOTE_CONTROL_FAKE_ROBOT_H
#define TEST_UNIT_REMOTE_CONTROL_FAKE_ROBOT_H

#include <QStringList>
#include <set>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// Writes down what is wished of it. Tests emit its signals.
class FakeRobot : public Robot {
 public:
  /// Wishes in words, such as "play NOD.MTN 2".
  QStringList wishes;

  std::set<Part> visible;

  /// All wishes since the last call.
  QStringList take() {
    const QStringList taken = wishes;
    wishes.clear();
    return taken;
  }

  void connectIt(int protocol_version = 2, const QString& robot = "ERS-7") {
    RobotConnection connection;
    connection.state = RobotConnection::State::kConnected;
    connection.name_space = "/aibo";
    connection.robot = protocol_version == 2 ? robot : "";
    connection.address = "robot:54321";
    connection.protocol_version = protocol_version;
    connection.text = "connected";
    Q_EMIT connectionChanged(connection);
  }

  void disconnectIt(RobotConnection::State state, const QString& text) {
    RobotConnection connection;
    connection.state = state;
    connection.name_space = "/aibo";
    if (connection.hasDriver()) {
      connection.robot = "ERS-7";
      connection.address = "robot:54321";
    }
    connection.text = text;
    Q_EMIT connectionChanged(connection);
  }

  void useDriver(const QString& name_space) override { wishes.append("use " + name_space); }
  void show(Part part, bool is_visible) override {
    if (is_visible) {
      visible.insert(part);
    } else {
      visible.erase(part);
    }
  }
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
};

}  // namespace aibo_driver::remote_control

#endif  // TEST_UNIT_REMOTE_CONTROL_FAKE_ROBOT_H
