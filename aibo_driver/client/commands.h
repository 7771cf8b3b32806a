/// @file commands.h
#ifndef AIBO_DRIVER_CLIENT_COMMANDS_H
#define AIBO_DRIVER_CLIENT_COMMANDS_H

#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"
#include "client/command_outbox.h"
#include "client/latest_by_id.h"

namespace aibo_driver {

/// What an ear is to do.
struct EarCommand {
  static constexpr int kLeft = 1;   ///< RCServer identifier
  static constexpr int kRight = 2;  ///< RCServer identifier

  int id = 0;
  bool drawn = false;  ///< else let go
};

/// What the body has been told and has not been sent yet.
struct Commands {
  LatestById<JointSpeedLimit> speed_limits;
  JointCommands joints;
  LatestById<LedCommand> leds;
  LatestById<EarCommand> ears;

  bool empty() const { return speed_limits.empty() && joints.empty() && leds.empty() && ears.empty(); }

  void add(const JointCommand& command) { joints.add(command); }
  void add(const std::vector<JointSpeedLimit>& limits) { speed_limits.add(limits); }
  void add(const std::vector<LedCommand>& commands) { leds.add(commands); }
  void add(const std::vector<EarCommand>& commands) { ears.add(commands); }

  /// Adds what came later.
  void append(const Commands& newer, JointCommands::TimePoint now) {
    speed_limits.add(newer.speed_limits.items());
    joints.append(newer.joints, now);
    leds.add(newer.leds.items());
    ears.add(newer.ears.items());
  }
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_COMMANDS_H
