/// @file power_status.h
#ifndef AIBO_DRIVER_NODE_BODY_POWER_STATUS_H
#define AIBO_DRIVER_NODE_BODY_POWER_STATUS_H

#include <cstdint>
#include <mutex>
#include <optional>

#include "aibo_client/telemetry.h"
#include "robot_model/robot_model.h"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
}

namespace aibo_driver::node {

/// The last state of the battery, and what it means to the person who looks after the robot. Any thread may use it.
class PowerStatus {
 public:
  /// A full battery is 1. At kLowCharge there is time to finish a task. At kEmptyCharge there is time to carry the
  /// robot to its station.
  static constexpr double kLowCharge = 0.20;
  static constexpr double kEmptyCharge = 0.10;

  /// Degrees Celsius. The robot has no limit of its own. It is common to discharge lithium-ion cells at up to 60.
  static constexpr double kWarm = 50;
  static constexpr double kHot = 60;

  /// @param model must outlive the object
  explicit PowerStatus(const robot_model::RobotModel& model) : model_(model) {}

  void update(const aibo_client::Telemetry& telemetry);

  /// @param asked whether the robot is connected and was asked for telemetry; only then is silence a fault
  /// @param connection the number of the present connection; what was measured over an earlier one does not count
  void report(bool asked, std::uint64_t connection, diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  const robot_model::RobotModel& model_;
  mutable std::mutex mutex_;
  std::uint64_t connection_ = 0;  ///< the connection over which the values were measured
  std::optional<double> charge_;
  std::optional<double> temperature_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_POWER_STATUS_H
