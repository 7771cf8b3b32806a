#include "simulator/ers7/region_pool.h"

#include <utility>

namespace simulated_ers7 {

RegionPool::RegionPool(std::size_t size, std::function<void(RCRegion*)> prepare)
    : size_(size), prepare_(std::move(prepare)) {}

RCRegion* RegionPool::freeRegion() {
  for (const auto& region : regions_) {
    if (region->NumberOfReference() == 1) {
      return region.get();
    }
  }
  regions_.emplace_back(new RCRegion(size_));
  prepare_(regions_.back().get());
  return regions_.back().get();
}

}  // namespace simulated_ers7
