/// @file movement.h
/// What moves a robot, who asked for it, and how it ended.
#ifndef AIBO_DRIVER_MOVEMENT_MOVEMENT_H
#define AIBO_DRIVER_MOVEMENT_MOVEMENT_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/orders.h"

namespace aibo_driver::movement {

using SteadyTime = std::chrono::steady_clock::time_point;

/// Who asks for something, and since when.
struct Order {
  std::string source;   ///< the node that asks
  SteadyTime received;  ///< when its message or call came
};

/// What moves a robot, or has moved it.
struct Movement {
  /// The numbers are those of aibo_msgs/Movement.
  enum class Kind { kCommand = 1, kTrajectory = 2, kMotion = 3, kWalk = 4, kPosture = 5, kLookAt = 6 };

  Kind kind = Kind::kCommand;
  std::string name;                 ///< the name of a motion or posture
  std::string source;               ///< the node that asked for it
  std::vector<std::string> joints;  ///< the joints that it moves; unknown if the robot moves by itself
  std::optional<SteadyTime> end;    ///< when a trajectory that has begun will end
  std::uint64_t order = 0;          ///< the movement's number; no two movements of a driver have the same

  /// Compares only what can change while a movement goes on.
  bool operator==(const Movement& other) const {
    return order == other.order && joints == other.joints && end == other.end;
  }
  bool operator!=(const Movement& other) const { return !(*this == other); }
};

/// A movement that has ended.
struct EndedMovement {
  Movement movement;
  aibo_client::EndedHow how = aibo_client::EndedHow::kDone;
  std::string reason;  ///< in words to put after a colon; empty if the movement is done
};

/// How many joints or LEDs a message may name. A robot has fewer than 50. A search for a million unknown names would
/// keep other orders waiting.
constexpr std::size_t kMostNames = 1000;

/// Says that a message names more than kMostNames, in words to put after a colon; empty if it does not.
std::string describeTooMany(std::size_t names);

/// Lists the first three names, and says how many more there are.
std::string listOf(const std::vector<std::string>& names, const std::string& separator = ", ");

/// Describes a movement in words to put after an article, such as "trajectory of head_pan".
std::string describe(const Movement& movement);

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MOVEMENT_H
