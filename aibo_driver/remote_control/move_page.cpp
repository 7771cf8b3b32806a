#include "remote_control/page.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>
#include <cmath>

#include "aibo_client/exceptions.h"
#include "movement/joint_table.h"
#include "remote_control/axis_pad.h"
#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {
namespace {

// The velocities at the edges of a pad, as in config/joy.yaml. The driver and the robot have limits of their own.
constexpr double kForward = 0.15;  // m/s
constexpr double kLeft = 0.06;     // m/s
constexpr double kTurn = 1.0;      // rad/s

constexpr double kDeadZone = 0.1;  // part of the half width, so that it is easy to walk straight ahead

constexpr int kPeriod = 100;  // ms; the robot stops 500 ms after the last command

double withoutDeadZone(double deflection) {
  return std::abs(deflection) < kDeadZone ? 0 : deflection;
}

/// A pad that makes the robot walk while a mouse button is held on it. Up and down walk forward and backward. To the
/// sides, the robot turns if the left button is held, and steps sideways with another button. The button works like a
/// dead-man's switch: when it is released, the robot gets one order to stop, and then nothing more.
class DrivePad : public AxisPad {
 public:
  DrivePad(Robot& robot, QWidget* parent);

 private:
  void send();

  Robot& robot_;
  QTimer timer_;
};

DrivePad::DrivePad(Robot& robot, QWidget* parent) : AxisPad(parent), robot_(robot) {
  setObjectName("drive_pad");
  setToolTip("The robot walks while the mouse is held down here. The right button steps to the sides.");
  setTexts("forward", "backward", "left", "right");
  connect(this, &AxisPad::moved, this, [this] {
    if (!timer_.isActive()) {
      send();
      timer_.start(kPeriod);
    }
  });
  connect(this, &AxisPad::released, this, [this] {
    timer_.stop();
    robot_.walk(0, 0, 0);
  });
  connect(&timer_, &QTimer::timeout, this, &DrivePad::send);
}

void DrivePad::send() {
  const double forward = withoutDeadZone(chosen().y());
  const double left = -withoutDeadZone(chosen().x());
  const bool turns = button() == Qt::LeftButton;
  robot_.walk(forward * kForward, turns ? 0 : left * kLeft, turns ? left * kTurn : 0);
}

constexpr const char* kPan = "head_pan";
constexpr const char* kTilt = "head_tilt";

/// Converts a position: -1 is the lowest, 1 is the highest.
double toPad(double position, const movement::JointProperties& joint) {
  return 2 * (position - joint.lowest) / (joint.highest - joint.lowest) - 1;
}

double fromPad(double place, const movement::JointProperties& joint) {
  return joint.lowest + (place + 1) / 2 * (joint.highest - joint.lowest);
}

/// A pad that points the head: to the sides with head_pan, up and down with head_tilt. The pad's mark shows where the
/// head is.
class HeadPad : public AxisPad {
 public:
  HeadPad(Robot& robot, QWidget* parent);

  /// Uses the limits of the robot with this design. An unknown design is ignored.
  void setDesign(const QString& design);

  void showPositions(const JointPositions& positions);

 private:
  movement::JointProperties pan_;
  movement::JointProperties tilt_;
};

HeadPad::HeadPad(Robot& robot, QWidget* parent) : AxisPad(parent) {
  setObjectName("head_pad");
  setToolTip("Points the head. The green mark is where it is.");
  setTexts("up", "down", "left", "right");
  setDesign("ERS-7");
  // The x axis is turned around, because the robot counts angles to the left as positive.
  connect(this, &AxisPad::moved, this, [this, &robot](const QPointF& place) {
    robot.moveJoints({{kPan, fromPad(-place.x(), pan_)}, {kTilt, fromPad(place.y(), tilt_)}});
  });
}

void HeadPad::setDesign(const QString& design) {
  try {
    const movement::JointTable table(design.toStdString(), kAnySpeed);
    const auto pan = table.findByName(kPan);
    const auto tilt = table.findByName(kTilt);
    if (pan && tilt) {
      pan_ = table[*pan];
      tilt_ = table[*tilt];
    }
  } catch (const aibo_client::InvalidArgumentException&) {
    // The driver refuses commands to a robot of an unknown design.
  }
}

void HeadPad::showPositions(const JointPositions& positions) {
  if (isVisible() && positions.contains(kPan) && positions.contains(kTilt)) {
    setMeasured(QPointF(-toPad(positions[kPan], pan_), toPad(positions[kTilt], tilt_)));
  }
}

class MovePage : public Page {
 public:
  MovePage(Robot& robot, QWidget* parent);

  std::optional<Part> part() const override { return Part::kJoints; }

 private:
  void connectionChanged(const RobotConnection& connection) override;

  DrivePad* drive_pad_;
  HeadPad* head_pad_;
  ElidedLabel* movement_;
  QCheckBox* guard_;
};

MovePage::MovePage(Robot& robot, QWidget* parent)
    : Page(parent),
      drive_pad_(new DrivePad(robot, this)),
      head_pad_(new HeadPad(robot, this)),
      movement_(new ElidedLabel(this)),
      guard_(new QCheckBox("Guard", this)) {
  need(Needs::kFeet, drive_pad_);
  need(Needs::kMotors, head_pad_);
  auto* grid = new QGridLayout(makeContent());
  grid->addWidget(new QLabel("Walk: while the mouse is held", this), 0, 0, Qt::AlignHCenter);
  grid->addWidget(new QLabel("Head", this), 0, 1, Qt::AlignHCenter);
  grid->addWidget(drive_pad_, 1, 0);
  grid->addWidget(head_pad_, 1, 1);
  grid->setContentsMargins(6, 4, 6, 4);
  grid->setVerticalSpacing(3);
  grid->setRowStretch(1, 1);
  auto* buttons = new QHBoxLayout;
  const auto add_posture = [&](Needs needs, const QString& text, const QString& tip) {
    buttons->addWidget(
        makeButton(needs, text, tip, [&robot, posture = text.toLower()] { robot.takePosture(posture); }));
  };
  add_posture(Needs::kNotStopped, "Stand", "Stands up");
  add_posture(Needs::kNotStopped, "Sit", "Sits down");
  add_posture(Needs::kVersion2, "Rest", "Lies down, and switches the motors off");
  buttons->addWidget(makeButton(Needs::kNotStopped, "Motors on", "The joints hold their positions and can be moved",
                                [&robot] { robot.setMotors(true); }));
  buttons->addWidget(makeButton(Needs::kVersion2, "Motors off",
                                "The joints can be moved by hand. A standing robot falls!",
                                [&robot] { robot.setMotors(false); }));
  movement_->setObjectName("who_moves");
  guard_->setObjectName("guard_walks");
  guard_->setToolTip(
      "Walks end before edges and walls. Backward and sideways, where it cannot see, the robot walks only where it has "
      "just walked.");
  guard_->setFixedHeight(movement_->minimumHeight());
  guard_->hide();  // until the driver has said whether the guard is on
  auto* who_moves = new QHBoxLayout;
  who_moves->addWidget(movement_, 1);
  who_moves->addWidget(need(Needs::kVersion2, guard_));
  grid->addLayout(who_moves, 2, 0, 1, 2);
  grid->addLayout(buttons, 3, 0, 1, 2);
  setMinimumHeight(widget()->minimumSizeHint().height());  // nobody should have to scroll to a pad
  connect(&robot, &Robot::jointsMeasured, this, [this](const JointPositions& positions) {
    if (hasRobot()) {
      head_pad_->showPositions(positions);
    }
  });
  connect(guard_, &QCheckBox::clicked, &robot, [this, &robot](bool on) {
    guard_->setChecked(!on);  // the box shows what the driver reports
    robot.changeSetting("guard", on);
  });
  connect(&robot, &Robot::settingsChanged, this, [this](const SettingValues& values) {
    guard_->setVisible(values.contains("guard"));
    guard_->setChecked(values.value("guard").toBool());
  });
  connect(&robot, &Robot::movementChanged, this, [this](const QString& text) {
    movement_->showText(text.section(';', 0, 0));  // without the movements that have ended
    movement_->setToolTip(text);
  });
}

void MovePage::connectionChanged(const RobotConnection& connection) {
  movement_->setVisible(connection.hasRobot());  // the text may have come before the connection
  if (connection.hasRobot()) {
    head_pad_->setDesign(connection.robot);
  } else {
    head_pad_->setMeasured(std::nullopt);
  }
}

}  // namespace

Page* makeMovePage(Robot& robot, QWidget* parent) {
  return new MovePage(robot, parent);
}

}  // namespace aibo_driver::remote_control
