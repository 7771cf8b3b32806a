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
  using CountOf = aibo_client::Counter aibo_client::ClientStatistics::*;

  /// How much a count of the client has grown between the last two calls of publish().
  std::uint64_t grown(CountOf count) const { return client_.*count - before_.*count; }

  double ratePerSecond(CountOf count) const { return static_cast<double>(grown(count)) / seconds_; }

  void reportConnection(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportStream(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportTransport(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarizeStream(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportJoints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportWhatCannotMove(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportSound(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportPower(diagnostic_updater::DiagnosticStatusWrapper& status);

  Sources sources_;
  // What is reported: the time between the last two calls of publish().
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now();
  double seconds_ = 1;
  aibo_client::ClientStatistics before_;
  aibo_client::ClientStatistics client_;
  std::uint64_t undecodable_before_ = 0;
  std::uint64_t undecodable_ = 0;
  camera::LinkMeter::Reading stream_;
  double asked_rate_ = 0;
  robot_time::RobotClock::Reading delay_;

  ros::Publisher topic_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;  ///< a pointer, because its header takes long to compile
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_DRIVER_DIAGNOSTICS_H
