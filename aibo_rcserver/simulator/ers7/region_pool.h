/// @file region_pool.h
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_REGION_POOL_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_REGION_POOL_H

#include <OPENR/RCRegion.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace simulated_ers7 {

/// Reusable regions for the robot's data. The pool grows to the number of regions that observers keep. Not thread-safe.
class RegionPool {
 public:
  /// @param size the size of each region, in bytes
  /// @param prepare writes a region's constant part once
  RegionPool(std::size_t size, std::function<void(RCRegion*)> prepare) : size_(size), prepare_(std::move(prepare)) {}

  /// A region to which only the pool refers. A new one is made if all others are in use.
  RCRegion* freeRegion() {
    for (const auto& region : regions_) {
      if (region->NumberOfReference() == 1) {
        return region.get();
      }
    }
    regions_.emplace_back(new RCRegion(size_));
    prepare_(regions_.back().get());
    return regions_.back().get();
  }

 private:
  struct RemoveReference {
    void operator()(RCRegion* region) const { region->RemoveReference(); }
  };

  std::size_t size_;
  std::function<void(RCRegion*)> prepare_;
  std::vector<std::unique_ptr<RCRegion, RemoveReference>> regions_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_REGION_POOL_H
