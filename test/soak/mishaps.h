/// @file mishaps.h
#ifndef TEST_SOAK_MISHAPS_H
#define TEST_SOAK_MISHAPS_H

#include <chrono>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"
#include "support/simulated_robot.h"
#include "workload.h"

namespace soak {

/// What goes wrong, and what it goes wrong with.
struct Scene {
  test_support::FaultProxy* proxy;  ///< between driver and robot
  test_support::SimulatedRobot* robot;
  Workload* workload;
  std::function<void(std::chrono::milliseconds)> pass;  ///< lets so much time go by
};

/// Nothing came over the connection, so that nothing could go wrong with it.
class NothingCame : public std::runtime_error {
 public:
  NothingCame() : std::runtime_error("nothing came over the connection to make a fault in") {}
};

/// A kind of thing that goes wrong.
struct Mishap {
  std::string name;
  bool damages;  ///< bytes are changed on the way: it may take some time to show, and pictures may be changed, too
  /// Lets it happen. When it returns, all is well again.
  /// @throw NothingCame
  std::function<void(const Scene& scene, Random& random)> happen;
};

std::vector<Mishap> allMishaps();

}  // namespace soak

#endif  // TEST_SOAK_MISHAPS_H
