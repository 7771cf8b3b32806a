/// @file driver_diagnostics.h
#ifndef AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H
#define AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H

#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "movement/mover.h"
#include "robot_time/robot_clock.h"
#include "ros/body/power_status.h"
#include "ros/camera/raw_image_publisher.h"
#include "ros/camera/stream_adapter.h"
#include "ros/camera/stream_meter.h"
#include "ros/camera/stream_policy.h"
#include "ros/driver_parameters.h"
#include "ros/live_settings.h"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
class Updater;
}  // namespace diagnostic_updater

namespace aibo_driver::node {

/// Publishes /diagnostics, whether or not pictures come: one status each for the connection, the stream, the joints and
/// the power. They are made only if somebody listens. A stream that is off, or that no subscriber demands, is not a
/// fault.
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
    const movement::Mover& mover;
  };

  /// @param name of the node or nodelet, with its namespace
  DriverDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name,
                    const Sources& sources);

  ~DriverDiagnostics();

  /// To be called once a second of wall time, from one thread at a time.
  void publish();

 private:
  /// What happened since the last call of publish().
  struct Period {
    double asked_rate = 0;  ///< pictures a second, at its end
    StreamMeter::Reading stream;
    robot_time::RobotClock::Reading delay;
    std::uint64_t damaged = 0;  ///< pictures
    double measurement_rate = 0;
    std::uint64_t impossible = 0;  ///< values
    std::uint64_t thinned = 0;     ///< measurements
  };

  Period takePeriod();
  void reportConnection(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportStream(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportTransport(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarizeStream(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportJoints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportWhatCannotMove(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportPower(diagnostic_updater::DiagnosticStatusWrapper& status);

  Sources sources_;
  std::chrono::steady_clock::time_point period_began_ = std::chrono::steady_clock::now();
  ClientStatistics client_before_;  ///< at that time
  std::uint64_t undecodable_before_ = 0;
  Period period_;  ///< that is reported
  ros::Publisher topic_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;  ///< its header takes long to compile
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_DRIVER_DIAGNOSTICS_H
