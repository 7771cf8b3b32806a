/// @file battery.h
/// The simulated robot's battery.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H

#include <OPENR/OPower.h>

namespace simulated_ers7 {

/// Runs down evenly, whatever the robot does, and warms up slowly. An empty one goes on as it is: it is for the objects
/// to shut the robot down before. Sony's battery holds 2200 mAh at 7.4 V; temperatures and times are our choice.
class Battery {
 public:
  static constexpr int kCapacity = 2200;           ///< mAh
  static constexpr double kFirstTemperature = 25;  ///< degree Celsius
  static constexpr double kLastTemperature = 38;   ///< what it comes to in the end
  static constexpr double kSecondsToWarmUp = 600;  ///< until two thirds of that way
  static constexpr double kLowCharge = 0.1;        ///< from here down the robot says so

  /// Full.
  /// @param minutes until it is empty, above 0
  explicit Battery(double minutes) : minutes_(minutes) {}

  /// 8 ms pass.
  void passFrame();

  /// @param charge 0..1; from there on it runs down as before
  void setCharge(double charge) { charge_ = charge; }
  double charge() const { return charge_; }

  /// In degree Celsius.
  double temperature() const { return temperature_; }

  /// All that OPENR::GetPowerStatus() tells of a battery. Motors have no power in it.
  OPowerStatus status() const;

 private:
  double minutes_;
  double charge_ = 1;
  double temperature_ = kFirstTemperature;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_BATTERY_H
