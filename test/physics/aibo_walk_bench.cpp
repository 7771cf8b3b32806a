/// @file aibo_walk_bench.cpp
/// Tries the walk on a robot with weight, for hours of its time, and prints a table.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "trial.h"

namespace {

using physics::World;

constexpr double kSecondsOfDirection = 45;
constexpr double kSecondsOfRandomCommands = 600;

const std::vector<World> kWorlds = {{1.5, 0.8}, {0.7, 0.4}, {0.7, 0.8}, {0.7, 1}, {1, 0.6}, {1.5, 0.4},
                                    {1.5, 1},   {2, 0.8},   {3, 0.4},   {3, 0.8}, {3, 1}};

int problems = 0;

void tryOut(const std::string& name, const World& world, const physics::Commands& commands, double seconds) {
  const physics::Record record = physics::walk(world, commands, seconds);
  physics::print(name, record, std::cout);
  std::cout.flush();
  problems += problemsOf(record).empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool is_short = arguments == std::vector<std::string>{"--short"};
  if (!arguments.empty() && !is_short) {
    std::cerr << "aibo_walk_bench [--short]: tries the walk with many motors and floors; --short with one\n";
    return EXIT_FAILURE;
  }
  const protocol::version2::WalkLimits limits = physics::walkLimits();
  for (const World& world : kWorlds) {
    std::cout << "\nmotors of " << world.stall_torque << " N m, friction " << world.friction << '\n';
    physics::printHeader(std::cout);
    for (const physics::Direction& direction : physics::directionsWithin(limits)) {
      tryOut(direction.name, world, physics::always(direction.velocity), kSecondsOfDirection);
    }
    tryOut("random, 10 min", world, physics::randomly(limits, 1), kSecondsOfRandomCommands);
    if (is_short) {
      break;
    }
  }
  std::cout << '\n' << problems << " trials with problems\n";
  return problems == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
