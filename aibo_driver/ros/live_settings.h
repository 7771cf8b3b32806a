/// @file live_settings.h
#ifndef AIBO_DRIVER_ROS_LIVE_SETTINGS_H
#define AIBO_DRIVER_ROS_LIVE_SETTINGS_H

#include <aibo_driver/AiboDriverConfig.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>

#include "ros/driver_parameters.h"

namespace aibo_driver::node {

/// What can be changed while the driver runs, by dynamic_reconfigure: see cfg/AiboDriver.cfg. It begins with what the
/// parameters of these names say. What is out of range is set to the nearest value in it; the answer, the topic
/// parameter_updates, the parameters and the log tell what is in force.
class LiveSettings {
 public:
  /// Where the settings go. Called from private_handle's callback queue; must not block.
  struct Targets {
    std::function<void(int)> set_jpeg_quality;
    std::function<void(int)> set_telemetry_period;  ///< in OPEN-R frames; 0: none
    std::function<void(double)> set_speed_scale;
  };

  /// Calls each target at once.
  LiveSettings(const ros::NodeHandle& private_handle, Targets targets);

  /// Of joint_states and the sensors, in OPEN-R frames; 0: none. From any thread.
  int telemetryPeriod() const { return telemetry_period_; }

 private:
  void apply(AiboDriverConfig& config);

  const Targets targets_;
  std::atomic<int> telemetry_period_{0};
  AiboDriverConfig in_force_;
  dynamic_reconfigure::Server<AiboDriverConfig> server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_LIVE_SETTINGS_H
