/// @file sound_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_SOUND_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_SOUND_PAGE_H

#include <QCheckBox>
#include <QLineEdit>
#include <QProgressBar>
#include <QTimer>

#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// Shows how loud it is around the robot, and lets it speak.
class SoundPage : public Page {
  Q_OBJECT

 public:
  /// A text field with this property takes spaces after its first letter. In all others, the space bar stops the robot.
  static constexpr const char* kTakesSpaces = "takes_spaces";

  /// @param robot must outlive the page
  explicit SoundPage(Robot& robot, QWidget* parent = nullptr);

  /// True while the user wants the robot's microphones to be open. It may change with visibilityChanged().
  bool listens() const { return isVisible() && listen_->isChecked(); }

 private:
  QWidget* makeMicrophones();
  QWidget* makeSpeech();
  void showLevel(double level);
  void waitForSound();
  void showSilence();
  void connectionChanged(const RobotConnection& connection) override;
  void say();

  Robot& robot_;
  QCheckBox* listen_;
  QProgressBar* level_;
  QLineEdit* text_;
  bool had_robot_ = false;
  QTimer silence_;  ///< runs out when nothing has come for a while
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_SOUND_PAGE_H
