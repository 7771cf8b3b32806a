/// @file joint_slider.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_JOINT_SLIDER_H
#define AIBO_DRIVER_REMOTE_CONTROL_JOINT_SLIDER_H

#include <QElapsedTimer>
#include <QLabel>
#include <QSlider>
#include <QWidget>
#include <optional>

#include "movement/joint_table.h"

namespace aibo_driver::remote_control {

/// A slider between two limits, with a mark where the joint is measured. The mouse wheel does not move it: somebody who
/// scrolls does not want to move the robot.
class MarkedSlider : public QSlider {
  Q_OBJECT

 public:
  explicit MarkedSlider(QWidget* parent = nullptr) : QSlider(Qt::Horizontal, parent) {}

  /// @param value in the units of the slider
  void setMark(int value);

 private:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

  std::optional<int> mark_;
};

/// One joint: a slider that commands it, its limits, and where it is. A slider follows its joint, except while
/// somebody holds it, and then until the joint has arrived or some time has passed.
class JointSlider : public QWidget {
  Q_OBJECT

 public:
  /// @param label for people
  JointSlider(const movement::JointProperties& joint, const QString& label, QWidget* parent = nullptr);

  const QString& joint() const { return joint_; }

  /// @param position rad
  void measure(double position);

  MarkedSlider* slider() { return slider_; }

 Q_SIGNALS:
  /// Somebody has moved the slider.
  /// @param position rad
  void moved(const QString& joint, double position);

 private:
  void command(int value);
  bool isBusy(int measured);
  void showText();

  const QString joint_;
  MarkedSlider* slider_;
  QLabel* text_;
  std::optional<int> measured_;   ///< mrad
  std::optional<int> commanded_;  ///< mrad; until the joint has arrived
  QElapsedTimer since_commanded_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_JOINT_SLIDER_H
