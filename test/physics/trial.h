/// @file trial.h
/// A walk on the bench, and what is wrong with it.
#ifndef TEST_PHYSICS_TRIAL_H
#define TEST_PHYSICS_TRIAL_H

#include <array>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "bench.h"

namespace physics {

/// What is measured while the robot walks, frame by frame.
struct Record {
  static constexpr std::size_t kAxes = 3;  ///< forward, left, turn
  using Axes = std::array<double, kAxes>;

  double seconds = 0;
  Axes commanded = {};  ///< mean velocity that the robot said it walks: m/s and radian/s
  Axes walked = {};     ///< mean velocity of the body, in its own directions

  /// For each axis, how fast the body was in parts of what was commanded, over all seconds; 0 if nothing was.
  Axes gain = {};

  double highest_tilt = 0;     ///< radian
  bool fell = false;           ///< tilted by more than 45 degrees, or touched the floor with more than its legs
  double usual_lift = 0;       ///< m; of all feet, exceeded by 95 of 100 steps
  double highest_speed = 0;    ///< of a leg's joint, in parts of its limit
  double commanded_speed = 0;  ///< the same as commanded
  double at_full_duty = 0;     ///< share of the legs' motors and frames
  double legs_touch = 0;       ///< share of the frames in which a leg touches another
  double beyond_limits = 0;    ///< radian; by how much a leg's joint was commanded out of its limits or couplings
  std::vector<End> ends;       ///< that the robot pushed
  std::vector<std::string> errors;
};

/// What the client wants at a time, in seconds since it began to steer.
using Commands = std::function<Velocity(double)>;

void pass(Bench& bench, double seconds);

/// Lets the robot stand, steers it for this time, and measures it from a second and a half later on.
Record walk(const World& world, const Commands& commands, double seconds);

/// The same velocity all the time.
Commands always(const Velocity& velocity);

/// A velocity and what it is called.
struct Direction {
  const char* name;
  Velocity velocity{};
};

/// The directions that are tried: each of the highest velocities, slow ones, and combinations.
std::vector<Direction> directionsWithin(const protocol::version2::WalkLimits& limits);

/// The velocities that the robot walks at most.
protocol::version2::WalkLimits walkLimits();

/// Any velocities within the limits, another one every half to three seconds, sometimes none. Always the same for a
/// seed.
Commands randomly(const protocol::version2::WalkLimits& limits, unsigned seed);

/// What must hold for every walk; each problem in a line.
/// @param on_level_ground false if only a fall, the legs and the joints count: a slope changes velocities
std::vector<std::string> problemsOf(const Record& record, bool on_level_ground = true);

/// How a limp robot lies before it is told to stand.
enum class Lying { kOnLeftSide, kOnRightSide, kOnBack };

/// The result of an order to stand.
struct Rise {
  bool stands = false;       ///< upright on all its feet, and it says so
  double seconds = 0;        ///< until it said that the order has ended
  double at_full_duty = 0;   ///< seconds; the longest time that a leg's motor had full duty
  double beyond_limits = 0;  ///< radian; by how much a leg's joint was commanded farther out of its limits
  std::string reason;        ///< why it does not stand
};

/// The robot stood, fell, and was limp for two seconds.
Rise standUp(const World& world, Lying lying);

/// Somebody has bent the legs of the limp robot, each joint to any angle within its limits, and let go. Always the same
/// for a seed.
Rise standUpFromAnyPosture(const World& world, unsigned seed);

/// One line of a table.
void printHeader(std::ostream& out);
void print(const std::string& name, const Record& record, std::ostream& out, bool on_level_ground = true);

}  // namespace physics

#endif  // TEST_PHYSICS_TRIAL_H
