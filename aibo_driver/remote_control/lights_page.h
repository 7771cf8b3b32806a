/// @file lights_page.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_LIGHTS_PAGE_H
#define AIBO_DRIVER_REMOTE_CONTROL_LIGHTS_PAGE_H

#include <QSlider>
#include <map>

#include "remote_control/page.h"

namespace aibo_driver::remote_control {

/// Controls the LEDs, singly, by groups and by patterns of the face, and the ears. It shows how the LEDs shine, as far
/// as the driver reports it.
class LightsPage : public Page {
  Q_OBJECT

 public:
  /// @param robot must outlive the page
  explicit LightsPage(Robot& robot, QWidget* parent = nullptr);

 private:
  QWidget* makeFace();
  QWidget* makeGroups();
  QWidget* makeEars();
  QPushButton* makeLed(const QString& name, const QString& label);
  void showLeds(const LedIntensities& intensities);
  double intensity() const;

  Robot& robot_;
  QSlider* intensity_;
  LedIntensities shown_;
  std::map<QString, QPushButton*> leds_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_LIGHTS_PAGE_H
