/// @file driver_diagnostics.h
#ifndef AIBO_DRIVER_NODE_DRIVER_DIAGNOSTICS_H
#define AIBO_DRIVER_NODE_DRIVER_DIAGNOSTICS_H

#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "aibo_client/rcserver_client.h"
#include "camera/link_meter.h"
#include "camera/stream_adapter.h"
#include "camera/stream_policy.h"
#include "movement/mover.h"
#include "node/body/power_status.h"
#include "node/camera/raw_image_publisher.h"
#include "node/driver_parameters.h"
#include "node/live_settings.h"
#include "node/sound/microphone_publisher.h"
#include "robot_time/robot_clock.h"
#include "sound/player.h"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
class Updater;
}  // namespace diagnostic_updater

namespace aibo_driver::node {

/// Publishes /diagnostics, whether or not pictures come. The connection, the stream, the joints, sound and the power
/// have one status each. The statuses are made only if somebody listens. A stream that is off, or that no subscriber
/// demands, is not a fault.
class DriverDiagnostics {
 public:
  /// The objects that the diagnostics report about. All of them must outlive the diagnostics.
  struct Sources {
    const DriverParameters& parameters;
    const aibo_client::RcServerClient& client;
    const camera::StreamPolicy& policy;
    const camera::StreamAdapter& adapter;
    const RawImagePublisher& raw_images;
    const LiveSettings& settings;
    robot_time::RobotClock& robot_clock;
    const PowerStatus& power;
    const movement::Mover& mover;
    const MicrophonePublisher& microphone;
    const sound::Player& player;
  };

  /// @param name the name of the node or nodelet, with its namespace
  DriverDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name,
                    const Sources& sources);

  ~DriverDiagnostics();

  /// Call this once a second of wall time, from only one thread at a time.
  /// @param stream what was measured since the last call
  /// @param asked_rate the pictures a second that the robot is asked for now; 0 while the stream is off
  void publish(const camera::LinkMeter::Reading& stream, double asked_rate);

 private:
  /// What happened since the last call of publish().
  struct Period {
    double asked_rate = 0;  ///< pictures a second, at the end of the period
    camera::LinkMeter::Reading stream;
    robot_time::RobotClock::Reading delay;
    std::uint64_t damaged = 0;  ///< damaged pictures
    double measurement_rate = 0;
    std::uint64_t impossible = 0;  ///< impossible values
    std::uint64_t thinned = 0;     ///< measurements that were dropped because too many came
    double sound_rate = 0;         ///< pieces of sound a second
    std::uint64_t sound_gaps = 0;
  };

  Period takePeriod(const camera::LinkMeter::Reading& stream, double asked_rate);
  void reportConnection(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportStream(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportTransport(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarizeStream(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportJoints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportWhatCannotMove(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportSound(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportPower(diagnostic_updater::DiagnosticStatusWrapper& status);

  Sources sources_;
  std::chrono::steady_clock::time_point period_began_ = std::chrono::steady_clock::now();
  aibo_client::ClientStatistics client_before_;  ///< the statistics at the last call of publish()
  std::uint64_t undecodable_before_ = 0;
  Period period_;  ///< the period that is being reported
  ros::Publisher topic_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;  ///< a pointer, because its header takes long to compile
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_DRIVER_DIAGNOSTICS_H
