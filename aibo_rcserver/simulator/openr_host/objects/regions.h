/// @file regions.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_REGIONS_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_REGIONS_H

#include <OPENR/RCRegion.h>

#include <memory>
#include <vector>

namespace openr_host {

/// Holds a reference to a region, which goes when the last copy of this goes.
using RegionReference = std::shared_ptr<RCRegion>;

/// Data on its way.
using Regions = std::vector<RegionReference>;

inline RegionReference reference(RCRegion* region) {
  region->AddReference();
  return {region, [](RCRegion* referenced) { referenced->RemoveReference(); }};
}

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_REGIONS_H
