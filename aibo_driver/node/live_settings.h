/// @file live_settings.h
#ifndef AIBO_DRIVER_NODE_LIVE_SETTINGS_H
#define AIBO_DRIVER_NODE_LIVE_SETTINGS_H

#include <aibo_driver/AiboDriverConfig.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <atomic>

#include "aibo_client/rcserver_client.h"
#include "camera/stream_adapter.h"
#include "movement/joint_table.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// The settings that can be changed while the driver runs, with dynamic_reconfigure: see cfg/AiboDriver.cfg. At first
/// they have the values of the parameters with the same names. A value out of range is replaced by the nearest value in
/// range. The answer, the topic parameter_updates, the parameters and the log all show the values in force.
class LiveSettings {
 public:
  /// Applies the settings at once, and again from private_handle's callback queue whenever they change.
  /// @param client, adapter, joint_table must outlive the object
  LiveSettings(const ros::NodeHandle& private_handle, aibo_client::RcServerClient& client,
               camera::StreamAdapter& adapter, movement::JointTable& joint_table);

  /// The period of joint_states and the sensors, in OPEN-R frames; 0 means none. Any thread may call it.
  int telemetryPeriod() const { return telemetry_period_; }

 private:
  void apply(AiboDriverConfig& config);
  void applyToCamera(AiboDriverConfig& config);

  aibo_client::RcServerClient& client_;
  camera::StreamAdapter& adapter_;
  movement::JointTable& joint_table_;
  std::atomic<int> telemetry_period_{0};
  text::ThrottledWarnings warnings_;
  text::ThrottledWarnings in_force_log_;
  AiboDriverConfig in_force_;
  dynamic_reconfigure::Server<AiboDriverConfig> server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_LIVE_SETTINGS_H
