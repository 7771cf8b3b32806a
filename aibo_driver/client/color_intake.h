/// @file color_intake.h
#ifndef AIBO_DRIVER_CLIENT_COLOR_INTAKE_H
#define AIBO_DRIVER_CLIENT_COLOR_INTAKE_H

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "aibo_driver/colors.h"
#include "client/rate_limit.h"

namespace aibo_driver {

struct ConnectionContext;

/// The tables of the colour detection, by channel; null: the channel has none.
using ColorTables = std::array<ColorTablePtr, kMostColorChannels>;

/// What was detected over one connection. It gives the client's user what is possible, and no more of it than was asked
/// for: the robot is not believed. What is dropped is counted, and logged once.
class ColorIntake {
 public:
  /// @param context must outlive the object
  explicit ColorIntake(const ConnectionContext& context) : context_(context) {}

  /// What the robot was asked for last. In the long run, at most twice as much is delivered.
  void askedFor(const ColorDetection& detection);
  const ColorDetection& detection() const { return detection_; }

  /// Takes apart a push of the robot.
  /// @param payload, size of the frame
  /// @param tables that the robot has: regions get their names, and those of other channels are left out
  /// @param arrival when the first byte was read
  /// @throw ProtocolException no server of this version sends that
  void receive(const unsigned char* payload, std::size_t size, const ColorTables& tables,
               std::chrono::steady_clock::time_point arrival);

  /// Delivers what was received last, unless it has been delivered: of several that came together, the newest counts.
  void deliver();

 private:
  void dropImpossible(DetectedColors* colors);
  void complain(const std::string& problem);

  const ConnectionContext& context_;
  ColorDetection detection_;
  RateLimit limit_{16};
  std::optional<DetectedColors> newest_;
  bool thinning_is_logged_ = false;
  bool impossible_is_logged_ = false;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_COLOR_INTAKE_H
