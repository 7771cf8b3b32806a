/// @file power_status.h
#ifndef AIBO_DRIVER_ROS_BODY_POWER_STATUS_H
#define AIBO_DRIVER_ROS_BODY_POWER_STATUS_H

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <mutex>
#include <optional>

#include "aibo_driver/telemetry.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {

/// What the robot last told of its battery, and what that means to who has to look after it. From any thread.
class PowerStatus {
 public:
  /// Full is 1. The first leaves time to end what one is doing, the second to carry the robot to its station.
  static constexpr double kLowCharge = 0.20;
  static constexpr double kEmptyCharge = 0.10;

  /// Degree Celsius. The robot tells no limit; lithium-ion cells are commonly made for up to 60 when they discharge.
  static constexpr double kWarm = 50;
  static constexpr double kHot = 60;

  /// @param model must outlive the object
  explicit PowerStatus(const robot_model::RobotModel& model) : model_(model) {}

  void update(const Telemetry& telemetry);

  /// Forgets what was told, as when the connection is lost.
  void clear();

  /// @param asked is the robot connected and asked for what it measures: then it is a fault if it tells nothing
  void report(bool asked, diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  const robot_model::RobotModel& model_;
  mutable std::mutex mutex_;
  std::optional<double> charge_;
  std::optional<double> temperature_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_POWER_STATUS_H
