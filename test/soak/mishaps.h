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

/// What a mishap acts on.
struct Scene {
  test_support::FaultProxy* proxy;  ///< between driver and robot
  test_support::SimulatedRobot* robot;
  Workload* workload;
  std::function<void(std::chrono::milliseconds)> pass;  ///< lets this much time pass
};

/// A fault could not be made, because nothing came over the connection.
class NothingCame : public std::runtime_error {
 public:
  NothingCame() : std::runtime_error("the fault could not be made, because nothing came over the connection") {}
};

/// A kind of fault.
struct Mishap {
  std::string name;
  bool damages;  ///< bytes are changed on the way: this may show late, and pictures may be changed, too
  /// Lets it happen. The fault is over when this returns.
  /// @throw NothingCame
  std::function<void(const Scene& scene, Random& random)> happen;
};

std::vector<Mishap> allMishaps();

}  // namespace soak

#endif  // TEST_SOAK_MISHAPS_H
