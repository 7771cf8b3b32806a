#include "remote_control/page.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QVBoxLayout>
#include <map>

#include "aibo_client/exceptions.h"
#include "remote_control/joint_slider.h"

namespace aibo_driver::remote_control {
namespace {

/// Where a joint is on the page: the title of its group and its name in the group.
struct Place {
  QString group;
  QString label;
};

Place placeOf(const QString& joint) {
  for (const char* leg : {"left_front", "right_front", "left_hind", "right_hind"}) {
    if (joint.startsWith(leg)) {
      QString title = QString(leg).replace('_', ' ');
      title[0] = title[0].toUpper();
      return {title, joint.mid(static_cast<int>(qstrlen(leg)) + 1)};
    }
  }
  return {joint.startsWith("tail") ? "Tail" : "Head", QString(joint).replace('_', ' ')};
}

class JointsPage : public Page {
 public:
  JointsPage(Robot& robot, QWidget* parent);

  std::optional<Part> part() const override { return Part::kJoints; }

 private:
  void showPositions(const JointPositions& positions);
  void connectionChanged(const RobotConnection& connection) override;
  void makeSliders(const QString& design);

  Robot& robot_;
  QString design_;
  std::map<QString, JointSlider*> sliders_;
};

JointsPage::JointsPage(Robot& robot, QWidget* parent) : Page(parent), robot_(robot) {
  need(Needs::kMotors, this);
  makeSliders("ERS-7");
  connect(&robot, &Robot::jointsMeasured, this, &JointsPage::showPositions);
}

void JointsPage::connectionChanged(const RobotConnection& connection) {
  if (connection.hasRobot() && !connection.robot.isEmpty() && connection.robot != design_) {
    makeSliders(connection.robot);
  }
  if (!connection.hasRobot()) {
    for (const auto& [name, slider] : sliders_) {
      slider->forget();
    }
  }
}

void JointsPage::makeSliders(const QString& design) {
  design_ = design;
  sliders_.clear();
  QWidget* const inside = makeContent();
  auto* grid = new QGridLayout(inside);
  grid->setContentsMargins(2, 2, 2, 2);
  std::map<QString, QVBoxLayout*> groups;
  try {
    const movement::JointTable table(design.toStdString(), kAnySpeed);
    for (const char* title : {"Head", "Tail", "Left front", "Right front", "Left hind", "Right hind"}) {
      auto* group = new QGroupBox(title, inside);
      auto* rows = new QVBoxLayout(group);
      rows->setContentsMargins(4, 2, 4, 2);
      rows->setSpacing(2);
      const int number = static_cast<int>(groups.size());
      groups[title] = rows;
      grid->addWidget(group, number / 2, number % 2);
    }
    for (const movement::JointProperties& joint : table.joints()) {
      const Place place = placeOf(QString::fromStdString(joint.name));
      auto* slider = new JointSlider(joint, place.label, inside);
      groups[place.group]->addWidget(slider);
      sliders_[slider->joint()] = slider;
      connect(slider, &JointSlider::moved, this, [this](const QString& name, double position) {
        robot_.moveJoints({{name, position}});
      });
    }
    for (const auto& [title, rows] : groups) {
      rows->addStretch(1);
    }
  } catch (const aibo_client::InvalidArgumentException& error) {
    grid->addWidget(new QLabel(error.what(), inside), 0, 0);
  }
}

void JointsPage::showPositions(const JointPositions& positions) {
  if (!isVisible() || !hasRobot()) {
    return;
  }
  for (auto joint = positions.begin(); joint != positions.end(); ++joint) {
    if (const auto found = sliders_.find(joint.key()); found != sliders_.end()) {
      found->second->measure(joint.value());
    }
  }
}

}  // namespace

Page* makeJointsPage(Robot& robot, QWidget* parent) {
  return new JointsPage(robot, parent);
}

}  // namespace aibo_driver::remote_control
