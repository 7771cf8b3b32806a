/// @file command_outbox.h
#ifndef AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
#define AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H

#include <chrono>
#include <deque>
#include <vector>

#include "aibo_driver/joints.h"

namespace aibo_driver {

/// Joints that are told together where to go.
struct JointCommand {
  std::chrono::milliseconds duration{0};
  std::vector<JointTarget> targets;
  std::chrono::steady_clock::time_point since{};  ///< it waits to be sent, see JointCommands::append()
};

/// Where the joints have been told to go and what has not been sent yet. As with LatestById each joint is there once,
/// with its latest target, which takes the place in the queue that an older one had; and joints that were told together
/// stay together.
class JointCommands {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  void add(const JointCommand& command);

  /// Adds what came later, and waits from now on.
  void append(const JointCommands& newer, TimePoint now);

  /// Drops the commands that wait since an earlier time.
  /// @return false if there are none
  bool dropOlderThan(TimePoint time);

  bool empty() const { return commands_.empty(); }

  /// Takes the oldest command. There has to be one.
  JointCommand takeCommand();

  /// Takes the target of one joint: of the one with the next higher id, or else with the lowest. There has to be one.
  JointTarget takeTargetAfter(int id);

 private:
  std::deque<JointCommand> commands_;  // none without targets
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
