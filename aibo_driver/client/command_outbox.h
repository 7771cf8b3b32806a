/// @file command_outbox.h
/// Commands to the body that have not been sent yet. If they come faster than the robot answers, each part of the body
/// gets only the latest one, so the outbox stays small, and nothing waits for ever.
#ifndef AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
#define AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/joints.h"
#include "aibo_driver/leds.h"
#include "aibo_driver/orders.h"
#include "aibo_driver/walk.h"

namespace aibo_driver {

/// Targets of joints that go together.
struct JointCommand {
  std::chrono::milliseconds duration{0};
  std::vector<JointTarget> targets;
  OrderTerms terms{};
};

/// True if this is a joint of a leg. A walk takes them all.
bool isOfLeg(int joint);

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

  /// Takes the commands whose time has passed.
  std::vector<JointCommand> takeTooOld(TimePoint now);

  /// When the next command's time passes; TimePoint::max() if there is none.
  TimePoint nextTooOld() const;

  /// Takes what the joints were commanded that the condition holds for.
  std::vector<JointCommand> takeJoints(const std::function<bool(int id)>& condition);

  bool empty() const { return commands_.empty(); }

  /// Takes the oldest command. There has to be one.
  JointCommand takeCommand();

  /// Takes a command with one of its targets: that of the joint with the next higher id, or else with the lowest. There
  /// has to be one. What remains of the command may wait for kLongestOrderWait from now on, so that it is carried out
  /// as a whole.
  JointCommand takeTargetAfter(int id, TimePoint now);

 private:
  std::deque<JointCommand> commands_;  // none without targets
};

/// The newest velocity to walk with.
struct SteeringCommand {
  WalkVelocity velocity;
  OrderTerms terms{};
};

/// All commands that wait.
struct CommandOutbox {
  LatestById<JointSpeedLimit> speed_limits;
  JointCommands joints;
  std::optional<SteeringCommand> steering;
  LatestById<LedCommand> leds;
  LatestById<EarCommand> ears;
  std::vector<Refusal> dropped;  ///< that nobody has been told of yet

  bool empty() const { return speed_limits.empty() && joints.empty() && !steering && leds.empty() && ears.empty(); }

  /// Adds newer commands.
  void append(CommandOutbox newer);

  /// Adds a command to joints. If it moves a leg, a walk that waits is dropped.
  void command(JointCommand newer);

  /// Adds a velocity. Unless it is 0, commands to the legs that wait are dropped.
  void steer(const SteeringCommand& newer);

  /// Drops what these joints were commanded.
  /// @param ids none = all joints
  /// @param reason in words, without a full stop
  void stopJoints(const std::vector<int>& ids, const std::string& reason);

  /// Drops the velocity to walk with.
  void stopWalk(const std::string& reason) { dropSteering(RefusalCause::kStopped, reason); }

  /// Drops what has waited for too long.
  /// @param address of the robot, for the reason
  void dropTooOld(JointCommands::TimePoint now, const std::string& address);

  /// When dropTooOld() has something to drop next; TimePoint::max() if nothing waits.
  JointCommands::TimePoint nextTooOld() const;

 private:
  void drop(const std::vector<JointCommand>& commands, RefusalCause cause, const std::string& reason);
  void dropSteering(RefusalCause cause, const std::string& reason);
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
