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

namespace aibo_driver::movement {

using SteadyTime = std::chrono::steady_clock::time_point;

/// Who asks for something, and since when.
struct Order {
  std::string source;   ///< the node
  SteadyTime received;  ///< when its message or call came
};

/// How a movement has ended. The numbers are those of aibo_msgs/EndedMovement.
enum class MovementEnd {
  kDone = 0,        ///< its joints are measured where they were sent, or the robot says that it has done it
  kReplaced = 1,    ///< something else moves its joints now
  kStopped = 2,     ///< somebody has stopped it
  kRefused = 3,     ///< it was not begun, or the robot could not go on with it
  kFell = 4,        ///< the robot fell or was lifted
  kUnknown = 5,     ///< it was begun, and nothing says how it ended
  kNotReached = 6,  ///< its time is over, and a joint is not where it was sent
  kLost = 7         ///< the connection broke
};

/// What moves a robot, or has moved it.
struct Movement {
  /// The numbers are those of aibo_msgs/Movement.
  enum class Kind { kCommand = 1, kTrajectory = 2, kMotion = 3, kWalk = 4, kPosture = 5, kLookAt = 6 };

  Kind kind = Kind::kCommand;
  std::string name;                 ///< of a motion or posture
  std::string source;               ///< the node that asked for it
  std::vector<std::string> joints;  ///< that it moves; unknown for what the robot does by itself
  std::optional<SteadyTime> end;    ///< of a trajectory that has begun
};

/// A movement that is over.
struct EndedMovement {
  Movement movement;
  MovementEnd how = MovementEnd::kDone;
  std::string reason;  ///< in words that follow a colon; empty if it is done
};

/// Names in words: the first three, and how many there are besides.
std::string listOf(const std::vector<std::string>& names, const std::string& separator = ", ");

/// In words that begin a sentence, such as "The trajectory of head_pan".
std::string describe(const Movement& movement);

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MOVEMENT_H
