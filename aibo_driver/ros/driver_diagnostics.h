/// @file driver_diagnostics.h
#ifndef AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H
#define AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "robot_time/robot_clock.h"
#include "ros/body/power_status.h"
#include "ros/camera/raw_image_publisher.h"
#include "ros/camera/stream_adapter.h"
#include "ros/camera/stream_meter.h"
#include "ros/camera/stream_policy.h"
#include "ros/driver_parameters.h"
#include "ros/live_settings.h"

namespace aibo_driver::node {

/// Publishes /diagnostics once a second of wall time, whether or not pictures come: one status each for the connection,
/// the stream, the joints and the power. A stream that is off, or that no subscriber demands, is not a fault.
class DriverDiagnostics {
 public:
  /// What the diagnostics report; all of it must outlive them.
  struct Sources {
    const DriverParameters& parameters;
    const RcServerClient& client;
    const StreamPolicy& policy;
    const StreamAdapter& adapter;
    StreamMeter& meter;
    const RawImagePublisher& raw_images;
    const LiveSettings& settings;
    robot_time::RobotClock& robot_clock;
    const PowerStatus& power;
  };

  /// @param name of the node or nodelet, with its namespace
  DriverDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name,
                    const Sources& sources);

 private:
  void reportConnection(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportStream(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportTransport(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarizeStream(const StreamMeter::Reading& reading, double asked_rate, std::uint64_t newly_damaged,
                       diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportJoints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportPower(diagnostic_updater::DiagnosticStatusWrapper& status);

  Sources sources_;
  std::uint64_t reported_damaged_ = 0;
  std::uint64_t reported_telemetry_ = 0;
  std::uint64_t reported_impossible_ = 0;
  std::uint64_t reported_thinned_ = 0;
  std::chrono::steady_clock::time_point telemetry_reported_at_ = std::chrono::steady_clock::now();
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H
