/// @file command_outbox.h
/// Commands to the body that have not been sent yet. If they come faster than the robot answers, each part of the body
/// gets only the latest command. So the outbox stays small, and no command waits for ever.
#ifndef AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
#define AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/orders.h"
#include "aibo_client/parts.h"
#include "aibo_client/walk.h"

namespace aibo_client {

/// Targets of several joints that belong together.
struct JointCommand {
  std::chrono::milliseconds duration{0};
  std::vector<JointTarget> targets;
  OrderTerms terms{};
  bool has_begun = false;  ///< version 1: one of its targets has been sent
};

/// True if this is a joint of a leg. A walk takes all joints of the legs.
bool isOfLeg(int joint);

/// A command to an ear.
struct EarCommand {
  static constexpr int kLeft = 1;   ///< RCServer identifier
  static constexpr int kRight = 2;  ///< RCServer identifier

  int id = 0;
  bool drawn = false;  ///< true: draw the ear; false: release it
};

/// Commands to parts of the body. Only the latest command to each part is kept, in the place of the first one that
/// waited.
/// @tparam Item has an `id`
template <typename Item>
class LatestById {
 public:
  bool empty() const { return items_.empty(); }

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

  /// Removes and returns the oldest items, at most `most` of them.
  std::vector<Item> take(std::size_t most) {
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(std::min(most, items_.size()));
    std::vector<Item> taken(items_.begin(), end);
    items_.erase(items_.begin(), end);
    return taken;
  }

 private:
  std::vector<Item> items_;
};

/// Commands to joints. Targets that were commanded together stay together.
class JointCommands {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Adds a command.
  /// @return the older targets of its joints, which it has replaced, as from takeJoints()
  std::vector<JointCommand> add(JointCommand command);

  /// Removes and returns the commands whose time has passed.
  std::vector<JointCommand> takeTooOld(TimePoint now);

  /// Removes and returns the targets of those joints for which the condition is true. They have no number if the rest
  /// of their order goes on.
  std::vector<JointCommand> takeJoints(const std::function<bool(int id)>& condition);

  bool empty() const { return commands_.empty(); }

  /// True if a target of this order waits.
  /// @param order OrderTerms::number
  bool has(std::uint64_t order) const;

  /// Removes and returns the oldest command. There must be one.
  JointCommand takeCommand();

  /// Removes one target from a command and returns it as a command. The target is that of the joint with the next
  /// higher id, or else with the lowest. There must be a target. The rest of the command may wait for kLongestOrderWait
  /// from now on, so that the command is carried out as a whole.
  JointCommand takeTargetAfter(int id, TimePoint now);

 private:
  template <typename Condition>
  std::vector<JointCommand> take(const Condition& condition);

  std::deque<JointCommand> commands_;  // each has a target
};

/// A velocity to walk with.
struct SteeringCommand {
  WalkVelocity velocity;
  OrderTerms terms{};
  int options = 0;  ///< bits of protocol::version2::SteeringOption
};

/// All commands that wait to be sent.
struct CommandOutbox {
  /// Reports that an order was dropped.
  using Refuse = std::function<void(const Refusal& refusal)>;

  explicit CommandOutbox(Refuse on_dropped) : refuse(std::move(on_dropped)) {}

  const Refuse refuse;
  LatestById<JointSpeedLimit> speed_limits;
  JointCommands joints;
  std::optional<SteeringCommand> let_go;    ///< a velocity of 0; only what stops the robot is sent before it
  std::optional<SteeringCommand> steering;  ///< the newest velocity that is not 0
  LatestById<LedCommand> leds;
  LatestById<EarCommand> ears;

  /// True if no command waits that version 1 can express.
  bool isEmptyForVersion1() const { return speed_limits.empty() && joints.empty() && leds.empty() && ears.empty(); }

  /// Adds a command to joints. If it moves a leg, a walk that waits is dropped.
  void command(JointCommand newer);

  /// Adds a velocity, which replaces those that wait. But a velocity of 0 that waits is replaced only by another one.
  /// Commands to the legs that wait are dropped, unless this velocity is 0.
  void steer(const SteeringCommand& newer);

  /// Drops the commands to these joints.
  /// @param ids empty means all joints
  /// @param reason the reason in words, without a full stop
  void stopJoints(const std::vector<int>& ids, const std::string& reason);

  /// Drops the velocity to walk with.
  /// @param with_zero true: also drop a velocity of 0, because a request that ends the walk is sent before it
  void stopWalk(bool with_zero, const std::string& reason);

  /// Drops all commands that are too old to be sent now.
  void dropTooOld(JointCommands::TimePoint now, const std::string& reason);

 private:
  void drop(const std::vector<JointCommand>& commands, RefusalCause cause, const std::string& reason);
  void drop(std::optional<SteeringCommand>* velocity, RefusalCause cause, const std::string& reason);
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_COMMAND_OUTBOX_H
