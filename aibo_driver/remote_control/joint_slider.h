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

/// A slider between two limits. A mark shows the measured position of the joint.
class MarkedSlider : public QSlider {
  Q_OBJECT

 public:
  explicit MarkedSlider(QWidget* parent = nullptr) : QSlider(Qt::Horizontal, parent) {}

  /// @param value a value in the units of the slider; empty removes the mark
  void setMark(std::optional<int> value);

 private:
  void paintEvent(QPaintEvent* event) override;

  std::optional<int> mark_;
};

/// One joint, with a slider that commands it and shows its limits and position. The slider follows the joint, unless
/// somebody holds the slider. When it is released, it waits until the joint has arrived or some time has passed.
class JointSlider : public QWidget {
  Q_OBJECT

 public:
  /// @param label the joint's name to show
  JointSlider(const movement::JointProperties& joint, const QString& label, QWidget* parent = nullptr);

  const QString& joint() const { return joint_; }

  /// @param position the measured position in rad
  void measure(double position);

  /// The position that the slider shows, in rad: the one that it has commanded, until the joint has arrived, and
  /// otherwise the measured one. Empty if the joint has not been measured yet.
  std::optional<double> position() const;

  /// Returns to the state before the first measurement.
  void forget();

  MarkedSlider* slider() { return slider_; }

 Q_SIGNALS:
  /// Emitted when somebody has moved the slider.
  /// @param position the position in rad
  void moved(const QString& joint, double position);

 private:
  void command(int value);
  bool isBusy(int measured);
  void showText();

  const QString joint_;
  MarkedSlider* slider_;
  QLabel* text_;
  std::optional<int> measured_;   ///< mrad
  std::optional<int> commanded_;  ///< mrad; empty when the joint has arrived
  QElapsedTimer since_commanded_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_JOINT_SLIDER_H
