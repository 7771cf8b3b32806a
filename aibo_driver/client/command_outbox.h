/// @file command_outbox.h
/// Commands to the body that have not been sent yet. If they come faster than the robot answers, each part of the body
/// gets only the latest one, so the outbox stays small, and nothing waits for ever.
#ifndef AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
#define AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"
#include "aibo_driver/walk.h"

namespace aibo_driver {

/// Targets of joints that go together.
struct JointCommand {
  std::chrono::milliseconds duration{0};
  std::vector<JointTarget> targets;
  std::chrono::steady_clock::time_point since{};  ///< when it began to wait, see JointCommands::append()
};

/// What an ear is to do.
struct EarCommand {
  static constexpr int kLeft = 1;   ///< RCServer identifier
  static constexpr int kRight = 2;  ///< RCServer identifier

  int id = 0;
  bool drawn = false;  ///< else let go
};

/// Commands to parts of the body: one for each part, the latest, in the place of the first one that waited.
/// @tparam Item has an `id`
template <typename Item>
class LatestById {
 public:
  bool empty() const { return items_.empty(); }

  /// From the oldest on.
  const std::vector<Item>& items() const { return items_; }

  void add(const std::vector<Item>& newer) {
    for (const Item& item : newer) {
      const auto older =
          std::find_if(items_.begin(), items_.end(), [&item](const Item& each) { return each.id == item.id; });
      if (older == items_.end()) {
        items_.push_back(item);
      } else {
        *older = item;
      }
    }
  }

  /// Takes the oldest items, at most `most` of them.
  std::vector<Item> take(std::size_t most) {
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(std::min(most, items_.size()));
    std::vector<Item> taken(items_.begin(), end);
    items_.erase(items_.begin(), end);
    return taken;
  }

 private:
  std::vector<Item> items_;
};

/// The same for joints. Joints that were commanded together stay together.
class JointCommands {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  void add(JointCommand command);

  /// Adds newer commands, which begin to wait now.
  void append(JointCommands newer, TimePoint now);

  /// Drops the commands that began to wait before this time.
  /// @return false if there were none
  bool dropOlderThan(TimePoint time);

  /// Drops what these joints were commanded.
  /// @param ids none = all joints
  void drop(const std::vector<int>& ids);

  bool empty() const { return commands_.empty(); }
  void clear() { commands_.clear(); }

  /// Takes the oldest command. There has to be one.
  JointCommand takeCommand();

  /// Takes the target of one joint: the joint with the next higher id, or else with the lowest. There has to be one.
  JointTarget takeTargetAfter(int id);

 private:
  std::deque<JointCommand> commands_;  // none without targets
};

/// The newest velocity to walk with.
struct SteeringCommand {
  WalkVelocity velocity;
  std::chrono::steady_clock::time_point since{};  ///< when it began to wait, see CommandOutbox::append()
};

/// All commands that wait.
struct CommandOutbox {
  LatestById<JointSpeedLimit> speed_limits;
  JointCommands joints;
  std::optional<SteeringCommand> steering;
  LatestById<LedCommand> leds;
  LatestById<EarCommand> ears;

  bool empty() const { return speed_limits.empty() && joints.empty() && !steering && leds.empty() && ears.empty(); }

  /// Adds newer commands, which begin to wait now.
  void append(CommandOutbox newer, JointCommands::TimePoint now);
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
