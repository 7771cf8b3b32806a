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

  double highest_tilt = 0;   ///< radian
  bool fell = false;         ///< tilted by more than 45 degrees, or touched the floor with more than its legs
  double lowest_lift = 0;    ///< m; of all steps of all feet, the one that was lifted least
  double usual_lift = 0;     ///< m; exceeded by 95 of 100 steps
  double highest_speed = 0;  ///< of a leg's joint, in parts of its limit
  double usual_torque = 0;   ///< N m; of a leg's motor, exceeded in 1 frame of 100
  double at_full_duty = 0;   ///< share of the legs' motors and frames
  double beyond_limits = 0;  ///< radian; by how much a leg's joint was commanded out of its limits or couplings
  std::vector<End> ends;     ///< that the robot pushed
  std::vector<std::string> errors;
};

/// What the client wants at a time, in seconds since it began to steer.
using Commands = std::function<Velocity(double)>;

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
std::vector<std::string> problemsOf(const Record& record);

/// One line of a table.
void printHeader(std::ostream& out);
void print(const std::string& name, const Record& record, std::ostream& out);

}  // namespace physics

#endif  // TEST_PHYSICS_TRIAL_H
