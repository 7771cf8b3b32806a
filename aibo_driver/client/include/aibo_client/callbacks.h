/// @file callbacks.h
#ifndef AIBO_CLIENT_CALLBACKS_H
#define AIBO_CLIENT_CALLBACKS_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "aibo_client/camera.h"
#include "aibo_client/colors.h"
#include "aibo_client/orders.h"
#include "aibo_client/parts.h"
#include "aibo_client/sound.h"
#include "aibo_client/status.h"
#include "aibo_client/telemetry.h"
#include "aibo_client/walk.h"

namespace aibo_client {

enum class LogLevel { kDebug, kInfo, kWarn, kError };

/// Receives one line. The library itself prints nothing. Its threads call this function, so it must be thread-safe and
/// must not block.
using LogSink = std::function<void(LogLevel level, const std::string& message)>;

/// The functions that the client calls. Any of them may be empty.
///
/// The client's thread calls them, one at a time. They must not block, and must not call stop() or a function that
/// waits for the robot (those with a timeout, except begin...()): while a callback runs, nothing is read from the
/// robot. An exception from a callback is logged. The rules of `log` are those of LogSink.
///
/// @code
/// aibo_client::Callbacks callbacks;
/// callbacks.on_telemetry = [battery = aibo_client::idOfSensor("battery")](const aibo_client::Telemetry& telemetry) {
///   for (const aibo_client::SensorReading& sensor : telemetry.sensors) {
///     if (sensor.id == battery) {
///       std::cout << 100 * sensor.value << " %\n";
///     }
///   }
/// };
/// aibo_client::RcServerClient robot(options, callbacks);
/// robot.setTelemetryPeriod(125);  // once a second
/// robot.start();
/// @endcode
struct Callbacks {
  /// A good picture, either of the stream or taken by takePicture(). The exception is a picture of takePicture() whose
  /// resolution differs from that of the running stream.
  std::function<void(const PicturePtr& picture)> on_picture;
  /// status() has changed.
  std::function<void(const ConnectionStatus& status)> on_status;
  /// streaming() has changed.
  std::function<void(bool streaming)> on_streaming;
  /// Measurements of the robot, in order. If several have arrived together, for example after an outage of the radio,
  /// this is called for each of them. Telemetry that comes more than twice as often as requested is dropped. Values
  /// that no joint or sensor of this robot can have are dropped, too.
  std::function<void(const Telemetry& telemetry)> on_telemetry;
  /// The targets that the robot has accepted for joints, clamped to their limits.
  std::function<void(const std::vector<JointTarget>& targets)> on_joints_accepted;
  /// The LEDs that the robot has accepted, each of them once. An LED that is only on or off has intensity 0 or 255 if
  /// the server says so; version 1 servers do not always say so. With version 1 the mode is not known; it is A here.
  std::function<void(const std::vector<LedCommand>& leds)> on_leds_accepted;
  /// The robot has accepted a velocity to walk with.
  /// @param in_force the velocity, within the robot's limits
  /// @param order the OrderTerms::number of the order that asked for it
  /// @param walk the walk that goes on: the OrderTerms::number of the order that began it; 0 if there is no walk. If it
  ///   equals `order`, this order has begun the walk. Otherwise this order has ended
  std::function<void(const WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk)> on_steered;
  /// An order has ended. Each order with an OrderTerms::number ends once: by on_refused if the robot has not begun it,
  /// otherwise by this callback. Velocities end as on_steered says. When the connection ends, all orders end with it,
  /// and nothing is called. Ends that a request causes are reported before the request's own answer.
  std::function<void(const ActivityEnd& end)> on_ended;
  /// A request was refused or dropped. This is not called for a request without an OrderTerms::number that a newer one
  /// replaces before it is sent.
  std::function<void(const Refusal& refusal)> on_refused;
  /// A version 2 server says that the motors or the posture have changed. This is also called soon after the connection
  /// is made and, with everything unknown, when a connection ends.
  std::function<void(const MotorsAndPosture& state)> on_motors_and_posture;
  /// The colours that the robot's camera has detected in an image. If several have arrived together, only the newest
  /// counts. Regions that contradict themselves are dropped.
  std::function<void(const DetectedColors& colors)> on_colors;
  /// What the robot has heard, in order. If more than twice as much comes as requested, the rest is dropped.
  std::function<void(const HeardSound& sound)> on_heard;
  /// A sound that the robot had begun to play has ended. This is called once for each of them.
  std::function<void(const SoundEnd& end)> on_sound_ended;
  LogSink log;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_CALLBACKS_H
