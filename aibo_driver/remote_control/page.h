/// @file page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_PAGE_H

#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <QWidget>
#include <functional>
#include <vector>

#include "remote_control/allow.h"
#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// A part of the window that is used while the robot is connected.
class Page : public QWidget {
  Q_OBJECT

 public:
  using QWidget::QWidget;

  Q_SIGNAL void visibilityChanged();

  /// Enables its widgets, or disables them and says why.
  void setConnection(const RobotConnection& connection) {
    const QString not_connected = connection.isConnected() ? QString() : connection.text;
    for (const Control& control : controls_) {
      const QString not_supported = control.needs_version_2 ? whyNotVersion1(connection.protocol_version) : QString();
      allow(control.widget, not_connected.isEmpty() ? not_supported : not_connected);
    }
    connectionChanged(connection);
  }

 protected:
  enum class Needs { kConnection, kVersion2 };

  /// A widget that can be used only while the robot is connected.
  template <typename Widget>
  Widget* need(Needs needs, Widget* widget) {
    controls_.push_back({widget, needs == Needs::kVersion2});
    allow(widget, "nothing is known of the robot yet");
    return widget;
  }

  /// Shows something that may need more room than the page has.
  QScrollArea* makeScrollArea(QWidget* content) {
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setWidget(content);
    content->setAutoFillBackground(false);  // the page's background
    area->viewport()->setAutoFillBackground(false);
    return area;
  }

  /// Makes a widget for all that the page has. It scrolls where it needs more room.
  QWidget* makeScrolledContent() {
    auto* content = new QWidget;
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->addWidget(makeScrollArea(content));
    return content;
  }

  QPushButton* makeButton(Needs needs, const QString& text, const QString& tip, const std::function<void()>& clicked) {
    auto* button = new QPushButton(text, this);
    button->setObjectName(text);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, clicked);
    return need(needs, button);
  }

 private:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    Q_EMIT visibilityChanged();
  }
  void hideEvent(QHideEvent* event) override {
    QWidget::hideEvent(event);
    Q_EMIT visibilityChanged();
  }
  virtual void connectionChanged(const RobotConnection&) {}

  struct Control {
    QWidget* widget;
    bool needs_version_2;
  };
  std::vector<Control> controls_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_PAGE_H
