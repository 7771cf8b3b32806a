#include "world.h"

#include <cmath>
#include <iomanip>
#include <numeric>
#include <random>
#include <sstream>

namespace physics {
namespace {

constexpr double kDegree = M_PI / 180;

/// Numbers spread evenly over 0..1, in any order. Those of the standard library differ between libraries.
class Spread {
 public:
  explicit Spread(unsigned seed) : random_(seed + 1) {}

  std::vector<double> numbers(int count) {
    std::vector<double> result(static_cast<std::size_t>(count));
    std::iota(result.begin(), result.end(), 0);
    for (std::size_t i = result.size(); i-- > 1;) {
      std::swap(result[i], result[random_() % (i + 1)]);
    }
    for (double& number : result) {
      number = (number + static_cast<double>(random_()) / std::minstd_rand::max()) / count;
    }
    return result;
  }

 private:
  std::minstd_rand random_;
};

double between(double low, double high, double part) {
  return low + (high - low) * part;
}

/// For numbers of which double the value matters as much as half the value.
double betweenByFactors(double low, double high, double part) {
  return low * std::pow(high / low, part);
}

}  // namespace

std::vector<World> sampleOfWorlds(int count, unsigned seed) {
  Spread spread(seed);
  const int others = count - 1;
  const auto torque = spread.numbers(others);
  const auto friction = spread.numbers(others);
  const auto contact = spread.numbers(others);
  const auto inertia = spread.numbers(others);
  const auto gears = spread.numbers(others);
  const auto shanks = spread.numbers(others);
  const auto body = spread.numbers(others);
  const auto head = spread.numbers(others);
  const auto legs = spread.numbers(others);
  const auto gain = spread.numbers(others);
  std::vector<World> worlds(1);
  for (std::size_t i = 0; i < torque.size(); ++i) {
    World world;
    world.stall_torque = betweenByFactors(0.7, 3, torque[i]);
    world.friction = between(0.4, 1, friction[i]);
    world.contact_time = betweenByFactors(0.004, 0.020, contact[i]);
    world.rotor_inertia = inertia[i] < 0.5 ? 5e-4 : 1.8e-3;
    world.gear_friction = gears[i] < 0.5 ? 0 : 0.04 * world.stall_torque;
    world.has_long_shanks = shanks[i] < 0.5;
    world.body_mass = between(0.9, 1.1, body[i]);
    world.head_mass = between(0.9, 1.1, head[i]);
    world.leg_mass = between(0.9, 1.1, legs[i]);
    world.servo_gain = betweenByFactors(0.5, 2, gain[i]);
    worlds.push_back(world);
  }
  return worlds;
}

const std::vector<World>& unevenFloors() {
  static const std::vector<World> floors = [] {
    std::vector<World> result;
    for (const double slope : {3 * kDegree, 6 * kDegree}) {
      for (const double uphill : {0.0, 90 * kDegree, 180 * kDegree, 270 * kDegree}) {
        World floor;
        floor.slope = slope;
        floor.uphill = uphill;
        result.push_back(floor);
      }
    }
    World sills;
    sills.sill = 0.005;
    result.push_back(sills);
    return result;
  }();
  return floors;
}

World onFloor(World world, const World& floor) {
  world.slope = floor.slope;
  world.uphill = floor.uphill;
  world.sill = floor.sill;
  return world;
}

std::string describe(const World& world) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << world.stall_torque << " N m, friction " << world.friction << ", "
       << std::setprecision(1) << world.contact_time * 1e3 << " ms, rotors " << world.rotor_inertia * 1e4
       << "e-4, gears " << std::setprecision(2) << world.gear_friction << " N m, "
       << (world.has_long_shanks ? "shanks" : "balls") << ", masses " << world.body_mass << ' ' << world.head_mass
       << ' ' << world.leg_mass << ", gain " << world.servo_gain;
  if (world.slope != 0) {
    text << ", " << std::setprecision(0) << world.slope / kDegree << " degrees up to " << world.uphill / kDegree;
  }
  if (world.sill != 0) {
    text << ", sills of " << std::setprecision(0) << world.sill * 1e3 << " mm";
  }
  return text.str();
}

}  // namespace physics
