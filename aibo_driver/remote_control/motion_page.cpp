#include "remote_control/page.h"

#include <QGridLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QSpinBox>

#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {
namespace {

class MotionPage : public Page {
 public:
  explicit MotionPage(Robot& robot, QWidget* parent);

 private:
  void connectionChanged(const RobotConnection& connection) override;
  void showMotions(const QStringList& names);
  void play();

  Robot& robot_;
  QListWidget* list_;
  QLineEdit* name_;
  QSpinBox* repetitions_;
  ElidedLabel* movement_;
  QString listed_for_;  ///< the connection for which the motions were requested
};

MotionPage::MotionPage(Robot& robot, QWidget* parent)
    : Page(parent),
      robot_(robot),
      list_(new QListWidget(this)),
      name_(new QLineEdit(this)),
      repetitions_(new QSpinBox(this)),
      movement_(new ElidedLabel(this)) {
  list_->setObjectName("motions");
  list_->setToolTip("The motions on the robot's memory stick. A double click plays one.");
  name_->setObjectName("motion_name");
  name_->setPlaceholderText("name of a motion");
  name_->setToolTip("The motion to play. A robot of version 1 cannot list its motions; write the name then.");
  repetitions_->setRange(1, 999);
  repetitions_->setSpecialValueText("once");
  repetitions_->setSuffix(" times");
  movement_->setObjectName("movement");
  auto* grid = new QGridLayout(makeContent());
  grid->addWidget(need(Needs::kVersion2, list_), 0, 0, 5, 1);
  grid->addWidget(need(Needs::kConnection, name_), 0, 1);
  grid->addWidget(need(Needs::kConnection, repetitions_), 1, 1);
  grid->addWidget(makeButton(Needs::kMotors, "Play", "Plays the motion", [this] { play(); }), 2, 1);
  grid->addWidget(makeButton(Needs::kConnection, "Stop motions", "Ends all motions; the joints hold where they are",
                             [this] { robot_.stopMotions(); }),
                  3, 1);
  grid->addWidget(makeButton(Needs::kVersion2, "List again", "Asks the robot which motions it has",
                             [this] { robot_.listMotions(); }),
                  4, 1, Qt::AlignTop);
  grid->addWidget(movement_, 5, 0, 1, 2);
  grid->setColumnStretch(0, 1);
  grid->setRowStretch(4, 1);
  connect(list_, &QListWidget::currentTextChanged, name_, &QLineEdit::setText);
  connect(list_, &QListWidget::itemDoubleClicked, this, [this](const QListWidgetItem* item) {
    name_->setText(item->text());  // another name may have been written since the item was chosen
    play();
  });
  connect(name_, &QLineEdit::returnPressed, this, [this] { play(); });
  connect(&robot, &Robot::motionsListed, this, &MotionPage::showMotions);
  connect(&robot, &Robot::movementChanged, this,
          [this](const QString& text) { movement_->showText(text.isEmpty() ? QString() : "Now: " + text); });
}

void MotionPage::play() {
  if (!name_->text().trimmed().isEmpty()) {
    robot_.playMotion(name_->text().trimmed(), repetitions_->value());
  }
}

void MotionPage::showMotions(const QStringList& names) {
  list_->clear();
  list_->addItems(names);
}

// Asks the robot for its motions once for each connection.
void MotionPage::connectionChanged(const RobotConnection& connection) {
  movement_->setVisible(connection.hasRobot());  // the movement may have come before the connection
  const QString robot = connection.isConnected() && connection.protocol_version == 2
                            ? connection.name_space + connection.address
                            : QString();
  if (robot == listed_for_) {
    return;
  }
  listed_for_ = robot;
  list_->clear();
  if (!robot.isEmpty()) {
    robot_.listMotions();
  }
}

}  // namespace

Page* makeMotionPage(Robot& robot, QWidget* parent) {
  return new MotionPage(robot, parent);
}

}  // namespace aibo_driver::remote_control
