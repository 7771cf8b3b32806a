/// @file page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_PAGE_H

#include <QPushButton>
#include <QScrollArea>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// What a part of the window needs from the robot. Each need includes the needs above it, except that kMotors does not
/// need a server of version 2.
enum class Needs {
  kConnection,
  kVersion2,    ///< a server of version 2
  kNotStopped,  ///< the robot must not be stopped: the part moves it or switches the motors on
  kMotors,      ///< the motors must be on, with any server
  kFeet         ///< the robot must stand on its feet
};

/// Why the robot cannot do something now; empty if it can, or if nobody knows.
QString whyNot(Needs needs, const RobotConnection& connection, const RobotCondition& condition);

/// Enables a widget, or disables it and says why in its tooltip. When the widget is enabled again, its own tooltip
/// comes back.
/// @param why_not the reason; empty enables the widget
void allow(QWidget* widget, const QString& why_not);

/// The property of a widget with the tooltip that it has while it is enabled.
constexpr const char* kOwnToolTip = "own_tool_tip";

/// A text field with this property takes spaces after its first letter. In all others, the space bar stops the robot.
constexpr const char* kTakesSpaces = "takes_spaces";

/// A part of the window. Each of its widgets can be used while the robot can do what the widget is for. A page scrolls
/// if it needs more room than it has, so that nothing on it changes the size of anything else.
class Page : public QScrollArea {
  Q_OBJECT

 public:
  explicit Page(QWidget* parent = nullptr);

  /// The part of the robot's data that this page shows. It may change with visibilityChanged().
  virtual std::optional<Part> part() const { return std::nullopt; }

  /// Enables the widgets, or disables them and says why.
  void setState(const RobotConnection& connection, const RobotCondition& condition);

 Q_SIGNALS:
  void visibilityChanged();

 protected:
  /// True while there is a robot. Measurements from before the robot was lost may come later.
  bool hasRobot() const { return has_robot_; }

  /// Adds a widget that can be used only while the robot meets this need.
  template <typename Widget>
  Widget* need(Needs needs, Widget* widget) {
    controls_.push_back({widget, needs});
    allow(widget, "nothing is known of the robot yet");
    return widget;
  }

  /// Makes a widget for everything on the page, in place of the previous one.
  QWidget* makeContent();

  QPushButton* makeButton(Needs needs, const QString& text, const QString& tip, const std::function<void()>& clicked);

  /// Makes a button that can always be used.
  QPushButton* makeButton(const QString& text, const QString& tip, const std::function<void()>& clicked);

 private:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  virtual void connectionChanged(const RobotConnection&) {}

  struct Control {
    QWidget* widget;
    Needs needs;
  };
  std::vector<Control> controls_;
  bool has_robot_ = false;
};

// The functions below make the pages (docs/remote_control.md). The robot must outlive the pages.
Page* makeMovePage(Robot& robot, QWidget* parent);     ///< walking, the head, postures and the motors
Page* makeMotionPage(Robot& robot, QWidget* parent);   ///< the motions on the robot, and what moves it now
Page* makeJointsPage(Robot& robot, QWidget* parent);   ///< a slider for each joint
Page* makeLightsPage(Robot& robot, QWidget* parent);   ///< the LEDs, as the driver reports them, and the ears
Page* makeSensorsPage(Robot& robot, QWidget* parent);  ///< what touches the robot, and its range finders
Page* makeSoundPage(Robot& robot, QWidget* parent);    ///< how loud it is around the robot, and texts for it to say

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
