#include "remote_control/move_page.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>

namespace aibo_driver::remote_control {

MovePage::MovePage(Robot& robot, QWidget* parent)
    : Page(parent),
      drive_pad_(new DrivePad(this)),
      head_pad_(new HeadPad(this)),
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
                                "The joints can be moved by hand. A robot that stands falls!",
                                [&robot] { robot.setMotors(false); }));
  movement_->setObjectName("who_moves");
  guard_->setObjectName("guard_walks");
  guard_->setToolTip(
      "Walks end before edges and walls. Backward and sideways, where it cannot see, the robot walks only where it has "
      "just walked.");
  guard_->setFixedHeight(movement_->minimumHeight());
  guard_->hide();  // until the driver has told whether it is on
  auto* who_moves = new QHBoxLayout;
  who_moves->addWidget(movement_, 1);
  who_moves->addWidget(need(Needs::kVersion2, guard_));
  grid->addLayout(who_moves, 2, 0, 1, 2);
  grid->addLayout(buttons, 3, 0, 1, 2);
  setMinimumHeight(widget()->minimumSizeHint().height());  // nobody should have to scroll to a pad
  connect(drive_pad_, &DrivePad::walk, &robot, &Robot::walk);
  connect(head_pad_, &HeadPad::pointed, &robot, &Robot::moveJoints);
  connect(&robot, &Robot::jointsMeasured, this, [this](const JointPositions& positions) {
    if (hasRobot()) {
      head_pad_->showPositions(positions);
    }
  });
  connect(guard_, &QCheckBox::clicked, &robot, [this, &robot](bool on) {
    guard_->setChecked(!on);  // it shows what the driver reports
    robot.changeSetting("guard", on);
  });
  connect(&robot, &Robot::settingsChanged, this, [this](const SettingValues& values) {
    guard_->setVisible(values.contains("guard"));
    guard_->setChecked(values.value("guard").toBool());
  });
  connect(&robot, &Robot::movementChanged, this, [this](const QString& text) {
    movement_->showText(text.section(';', 0, 0));  // without what has ended
    movement_->setToolTip(text);
  });
}

void MovePage::connectionChanged(const RobotConnection& connection) {
  movement_->setVisible(connection.hasRobot());  // its text may have come before the connection
  if (connection.hasRobot()) {
    head_pad_->setDesign(connection.robot);
  } else {
    head_pad_->setMeasured(std::nullopt);
  }
}

}  // namespace aibo_driver::remote_control
