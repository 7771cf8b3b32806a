#include "node/driver_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <initializer_list>
#include <utility>

#include "camera/camera_options.h"
#include "node/connection_message.h"
#include "text/sentence.h"

namespace aibo_driver::node {

using aibo_client::ClientStatistics;
using aibo_client::ConnectionState;
using aibo_client::ConnectionStatus;

namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

// How long the stream has to be slow before it is faulty. A stream that has just begun, or has a short gap, is not.
constexpr double kSlowTime = 2.0;  // seconds

// If pictures are older than this, it is hard to drive a robot by hand.
constexpr double kLate = 0.25;  // seconds

void reportDelay(const robot_time::RobotClock::Reading& reading, DiagnosticStatusWrapper& status) {
  if (reading.mean_delay > kLate) {
    status.mergeSummary(DiagnosticStatus::WARN, "the robot's data is " + text::decimal(1000 * reading.mean_delay, 1) +
                                                    " ms late on average: is the radio link weak, or this computer "
                                                    "busy?");
  }
  status.addf("delay beyond the shortest, mean ms", "%.1f", 1000 * reading.mean_delay);
  status.addf("delay beyond the shortest, longest ms", "%.1f", 1000 * reading.longest_delay);
  status.addf("drift of the robot's clock, ppm", "%.0f", -1e6 * reading.drift);
  status.add("timelines begun", reading.timelines);
}

const char* yesOrNo(bool value) {
  return value ? "yes" : "no";
}

/// Adds counts since the driver's start to a status.
void addAll(std::initializer_list<std::pair<const char*, std::uint64_t>> counts, DiagnosticStatusWrapper& status) {
  for (const auto& [name, count] : counts) {
    status.add(name, count);
  }
}

}  // namespace

DriverDiagnostics::DriverDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                     const std::string& name, const Sources& sources)
    : sources_(sources),
      topic_(ros::NodeHandle(handle).advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)),
      // The parameter diagnostic_period would not change the period, and a driver with one that is too long for a
      // ros::Duration would not start. So the updater looks for the parameter in a namespace where nobody sets it.
      updater_(
          std::make_unique<diagnostic_updater::Updater>(handle, ros::NodeHandle(private_handle, "diagnostics"), name)) {
  updater_->setHardwareID(robotAddress(sources_.parameters.client));
  updater_->add("connection", this, &DriverDiagnostics::reportConnection);
  updater_->add("stream", this, &DriverDiagnostics::reportStream);
  updater_->add("joints", this, &DriverDiagnostics::reportJoints);
  updater_->add("sound", this, &DriverDiagnostics::reportSound);
  updater_->add("power", this, &DriverDiagnostics::reportPower);
}

DriverDiagnostics::~DriverDiagnostics() = default;

// A listener who comes later gets only what happened within the last second, not everything since the start.
void DriverDiagnostics::publish(const camera::LinkMeter::Reading& stream, double asked_rate) {
  const auto now = std::chrono::steady_clock::now();
  seconds_ = std::chrono::duration<double>(now - std::exchange(end_, now)).count();
  before_ = std::exchange(client_, sources_.client.statistics());
  undecodable_before_ = std::exchange(undecodable_, sources_.raw_images.statistics().decode_errors);
  stream_ = stream;
  asked_rate_ = asked_rate;
  delay_ = sources_.robot_clock.read();
  if (topic_.getNumSubscribers() > 0) {
    updater_->force_update();
  }
}

void DriverDiagnostics::reportConnection(DiagnosticStatusWrapper& status) {
  const ConnectionStatus connection = sources_.client.status();
  const bool connected = connection.state == ConnectionState::kConnected;
  // Before the end of the first attempt to connect, nothing has gone wrong.
  const bool failed = !connected && !connection.reason.empty();
  const auto level = connected ? DiagnosticStatus::OK : failed ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
  status.summary(level, describeConnection(connection, sources_.parameters.client));
  status.add("host", sources_.parameters.client.host);
  status.add("port", sources_.parameters.client.port);
  status.add("protocol version", connection.protocol_version);
  status.add("reason", connection.reason);
  status.add("what to check", connection.advice);
  addAll({{"connections made", client_.connections},
          {"attempts failed", client_.failed_attempts},
          {"streams given up for silence", client_.stalls},
          {"protocol errors", client_.protocol_errors},
          {"bytes received", client_.bytes_received}},
         status);
}

void DriverDiagnostics::reportStream(DiagnosticStatusWrapper& status) {
  summarizeStream(status);
  reportDelay(delay_, status);
  reportTransport(status);
  status.add("stream wanted", yesOrNo(sources_.policy.wanted()));
  status.add("streaming", yesOrNo(sources_.client.streaming()));
  status.add("adaptive", sources_.adapter.describe());
  status.add("quality asked for", sources_.client.jpegQuality());
  status.add("pictures per second", text::decimal(stream_.picturesPerSecond(), 1));
  status.add("pictures per second asked for", text::decimal(asked_rate_, 1));
  status.add("KB per second", text::decimal(stream_.kilobytesPerSecond(), 1));
  status.addf("first byte to published, mean ms", "%.2f", 1000.0 * stream_.mean_latency);
  status.addf("first byte to published, longest ms", "%.2f", 1000.0 * stream_.max_latency);
  const RawImagePublisher::Statistics images = sources_.raw_images.statistics();
  addAll({{"pictures received", client_.pictures},
          {"pictures damaged", client_.corrupt_pictures},
          {"pictures nobody asked for", client_.unexpected_pictures},
          {"pictures dropped for newer ones", client_.stale_pictures},
          {"images decoded", images.published},
          {"images not decodable", images.decode_errors},
          {"images dropped for newer ones", images.skipped}},
         status);
}

void DriverDiagnostics::reportTransport(DiagnosticStatusWrapper& status) const {
  const ConnectionStatus connection = sources_.client.status();
  status.add("transport", camera::nameOf(connection.transport));
  status.add("transport wanted", camera::nameOf(connection.wanted_transport));
  status.add("why this transport", camera::transportReason(connection));
  if (client_.datagrams + client_.foreign_datagrams + client_.bad_datagrams == 0) {
    return;
  }
  addAll({{"datagrams received", client_.datagrams},
          {"datagrams lost", client_.lost_datagrams},
          {"datagrams out of order", client_.reordered_datagrams},
          {"datagrams that are no part of a picture", client_.bad_datagrams},
          {"datagrams from strangers", client_.foreign_datagrams},
          {"pictures lost with a datagram", client_.lost_pictures}},
         status);
}

void DriverDiagnostics::summarizeStream(DiagnosticStatusWrapper& status) const {
  const std::uint64_t damaged = grown(&ClientStatistics::corrupt_pictures) + undecodable_ - undecodable_before_;
  if (damaged > 0) {
    status.summary(DiagnosticStatus::WARN, std::to_string(damaged) +
                                               " damaged pictures dropped: does the RCServer on the robot belong to "
                                               "this driver, and is its memory stick in order?");
  } else if (stream_.pictures > 0 && stream_.slow_for > kSlowTime) {
    status.summary(DiagnosticStatus::WARN, "only " + text::decimal(stream_.picturesPerSecond(), 1) + " of " +
                                               text::decimal(asked_rate_, 1) +
                                               " pictures/s: is the radio link weak, or the robot or this computer "
                                               "busy?");
  } else if (stream_.pictures > 0) {
    status.summary(DiagnosticStatus::OK, text::decimal(stream_.picturesPerSecond(), 1) + " pictures/s, " +
                                             text::decimal(stream_.kilobytesPerSecond(), 1) + " KB/s");
  } else if (!sources_.policy.wanted()) {
    status.summary(DiagnosticStatus::OK, "idle: the stream is off (set_streaming turns it on)");
  } else if (sources_.policy.waitsForSubscriber()) {
    status.summary(DiagnosticStatus::OK, "idle: no camera topic has a subscriber");
  } else if (!sources_.client.streaming()) {
    status.summary(DiagnosticStatus::WARN, "no pictures: the robot is not connected");
  } else {
    status.summary(DiagnosticStatus::WARN, "no pictures although the stream is on: does the robot's camera run?");
  }
}

void DriverDiagnostics::reportJoints(DiagnosticStatusWrapper& status) {
  const ConnectionStatus connection = sources_.client.status();
  if (connection.state != ConnectionState::kConnected) {
    status.summary(DiagnosticStatus::WARN, "no joint positions: the robot is not connected");
  } else if (!connection.robot.design.empty() && connection.robot.design != sources_.parameters.robot) {
    status.summary(DiagnosticStatus::ERROR, "commands are refused: the robot says that it is an " +
                                                connection.robot.design + ", but the parameter robot is " +
                                                sources_.parameters.robot);
  } else if (!connection.robot_message.empty()) {
    status.summary(DiagnosticStatus::ERROR, "the robot says: " + connection.robot_message);
  } else if (grown(&ClientStatistics::impossible_values) > 0) {
    status.summary(DiagnosticStatus::WARN, std::to_string(grown(&ClientStatistics::impossible_values)) +
                                               " impossible values dropped: is the joint or sensor that the log names "
                                               "broken, or does the RCServer not belong to this driver?");
  } else if (grown(&ClientStatistics::thinned_telemetry) > 0) {
    status.summary(DiagnosticStatus::WARN, std::to_string(grown(&ClientStatistics::thinned_telemetry)) +
                                               " measurements dropped: the robot sends more than twice as many as it "
                                               "was asked for");
  } else if (sources_.settings.telemetryPeriod() == 0) {
    status.summary(DiagnosticStatus::OK, "idle: telemetry_rate is 0");
  } else if (ratePerSecond(&ClientStatistics::telemetry) > 0) {
    status.summary(DiagnosticStatus::OK,
                   text::decimal(ratePerSecond(&ClientStatistics::telemetry), 1) + " measurements/s");
  } else {
    status.summary(DiagnosticStatus::WARN, "the robot sends no joint positions: does its RCServer support joints?");
  }
  reportWhatCannotMove(status);
  status.add("measurements per second", text::decimal(ratePerSecond(&ClientStatistics::telemetry), 1));
  addAll({{"measurements received", client_.telemetry},
          {"measurements dropped, more than asked for", client_.thinned_telemetry},
          {"impossible values dropped", client_.impossible_values},
          {"requests refused by the robot", client_.refusals}},
         status);
  status.add("robot", connection.robot.design);
  status.add("server", connection.robot.server);
  status.add("said by the robot", connection.robot_message);
}

void DriverDiagnostics::reportWhatCannotMove(DiagnosticStatusWrapper& status) const {
  const movement::Mover::State state = sources_.mover.state();
  if (state.stopped_by) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "stopped by " + *state.stopped_by + ": only rest moves the robot until release is called");
  }
  if (state.robot.motors == aibo_client::MotorState::kOff) {
    status.mergeSummary(DiagnosticStatus::WARN, "the motors are off: call motors, stand or sit to switch them on");
  }
}

void DriverDiagnostics::reportSound(DiagnosticStatusWrapper& status) {
  const bool listens = sources_.microphone.hasSubscribers();
  if (!listens) {
    status.summary(DiagnosticStatus::OK, "idle: microphone has no subscriber");
  } else if (ratePerSecond(&ClientStatistics::sounds) == 0) {
    status.summary(DiagnosticStatus::WARN,
                   "nothing is heard: is the robot connected, and does its RCSERVER.CFG have "
                   "ALLOW_MICROPHONE=yes?");
  } else if (grown(&ClientStatistics::sound_gaps) > 0) {
    status.summary(DiagnosticStatus::WARN, "sound is missing: is the radio link too slow for it?");
  } else {
    status.summary(DiagnosticStatus::OK, "listening");
  }
  status.add("listening", yesOrNo(listens));
  status.add("playing", yesOrNo(sources_.player.isPlaying()));
  status.add("messages per second", text::decimal(ratePerSecond(&ClientStatistics::sounds), 1));
  addAll({{"messages", client_.sounds},
          {"gaps", client_.sound_gaps},
          {"messages dropped, more than asked for", client_.thinned_sounds}},
         status);
}

void DriverDiagnostics::reportPower(DiagnosticStatusWrapper& status) {
  const bool connected = sources_.client.status().state == ConnectionState::kConnected;
  sources_.power.report(connected && sources_.settings.telemetryPeriod() != 0, client_.connections, status);
}

}  // namespace aibo_driver::node
