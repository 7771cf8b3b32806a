/// @file world.h
/// What nobody knows about a real robot and its floor.
#ifndef TEST_PHYSICS_WORLD_H
#define TEST_PHYSICS_WORLD_H

#include <string>
#include <vector>

namespace physics {

/// A robot and the floor that it stands on. No document gives these numbers, so a gait has to be good in all worlds.
struct World {
  /// Torque of a leg's motor that stands still at full duty, in N m, behind its gears.
  double stall_torque = 1.5;

  /// Between the robot and the floor.
  double friction = 0.8;

  /// Time constant of a contact, in seconds: the smaller, the harder are floor and feet.
  double contact_time = 0.010;

  /// Inertia of a motor behind its gears, in kg m^2. A leg has about 5e-4.
  double rotor_inertia = 5e-4;

  /// Torque that a joint needs to begin to move, in N m.
  double gear_friction = 0;

  /// True if the whole lower leg touches floors and other legs; otherwise only its ends do, the knee and the foot.
  bool has_long_shanks = true;

  /// @name Masses, in parts of those in the URDF
  /// @{
  double body_mass = 1;
  double head_mass = 1;  ///< with the neck
  double leg_mass = 1;
  /// @}

  /// Proportional gain of the servos, in parts of the simulated robot's.
  double servo_gain = 1;

  /// @name The floor
  /// @{
  double slope = 0;   ///< radian
  double uphill = 0;  ///< the direction in which it rises, in radian: 0 ahead of the robot, pi/2 to its left
  double sill = 0;    ///< metres; the height of bars across the way, one every 15 cm
  /// @}
};

/// Any worlds with a level floor. The first is the usual one. Each of the numbers is spread evenly over its range: 0.7
/// to 3 N m, friction 0.4 to 1, 4 to 20 ms, masses +-10 %, half to double gain. Always the same for a seed.
/// @param count at least 1
std::vector<World> sampleOfWorlds(int count, unsigned seed);

/// Slopes of 3 and 6 degrees up, down, to the left and to the right, and sills of 5 mm.
const std::vector<World>& unevenFloors();

/// The same robot on another floor.
World onFloor(World world, const World& floor);

/// All numbers of a world in one line.
std::string describe(const World& world);

}  // namespace physics

#endif  // TEST_PHYSICS_WORLD_H
