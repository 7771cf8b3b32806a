#include "simulated_ers7/primitive_table.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace simulated_ers7 {
namespace {

struct Primitive {
  OPrimitiveID id;
  const char* locator;
};

constexpr Primitive kPrimitives[] = {
    {kCameraPrimitive, "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1"},
};

}  // namespace

OStatus PrimitiveTable::open(const char* locator, OPrimitiveID* id) {
  if (locator == nullptr || id == nullptr) {
    return oINVALID_ARG;
  }
  const auto found =
      std::find_if(std::begin(kPrimitives), std::end(kPrimitives),
                   [locator](const Primitive& primitive) { return std::string(locator) == primitive.locator; });
  if (found == std::end(kPrimitives)) {
    return oNOT_FOUND;
  }
  ++times_opened_[found->id];
  *id = found->id;
  return oSUCCESS;
}

OStatus PrimitiveTable::close(OPrimitiveID id) {
  if (id == oprimitiveID_UNDEF) {
    times_opened_.clear();
    return oSUCCESS;
  }
  const auto found = times_opened_.find(id);
  if (found == times_opened_.end()) {
    return oINVALID_PRIMITIVE_ID;
  }
  if (--found->second == 0) {
    times_opened_.erase(found);
  }
  return oSUCCESS;
}

}  // namespace simulated_ers7
