/// @file battery.h
/// The simulated robot's battery.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H

#include <OPENR/OPower.h>

namespace simulated_ers7 {

/// Discharges at a constant rate and warms up slowly. An empty battery has no effect, because the objects should shut
/// the robot down earlier. Sony's battery holds 2200 mAh at 7.4 V. Temperatures and times are our choice.
class Battery {
 public:
  static constexpr int kCapacity = 2200;           ///< mAh
  static constexpr double kFirstTemperature = 25;  ///< degree Celsius
  static constexpr double kLastTemperature = 38;   ///< the final temperature
  static constexpr double kSecondsToWarmUp = 600;  ///< the time constant
  static constexpr double kLowCharge = 0.1;        ///< at and below this charge, the status reports a low battery

  /// The battery is full at first.
  /// @param minutes the time until the battery is empty, above 0
  explicit Battery(double minutes) : minutes_(minutes) {}

  /// Call this after each frame of 8 ms.
  void passFrame();

  /// @param charge 0..1
  void setCharge(double charge) { charge_ = charge; }
  double charge() const { return charge_; }

  /// The temperature in degrees Celsius.
  double temperature() const { return temperature_; }

  /// The battery's part of OPENR::GetPowerStatus(), without the motors' bit.
  OPowerStatus status() const;

 private:
  double minutes_;
  double charge_ = 1;
  double temperature_ = kFirstTemperature;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H
