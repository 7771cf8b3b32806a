#include "remote_control/page.h"

#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QGridLayout>
#include <QGroupBox>
#include <QLineEdit>
#include <QPointer>
#include <QVBoxLayout>
#include <map>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "remote_control/joint_slider.h"
#include "remote_control/pose_motion.h"
#include "remote_control/widgets.h"

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
  QLayout* makeKeyFrameRows();
  QString motionName() const { return name_->text().isEmpty() ? name_->placeholderText() : name_->text(); }
  void addKeyFrame();
  std::optional<PoseMotion> makeMotion();
  void chooseFile();
  void save(const QString& path);
  void play();
  void playUploaded(const QString& name);

  Robot& robot_;
  QString design_;
  QWidget* sliders_place_;
  QWidget* sliders_box_ = nullptr;  ///< in that place, the sliders of this design
  std::map<QString, JointSlider*> sliders_;
  std::vector<Pose> key_frames_;
  QDoubleSpinBox* seconds_;
  QLineEdit* name_;
  ElidedLabel* motion_text_;
  QPointer<QFileDialog> dialog_;  ///< the dialog to choose a file; null when it is closed
  QString to_play_;               ///< the motion to play after its upload; empty if none is being uploaded
};

JointsPage::JointsPage(Robot& robot, QWidget* parent)
    : Page(parent),
      robot_(robot),
      sliders_place_(need(Needs::kMotors, new QWidget(this))),
      seconds_(new QDoubleSpinBox(this)),
      name_(new QLineEdit(this)),
      motion_text_(new ElidedLabel(this)) {
  auto* rows = new QVBoxLayout(makeContent());
  rows->setContentsMargins(2, 2, 2, 2);
  rows->addLayout(makeKeyFrameRows());
  rows->addWidget(sliders_place_);
  rows->addStretch(1);
  (new QVBoxLayout(sliders_place_))->setContentsMargins(0, 0, 0, 0);
  makeSliders("ERS-7");
  connect(&robot, &Robot::jointsMeasured, this, &JointsPage::showPositions);
  connect(&robot, &Robot::motionUploaded, this, &JointsPage::playUploaded);
  connect(&robot, &Robot::conditionChanged, this, [this](const RobotCondition& condition) {
    if (condition.is_stopped) {
      to_play_.clear();  // nothing starts by itself after a release
    }
  });
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
  key_frames_.clear();
  delete sliders_box_;
  sliders_box_ = new QWidget(sliders_place_);
  sliders_place_->layout()->addWidget(sliders_box_);
  auto* grid = new QGridLayout(sliders_box_);
  grid->setContentsMargins(0, 0, 0, 0);
  std::map<QString, QVBoxLayout*> groups;
  try {
    const movement::JointTable table(design.toStdString(), kAnySpeed);
    for (const char* title : {"Head", "Tail", "Left front", "Right front", "Left hind", "Right hind"}) {
      auto* group = new QGroupBox(title, sliders_box_);
      auto* rows = new QVBoxLayout(group);
      rows->setContentsMargins(4, 2, 4, 2);
      rows->setSpacing(2);
      const int number = static_cast<int>(groups.size());
      groups[title] = rows;
      grid->addWidget(group, number / 2, number % 2);
    }
    for (const movement::JointProperties& joint : table.joints()) {
      const Place place = placeOf(QString::fromStdString(joint.name));
      auto* slider = new JointSlider(joint, place.label, sliders_box_);
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
    grid->addWidget(new QLabel(error.what(), sliders_box_), 0, 0);
  }
  makeMotion();
}

QLayout* JointsPage::makeKeyFrameRows() {
  seconds_->setObjectName("seconds");
  seconds_->setRange(0.1, 60);
  seconds_->setSingleStep(0.1);
  seconds_->setDecimals(1);
  seconds_->setValue(1);
  seconds_->setPrefix("every ");
  seconds_->setSuffix(" s");
  seconds_->setToolTip("The time from key frame to key frame. A joint that needs longer gets it.");
  new IgnoreWheel(seconds_);
  name_->setObjectName("name_of_new_motion");
  name_->setMaxLength(8);
  name_->setPlaceholderText("POSE");
  name_->setToolTip("The name of the motion, up to 8 characters. On the robot, it replaces a motion of this name.");
  motion_text_->setObjectName("new_motion");
  name_->setFixedWidth(fontMetrics().horizontalAdvance("MMMMMMMM") + 12);
  auto* poses = new QHBoxLayout;
  poses->addWidget(makeButton(Needs::kConnection, "Add key frame",
                              "Adds the pose that the sliders show to a motion. With the motors off, you can move the "
                              "joints by hand.",
                              [this] { addKeyFrame(); }));
  poses->addWidget(makeButton("Undo", "Removes the last key frame", [this] {
    if (!key_frames_.empty()) {
      key_frames_.pop_back();
    }
    makeMotion();
  }));
  poses->addWidget(makeButton("Clear", "Removes all key frames", [this] {
    key_frames_.clear();
    makeMotion();
  }));
  poses->addWidget(seconds_);
  poses->addStretch(1);
  auto* motion = new QHBoxLayout;
  motion->addWidget(name_);
  motion->addWidget(makeButton("Save as...",
                               "Saves the motion as text for aibo_mtn, or as a motion file if the name ends in .MTN",
                               [this] { chooseFile(); }));
  motion->addWidget(makeButton(Needs::kMotors, "Play on robot",
                               "Stores the motion on the robot, whose RCSERVER.CFG has to allow it, and plays it once",
                               [this] { play(); }));
  motion->addWidget(motion_text_, 1);
  auto* rows = new QVBoxLayout;
  rows->addLayout(poses);
  rows->addLayout(motion);
  connect(seconds_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] { makeMotion(); });
  return rows;
}

void JointsPage::addKeyFrame() {
  Pose pose;
  for (const auto& [name, slider] : sliders_) {
    const std::optional<double> position = slider->position();
    if (!position) {
      motion_text_->showText(name + " has not been measured yet");
      return;
    }
    pose[name.toStdString()] = *position;
  }
  key_frames_.push_back(pose);
  makeMotion();
}

// Makes a motion of the key frames, and shows its length, or why it cannot be made.
std::optional<PoseMotion> JointsPage::makeMotion() {
  if (key_frames_.empty()) {
    motion_text_->showText("no key frame yet");
    return std::nullopt;
  }
  try {
    PoseMotion motion =
        makePoseMotion(motionName().toStdString(), design_.toStdString(), key_frames_, seconds_->value());
    const auto count = static_cast<int>(key_frames_.size());
    motion_text_->showText(QString("%1 key frame%2, %3 s").arg(count).arg(count == 1 ? "" : "s").arg(motion.duration) +
                           (motion.remark.empty() ? "" : "; ") + QString::fromStdString(motion.remark));
    return motion;
  } catch (const std::runtime_error& error) {
    motion_text_->showText(error.what());
    return std::nullopt;
  }
}

// The dialog is not modal, and does not ask whether to replace a file, because STOP has to work meanwhile.
void JointsPage::chooseFile() {
  if (dialog_ != nullptr) {
    dialog_->raise();
    return;
  }
  dialog_ = new QFileDialog(this, "Save the motion", "", "Motions (*.txt *.mtn *.MTN)");
  dialog_->setAttribute(Qt::WA_DeleteOnClose);
  dialog_->setAcceptMode(QFileDialog::AcceptSave);
  dialog_->setOption(QFileDialog::DontConfirmOverwrite);
  dialog_->setDefaultSuffix("txt");
  dialog_->selectFile(motionName() + ".txt");
  connect(dialog_, &QFileDialog::fileSelected, this, &JointsPage::save);
  dialog_->show();
}

void JointsPage::save(const QString& path) {
  const std::optional<PoseMotion> motion = makeMotion();
  if (!motion) {
    return;
  }
  if (QFile::exists(path)) {
    motion_text_->showText("not saved: " + path + " exists; choose another name");
    return;
  }
  try {
    files::replaceFile(path.toStdString(), path.endsWith(".mtn", Qt::CaseInsensitive) ? motion->bytes : motion->text);
    motion_text_->showText("saved as " + path);
  } catch (const files::FileException& error) {
    motion_text_->showText(QString("not saved: ") + error.what());
  }
}

void JointsPage::play() {
  if (const std::optional<PoseMotion> motion = makeMotion()) {
    to_play_ = motionName();
    robot_.uploadMotion(to_play_, QByteArray::fromStdString(motion->bytes));
  }
}

void JointsPage::playUploaded(const QString& name) {
  if (name == to_play_) {
    to_play_.clear();
    robot_.playMotion(name, 1);
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
