/// @file aibo_walk_bench.cpp
/// Tries the walk on many robots with weight and on many floors, and prints a table.
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "support/program.h"
#include "trial.h"

namespace {

using physics::Record;
using physics::World;

constexpr double kSecondsOfDirection = 10;
constexpr double kSecondsOfUnevenFloor = 8;
constexpr double kSecondsOfRandomCommands = 60;
constexpr double kSecondsToGetUp = 10;
constexpr unsigned kPostures = 25;

struct Options {
  int worlds = 36;
  unsigned seed = 1;
  bool has_floors = true;
};

int problems = 0;

void tryOut(const std::string& name, const World& world, const physics::Commands& commands, double seconds) {
  const bool is_level = world.slope == 0 && world.sill == 0;
  const Record record = physics::walk(world, commands, seconds);
  physics::print(name, record, std::cout, is_level);
  std::cout.flush();
  problems += problemsOf(record, is_level).empty() ? 0 : 1;
}

void print(const std::string& name, const physics::Rise& rise) {
  std::cout << std::left << std::setw(34) << name << std::right << std::fixed << std::setprecision(1) << std::setw(6)
            << rise.seconds << " s, full duty for " << rise.at_full_duty << " s  " << rise.reason << '\n';
  problems += rise.stands && rise.seconds <= kSecondsToGetUp && rise.beyond_limits == 0 ? 0 : 1;
  std::cout.flush();
}

void tryToStandUp(const std::vector<World>& worlds) {
  using physics::Lying;
  std::cout << '\n';
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const std::string world = std::to_string(i) + ": up from ";
    print(world + "the left side", standUp(worlds[i], Lying::kOnLeftSide));
    print(world + "the right side", standUp(worlds[i], Lying::kOnRightSide));
    print(world + "the back", standUp(worlds[i], Lying::kOnBack));
  }
  for (const double torque : {1.5, 0.7}) {
    World world;
    world.stall_torque = torque;
    for (unsigned seed = 0; seed < kPostures; ++seed) {
      print("any posture " + std::to_string(seed) + " at " + std::to_string(torque),
            standUpFromAnyPosture(world, seed));
    }
  }
}

void tryOut(const Options& options) {
  const auto limits = physics::walkLimits();
  const std::vector<World> worlds = physics::sampleOfWorlds(options.worlds, options.seed);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    std::cout << '\n' << i << ": " << describe(worlds[i]) << '\n';
    physics::printHeader(std::cout);
    for (const physics::Direction& direction : physics::directionsWithin(limits)) {
      tryOut(direction.name, worlds[i], physics::always(direction.velocity), kSecondsOfDirection);
    }
    tryOut("random, a minute", worlds[i], physics::randomly(limits, static_cast<unsigned>(i)),
           kSecondsOfRandomCommands);
    for (std::size_t floor = 0; options.has_floors && floor < physics::unevenFloors().size(); ++floor) {
      const World world = onFloor(worlds[i], physics::unevenFloors()[floor]);
      tryOut("forward, floor " + std::to_string(floor), world, physics::always({0.1, 0, 0}), kSecondsOfUnevenFloor);
    }
  }
  tryToStandUp(worlds);
  std::cout << '\n' << problems << " trials with problems\n";
}

}  // namespace

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  Options options;
  bool is_short = false;
  po::options_description description;
  // clang-format off
  description.add_options()
    ("short", po::bool_switch(&is_short), "8 robots, on level floors only")
    ("worlds", po::value(&options.worlds)->default_value(36), "so many robots and floors, 1 to 1000")
    ("seed", po::value(&options.seed)->default_value(1), "they follow from this number, 1 to 1000");
  // clang-format on
  return test_support::runProgram(argc, argv, "Tries the walk on many robots and floors.", description, [&] {
    if (options.worlds < 1 || options.worlds > 1000 || options.seed < 1 || options.seed > 1000) {
      throw po::error("options '--worlds' and '--seed' must be 1 to 1000");
    }
    tryOut(is_short ? Options{8, options.seed, false} : options);
    return problems == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  });
}
