/// @file color_intake.h
#ifndef AIBO_DRIVER_CLIENT_COLOR_INTAKE_H
#define AIBO_DRIVER_CLIENT_COLOR_INTAKE_H

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "aibo_client/colors.h"
#include "client/notifier.h"

namespace aibo_client {

/// The tables of the colour detection, by channel. A channel without a table is null.
using ColorTables = std::array<ColorTablePtr, kMostColorChannels>;

/// Checks and delivers the colours that were detected over one connection. It does not trust the robot: it delivers
/// only what is possible, and only the newest of what has come at once. What is impossible is counted, and logged once.
class ColorIntake {
 public:
  /// @param context must outlive the object
  explicit ColorIntake(const ConnectionContext& context) : context_(context) {}

  /// Call this with each request to the robot.
  void askedFor(const ColorDetection& detection) { detection_ = detection; }
  const ColorDetection& detection() const { return detection_; }

  /// Parses a message that the robot sent without a request.
  /// @param payload, size the payload of the frame
  /// @param tables the robot's tables: regions get their names, and regions of other channels are left out
  /// @param arrival when the first byte was read
  /// @throw ProtocolException no server of this version sends this
  void receive(const unsigned char* payload, std::size_t size, const ColorTables& tables,
               std::chrono::steady_clock::time_point arrival);

  /// Delivers the newest message, unless it has been delivered. Older messages that came with it are dropped.
  void deliver();

 private:
  void dropImpossible(DetectedColors* colors);
  void complain(const std::string& problem);

  const ConnectionContext& context_;
  ColorDetection detection_;
  std::optional<DetectedColors> newest_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_COLOR_INTAKE_H
